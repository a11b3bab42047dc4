"""Fits to a speed that a coarse converter rounded: what it shows on average is compared, not the speed itself."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.budget import shares_by_rank
from rwn.fit.fit import Fit, best_few, refit
from rwn.fit.problem import Problem
from rwn.parallel import side_by_side
from rwn.recording.quantisation import mean_rounding_error, quantum
from rwn.simulate.run import Run

Array = NDArray[np.float64]

ROUNDS = 6  # fits, each to the speed less the rounding error of the last
NOISES = (0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6)  # before the rounding of the speed, in its steps
COARSE = 0.25  # share of the residual's energy from which the rounding of a signal is worth a name


def unrounded_fits(problem: Problem, nominal: Fit, fits: list[Fit]) -> tuple[Problem, Fit, list[Fit]]:
    """The same fits, each to the speed less the rounding error that it expects; as they are where no speed is coarse.

    The fixed point solves an unbiased estimating equation: what is shown differs from its mean by nothing that the
    model could follow.
    """
    best = min([nominal, *fits], key=lambda f: f.cost)
    shown = as_recorded(problem)
    residuals = shown.residuals(best.vector, best.active)
    steps = coarse_steps(shown, residuals)
    if not steps:
        return problem, nominal, fits
    noises = [
        noise_before_rounding(r, left["speed"], step)
        for r, left, step in zip(shown.runs, residuals, steps, strict=True)
    ]
    these = [nominal, *best_few(fits)]
    shares = shares_by_rank(shown.work, [f.cost if f.added else 0.0 for f in these])

    def on_average(pair: tuple[Fit, float]) -> tuple[Fit, Problem]:
        return _to_the_mean(pair[0], shown, steps, noises, share=pair[1])

    refitted = side_by_side(on_average, zip(these, shares, strict=True))
    _, on = min(refitted, key=lambda pair: pair[0].cost)
    return on, refitted[0][0], sorted((f for f, _ in refitted[1:]), key=lambda f: f.cost)


def recorded_steps(problem: Problem, best: Fit) -> tuple[float, ...]:
    """The step [rad/s] of the speed of each run; empty where the speed is not coarse in all of them."""
    raw = as_recorded(problem)
    return tuple(coarse_steps(raw, raw.residuals(best.vector, best.active)))


def as_recorded(problem: Problem) -> Problem:
    """`problem` with the speeds as they were recorded."""
    speeds = (r.speed for r in problem.whole)
    runs = tuple(replace(r, speed=s) for r, s in zip(problem.runs, speeds, strict=True))
    return replace(problem, runs=runs)


def coarse_steps(problem: Problem, residuals: Sequence[Mapping[str, Array]]) -> list[float]:
    """The step [rad/s] of the speed signal of each run; empty where it is not coarse in all of them.

    `residuals`: of each run, by signal, (n,), in SI.
    """
    steps = [
        speed_resolution(r, left["speed"]) if "speed" in left else 0.0
        for r, left in zip(problem.runs, residuals, strict=True)
    ]
    return steps if steps and min(steps) > 0.0 else []


def speed_resolution(run: Run, residual: Array) -> float:
    """The step [rad/s] that a coarse converter rounds a speed to, where that is much of the residual (n,); else 0."""
    step = 0.0 if run.speed_measured.is_difference else quantum(run.measured("speed"))
    share = step**2 / 12.0 / max(float(np.nanmean(residual**2)), 1e-300)
    return step if share > COARSE else 0.0


def noise_before_rounding(run: Run, residual: Array, step: float) -> float:
    """The noise before the rounding of a coarse speed, in steps: the one that leaves least of a residual (n,)."""
    left = [float(np.nanmean((residual - _mean_error(run, residual, step, n)) ** 2)) for n in NOISES]
    return NOISES[int(np.argmin(left))]


def unrounded(run: Run, residual: Array, step: float, noise: float) -> Run:
    """The run less the error that the rounding of its speed makes on average at each simulated value.

    A slow speed between two steps is shown wrong in the same way for long, which no noise level describes.

    Args:
        run: one whose speed is coarse.
        residual: (n,), shown minus simulated speed, rad/s.
        step: of the shown speed, rad/s.
        noise: standard deviation before the rounding, in steps.
    """
    return replace(run, speed=run.speed - _mean_error(run, residual, step, noise))


def _mean_error(run: Run, residual: Array, step: float, noise: float) -> Array:
    cells = (run.speed - residual - run.speed[0]) / step  # simulated, in steps of the shown one
    return step * mean_rounding_error(cells, noise)


def _to_the_mean(
    this: Fit, shown: Problem, steps: Sequence[float], noises: Sequence[float], *, share: float
) -> tuple[Fit, Problem]:
    """By turns the rounding error that a fit expects and a fit to the speeds without it; the last fit and its problem.

    `share`: what each round may cost.
    """
    problem = shown
    for _ in range(ROUNDS):
        residuals = shown.residuals(this.vector, this.active)
        runs = tuple(
            unrounded(r, left["speed"], step, noise)
            for r, left, step, noise in zip(shown.runs, residuals, steps, noises, strict=True)
        )
        problem = replace(shown, runs=runs)
        this = refit(this, problem, share=share)
    return this, problem
