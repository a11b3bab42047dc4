"""What rounding adds to a signal: of encoder counts, their differences, and converters that are too coarse."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.problem import OutputError, Target
from rwn.recording.lattice import lattice

Array = NDArray[np.float64]


def quantisation(target: Target, signal: str) -> float:
    """Standard deviation of the quantisation of a signal; 0 where its values lie on no lattice.

    q / sqrt(12) for steps of q, q / sqrt(6) where these are of a difference, which holds two roundings.
    """
    step = lattice(target.measured(signal))
    difference = signal == "speed" and target.speed_measured.is_difference
    return float(step / np.sqrt(6.0 if difference else 12.0))


def speed_resolution(target: Target, residual: Array) -> float:
    """The step of a speed signal that a coarse converter rounds, where that is much of the residual; else 0."""
    step = 0.0 if target.speed_measured.is_difference else lattice(target.measured("speed"))
    share = step**2 / 12.0 / max(float(np.nanmean(residual**2)), 1e-300)
    return step if share > COARSE else 0.0


def coarse_steps(problem: OutputError, residuals: Sequence[Mapping[str, Array]]) -> list[float]:
    """The step of the speed signal of each recording; empty where it is not coarse in all of them."""
    steps = [
        speed_resolution(t, r["speed"]) if "speed" in r else 0.0
        for t, r in zip(problem.targets, residuals, strict=True)
    ]
    return steps if steps and min(steps) > 0.0 else []


def noise_before_rounding(target: Target, residual: Array, step: float) -> float:
    """The noise before the rounding of a coarse speed, in steps: the one that leaves least of a residual."""
    left = [float(np.nanmean((residual - _mean_error(target, residual, step, n)) ** 2)) for n in NOISES]
    return NOISES[int(np.argmin(left))]


def unrounded(target: Target, residual: Array, step: float, noise: float) -> Target:
    """The recording less the error that the rounding of its speed makes on average at each simulated value.

    A slow speed between two steps is shown wrong in the same way for long, which no noise level describes.

    Args:
        target: a recording whose speed is coarse.
        residual: shape (n), shown minus simulated speed, rad/s.
        step: of the shown speed, rad/s.
        noise: standard deviation before the rounding, in steps.
    """
    return replace(target, speed=target.speed - _mean_error(target, residual, step, noise))


def _mean_error(target: Target, residual: Array, step: float, noise: float) -> Array:
    cells = (target.speed - residual - target.speed[0]) / step  # simulated, on the lattice of the shown one
    return step * mean_rounding_error(cells, noise)


def mean_rounding_error(cells: Array, noise: float) -> Array:
    """Mean of round(x + n) - x for Gaussian noise n, both in steps (Widrow, Kollar 2008, ch. 4)."""
    k = np.arange(1, HARMONICS + 1)
    weights = (-1.0) ** k / (np.pi * k) * np.exp(-2.0 * (np.pi * k * noise) ** 2)
    error: Array = np.sin(2.0 * np.pi * np.multiply.outer(cells, k)) @ weights
    return error


NOISES = (0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6)  # before the rounding, in steps
HARMONICS = 40
COARSE = 0.25  # share of the residual's energy from which the rounding of a signal is worth a name
