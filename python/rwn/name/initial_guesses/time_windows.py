"""First guesses of a load that acts for a while: windows in which a constant torque explains most of the residual."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.model.vocabulary import Effect
from rwn.name.initial_guesses.guess import Guess
from rwn.simulate.linear_response import speed_filter

Array = NDArray[np.float64]


def read(problem: Problem, base: Fit, effect: Effect, count: int) -> list[Guess] | None:  # noqa: ARG001
    """Begin and end of the load."""
    first, last = (p.name for p in effect.instants)
    residuals = problem.residuals(base.vector, base.active)
    return [{first: a, last: b} for a, b in windows(problem, base.vector, residuals)]


def windows(
    problem: Problem, motor: Array, residuals: Sequence[dict[str, Array]], count: int = 2
) -> list[tuple[float, float]]:
    """Begin and end [s] of windows in which a constant extra torque explains most of the `residuals` (n,)."""
    length = max(float(r.time[-1] - r.time[0]) for r in problem.runs)
    bins = 60
    total, weight = np.zeros(bins), np.zeros(bins)
    for run, residual in zip(problem.runs, residuals, strict=True):
        if "speed" not in residual:
            continue
        r = residual["speed"]
        a, b = speed_filter(problem.drive, motor, run.sample_time)
        torque = (r[1:] - a * r[:-1]) / b
        place = np.minimum((bins * (run.time[:-1] - run.time[0]) / length).astype(int), bins - 1)
        total += np.bincount(place, torque, bins)
        weight += np.bincount(place, minlength=bins)
    mean = total.sum() / max(weight.sum(), 1.0)
    sums = np.concatenate([[0.0], np.cumsum(total - mean * weight)])
    counts = np.concatenate([[0.0], np.cumsum(weight)])
    i, j = np.triu_indices(bins + 1, 2)
    n, whole = counts[j] - counts[i], counts[-1]
    gain = np.where(
        (n > 0) & (n < whole),
        (sums[j] - sums[i]) ** 2 / np.maximum(n * (1.0 - n / max(whole, 1.0)), 1e-9),
        0.0,
    )
    found: list[tuple[float, float]] = []
    for k in np.argsort(gain)[::-1]:
        if all(abs(i[k] - p) + abs(j[k] - q) > bins / 6 for p, q in found):
            found.append((float(i[k]), float(j[k])))
        if len(found) == count:
            break
    # a little off the grid, so that the instants carry derivatives
    return [(length * (p + 0.013) / bins, length * (q - 0.017) / bins) for p, q in found]
