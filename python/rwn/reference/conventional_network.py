"""Reference for the conventional network: (2.4-2.5) and the derivatives (2.14-2.19), one loop per index of the
equations."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rwn.networks.arrays import Array
from rwn.reference.wavelets import WAVELETS


@dataclass
class ConventionalNetwork:
    """Parameters b (outputs,), a (outputs, inputs), w (outputs, wavelets), m and d (wavelets, inputs)."""

    wavelet: str
    omega0: float
    b: Array
    a: Array
    w: Array
    m: Array
    d: Array

    @property
    def parameters(self) -> Array:
        """b, a, w, m, d in one vector."""
        return np.concatenate([p.ravel() for p in (self.b, self.a, self.w, self.m, self.d)])

    def with_parameters(self, theta: Array) -> ConventionalNetwork:
        """The same network with other parameters."""
        parts: dict[str, Any] = {}
        for name in ("b", "a", "w", "m", "d"):
            shape = getattr(self, name).shape
            size = int(np.prod(shape))
            parts[name], theta = theta[:size].reshape(shape), theta[size:]
        return replace(self, **parts)

    def layer(self, x: Array) -> tuple[Array, Array, Array]:
        """z (patterns, wavelets, inputs), Phi (patterns, wavelets) (2.5) and dPhi_j/dz_ji, shaped as z
        (2.19)."""
        z = (x[:, None, :] - self.m) / self.d
        phi = WAVELETS[self.wavelet](z, self.omega0)
        slope = np.empty_like(z)
        for i in range(z.shape[2]):
            others = np.delete(phi.value, i, axis=2)
            slope[:, :, i] = phi.first[:, :, i] * np.prod(others, axis=2)
        return z, np.prod(phi.value, axis=2), slope

    def output(self, x: Array) -> Array:
        """(patterns, outputs), by (2.4)."""
        _, phi, _ = self.layer(x)
        return self.b + phi @ self.w.T + x @ self.a.T

    def jacobian(self, x: Array) -> Array:
        """(patterns, outputs, parameters), by (2.14-2.18)."""
        z, phi, slope = self.layer(x)
        patterns, outputs = len(x), len(self.b)
        b, a, w = (np.zeros((patterns, outputs, *p.shape)) for p in (self.b, self.a, self.w))
        m, d = (np.empty((patterns, outputs, *self.m.shape)) for _ in range(2))
        for k in range(outputs):
            b[:, k, k] = 1.0
            a[:, k, k, :] = x
            w[:, k, k, :] = phi
            m[:, k] = -self.w[k][:, None] / self.d * slope
            d[:, k] = -self.w[k][:, None] / self.d * z * slope
        return np.concatenate([part.reshape(patterns, outputs, -1) for part in (b, a, w, m, d)], axis=2)

    def gradient(self, x: Array, y: Array) -> Array:
        """Of 1/2 sum of squared errors, by (2.13) with the sum over outputs."""
        error = y - self.output(x)
        return np.asarray(-np.einsum("pk,pkn->n", error, self.jacobian(x)))
