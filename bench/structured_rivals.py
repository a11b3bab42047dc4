"""The structured training step (v1..v3 and 4 x N_w learn, rates held) in numba and in jitted JAX."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numba
import numpy as np

jax.config.update("jax_enable_x64", True)


@numba.njit(fastmath=True, cache=False)
def numba_cycle(v, net, rates, u, y):  # type: ignore[no-untyped-def]
    """v (5,), net (4, N_w) are changed in place; returns the sum of squared errors."""
    count = net.shape[1]
    phi, V = np.zeros(count), np.zeros((3, count))
    P, Q = np.zeros((4, count)), np.zeros((4, count))
    p, q = np.zeros(3), np.zeros(3)
    x1 = x2 = squares = 0.0
    for n in range(1, len(y)):
        a11, a12, a21, a22 = 1 - v[0] * v[1], v[1] * v[2], -v[2] * v[3], v[4]
        tau = 0.0
        for j in range(count):
            w, m, d, c = net[0, j], net[1, j], net[2, j], net[3, j]
            inverse = 1 / d
            z = (y[n - 1] + c * phi[j] - m) * inverse
            g = np.exp(-0.5 * z * z)
            slope = (z * z - 1) * g * inverse
            V[0, j] = slope * (c * V[0, j] - 1)
            V[1, j] = slope * (c * V[1, j] - z)
            V[2, j] = slope * (c * V[2, j] + phi[j])
            phi[j] = -z * g
            tau += w * phi[j]
            for k in range(4):
                drive = phi[j] if k == 0 else w * V[k - 1, j]
                before = P[k, j]
                P[k, j] = a11 * before + a12 * Q[k, j] - v[1] * drive
                Q[k, j] = a21 * before + a22 * Q[k, j]
        drive1 = (-v[1] * x1, v[2] * x2 - v[0] * x1 - tau, v[1] * x2)
        drive2 = (0.0, 0.0, -v[3] * x1)
        for k in range(3):
            before = p[k]
            p[k] = a11 * before + a12 * q[k] + drive1[k]
            q[k] = a21 * before + a22 * q[k] + drive2[k]
        following = a11 * x1 + a12 * x2 - v[1] * tau
        x2 = a21 * x1 + a22 * x2 + v[3] * u[n - 1]
        x1 = following
        error = y[n] - x1
        squares += error * error
        for k in range(3):
            v[k] += rates[k] * error * p[k]
        for k in range(4):
            for j in range(count):
                net[k, j] += rates[5 + k] * error * P[k, j]
    return squares


@jax.jit
def jax_cycle(v, net, rates, u, y):  # type: ignore[no-untyped-def]
    """Returns v, net and the sum of squared errors."""

    def step(state, sample):  # type: ignore[no-untyped-def]
        v, net, x1, x2, p, q, phi, V, P, Q, squares = state
        volts, before, now = sample
        a11, a12, a21, a22 = 1 - v[0] * v[1], v[1] * v[2], -v[2] * v[3], v[4]
        w, m, d, c = net
        z = (before + c * phi - m) / d
        g = jnp.exp(-0.5 * z * z)
        slope = (z * z - 1) * g / d
        V = slope * (c * V + jnp.stack([-jnp.ones_like(z), -z, phi]))
        phi = -z * g
        tau = w @ phi
        drive = jnp.concatenate([phi[None], w * V])
        P, Q = a11 * P + a12 * Q - v[1] * drive, a21 * P + a22 * Q
        drive1 = jnp.stack([-v[1] * x1, v[2] * x2 - v[0] * x1 - tau, v[1] * x2])
        drive2 = jnp.stack([jnp.zeros_like(x1), jnp.zeros_like(x1), -v[3] * x1])
        p, q = a11 * p + a12 * q + drive1, a21 * p + a22 * q + drive2
        x1, x2 = a11 * x1 + a12 * x2 - v[1] * tau, a21 * x1 + a22 * x2 + v[3] * volts
        error = now - x1
        v = v.at[:3].add(rates[:3] * error * p)
        net = net + rates[5:, None] * error * P
        return (v, net, x1, x2, p, q, phi, V, P, Q, squares + error * error), None

    count, zero = net.shape[1], jnp.zeros(())
    blank = (jnp.zeros(count), jnp.zeros((3, count)), jnp.zeros((4, count)), jnp.zeros((4, count)), zero)
    first = (v, net, zero, zero, jnp.zeros(3), jnp.zeros(3), *blank)
    last, _ = jax.lax.scan(step, first, (u[:-1], y[:-1], y[1:]))
    return last[0], last[1], last[-1]
