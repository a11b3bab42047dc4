"""The functions that chapter 2 approximates."""

from __future__ import annotations

import numpy as np

from rwn.networks.arrays import Array


def siso(x: Array) -> Array:
    """Piecewise function on [-10, 10] (2.25)."""
    right = 10 * np.exp(-0.05 * x - 0.5) * np.sin(0.03 * x**2 + 0.7 * x)
    return np.where(x < -2, -2.186 * x - 12.864, np.where(x <= 0, 4.246 * x, right))


def miso(x: Array) -> Array:
    """Function of two inputs (2.26, 2.28) as printed: 1.335 multiplies only the first bracket. x (patterns,
    2)."""
    x1, x2 = x[:, 0], x[:, 1]
    return np.asarray(
        1.335 * (1.5 - 1.5 * x1)
        + np.exp(2 * x1 - 1) * np.sin(3 * np.pi * (x1 - 0.6) ** 2)
        + np.exp(3 * x2 - 1.5) * np.sin(4 * np.pi * (x2 - 0.9) ** 2)
    )


def gaussian(x: Array) -> Array:
    """exp(-10 x^2) (2.27)."""
    return np.asarray(np.exp(-10 * x**2))


def grid(low: float, high: float, points: int) -> Array:
    """All pairs of `points` values from low to high, (points^2, 2), the second changing fastest."""
    axis = np.linspace(low, high, points)
    return np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
