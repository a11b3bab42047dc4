"""The recurrent training step with one input (b, a, w, m, d, c learn, rates held) in numba and in jitted JAX."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numba
import numpy as np

jax.config.update("jax_enable_x64", True)


@numba.njit(fastmath=True, cache=False)
def numba_cycle(linear, net, rates, x, y):  # type: ignore[no-untyped-def]
    """linear (2,) = b, a and net (4, N_w) are changed in place; returns the sum of squared errors."""
    count = net.shape[1]
    phi, V = np.zeros(count), np.zeros((3, count))
    squares = 0.0
    for n in range(len(y)):
        output = linear[0] + linear[1] * x[n]
        for j in range(count):
            w, m, d, c = net[0, j], net[1, j], net[2, j], net[3, j]
            inverse = 1 / d
            z = (x[n] + c * phi[j] - m) * inverse
            g = np.exp(-0.5 * z * z)
            slope = (z * z - 1) * g * inverse
            V[0, j] = slope * (c * V[0, j] - 1)
            V[1, j] = slope * (c * V[1, j] - z)
            V[2, j] = slope * (c * V[2, j] + phi[j])
            phi[j] = -z * g
            output += w * phi[j]
        error = y[n] - output
        squares += error * error
        linear[0] += rates[0] * error
        linear[1] += rates[1] * error * x[n]
        for j in range(count):
            w = net[0, j]
            net[0, j] += rates[2] * error * phi[j]
            for k in range(3):
                net[1 + k, j] += rates[3 + k] * error * w * V[k, j]
    return squares


@jax.jit
def jax_cycle(linear, net, rates, x, y):  # type: ignore[no-untyped-def]
    """Returns linear, net and the sum of squared errors."""

    def step(state, sample):  # type: ignore[no-untyped-def]
        linear, net, phi, V, squares = state
        now, wanted = sample
        w, m, d, c = net
        z = (now + c * phi - m) / d
        g = jnp.exp(-0.5 * z * z)
        slope = (z * z - 1) * g / d
        V = slope * (c * V + jnp.stack([-jnp.ones_like(z), -z, phi]))
        phi = -z * g
        error = wanted - (linear[0] + linear[1] * now + w @ phi)
        linear = linear + rates[:2] * error * jnp.stack([jnp.ones_like(now), now])
        net = net + rates[2:, None] * error * jnp.concatenate([phi[None], w * V])
        return (linear, net, phi, V, squares + error * error), None

    count = net.shape[1]
    first = (linear, net, jnp.zeros(count), jnp.zeros((3, count)), jnp.zeros(()))
    last, _ = jax.lax.scan(step, first, (x, y))
    return last[0], last[1], last[-1]
