"""Reference for the initialisations (2.7-2.11; Oussar & Dreyfus 2000)."""

from __future__ import annotations

import numpy as np

from rwn.networks.arrays import Array
from rwn.reference.wavelets import WAVELETS


def least_squares(x: Array, y: Array) -> Array:
    """(1 + inputs, outputs): b, then a transposed (2.7)."""
    regressors = np.column_stack([np.ones(len(x)), x])
    return np.asarray(np.linalg.lstsq(regressors, y, rcond=None)[0])


def heuristic(x: Array, wavelets: int) -> tuple[Array, Array]:
    """m and d (wavelets, inputs) (2.8, 2.9)."""
    low, high = x.min(axis=0), x.max(axis=0)
    return np.tile(0.5 * (low + high), (wavelets, 1)), np.tile(0.2 * (high - low), (wavelets, 1))


def dyadic_grid(x: Array, wavelets: int, finest: list[int]) -> tuple[Array, Array]:
    """m and d (wavelets, inputs) (2.10, 2.11); `finest`: the nodes used of the last, incomplete scale."""
    columns = [_dyadic_axis(x[:, i], wavelets, finest) for i in range(x.shape[1])]
    nodes = np.array(columns)
    return nodes[:, :, 0].T.copy(), nodes[:, :, 1].T.copy()


def _dyadic_axis(x: Array, wavelets: int, finest: list[int]) -> list[tuple[float, float]]:
    scale = [(float(x.min()), float(x.max()))]
    nodes: list[tuple[float, float]] = []
    while len(nodes) + len(scale) <= wavelets:
        placed = [_node(x, interval) for interval in scale]
        nodes += placed
        scale = [half for (a, b), (p, _) in zip(scale, placed, strict=True) for half in ((a, p), (p, b))]
    return nodes + [_node(x, scale[n]) for n in finest]


def _node(x: Array, interval: tuple[float, float]) -> tuple[float, float]:
    a, b = interval
    inside = x[(x >= a) & (x <= b)]
    p = float(inside.mean()) if len(inside) else a
    return (p if a < p < b else 0.5 * (a + b)), 0.5 * (b - a)


def select_wavelets(
    wavelet: str, omega0: float, m: Array, d: Array, x: Array, y: Array, wavelets: int
) -> list[int]:
    """Rows of the library m, d, by residual sums of squares of fresh least-squares fits: slow, without
    Gram-Schmidt."""
    z = (x[:, None, :] - m) / d
    values = np.prod(WAVELETS[wavelet](z, omega0).value, axis=2)
    basis = np.column_stack([np.ones(len(x)), x])
    chosen: list[int] = []
    for _ in range(wavelets):
        left = [_left(np.column_stack([basis, values[:, j]]), y) for j in range(len(m))]
        best = min((j for j in range(len(m)) if j not in chosen), key=lambda j: left[j])
        chosen.append(best)
        basis = np.column_stack([basis, values[:, best]])
    return chosen


def _left(basis: Array, y: Array) -> float:
    return float(np.sum((y - basis @ np.linalg.lstsq(basis, y, rcond=None)[0]) ** 2))
