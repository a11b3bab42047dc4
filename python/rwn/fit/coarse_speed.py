"""Fits to a speed that a coarse converter rounded: what it shows on average is compared, not the speed itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rwn.fit.budget import shares_by_rank
from rwn.fit.fit import Fitted
from rwn.fit.problem import OutputError
from rwn.fit.quantisation import coarse_steps, noise_before_rounding, unrounded
from rwn.name.screening import Search, foremost
from rwn.parallel import side_by_side

ROUNDS = 6  # fits, each to the speed less the rounding error of the last


def unrounded_fits(
    search: Search, nominal: Fitted, fits: list[Fitted], shown: OutputError
) -> tuple[Search, Fitted, list[Fitted]]:
    """The same fits, each to the speed less the rounding error that it expects; as they are where no speed is coarse.

    `shown` holds the speeds as recorded. The fixed point solves an unbiased estimating equation: what is shown differs
    from its mean by nothing that the model could follow.
    """
    best = min([nominal, *fits], key=lambda f: f.cost)
    problem = as_shown(search.problem, shown)
    residuals = problem.residuals(best.vector, best.candidate.active)
    steps = coarse_steps(problem, residuals)
    if not steps:
        return search, nominal, fits
    noises = [
        noise_before_rounding(t, r["speed"], step)
        for t, r, step in zip(problem.targets, residuals, steps, strict=True)
    ]
    these = [nominal, *foremost(fits)]
    shares = shares_by_rank(problem.work, [f.cost if f.added else 0.0 for f in these])

    def on_average(pair: tuple[Fitted, float]) -> tuple[Fitted, OutputError]:
        return _settled(search, pair[0], problem, steps, noises, share=pair[1])

    settled = side_by_side(on_average, zip(these, shares, strict=True))
    _, on = min(settled, key=lambda pair: pair[0].cost)
    return replace(search, problem=on), settled[0][0], sorted((f for f, _ in settled[1:]), key=lambda f: f.cost)


def steps_shown(problem: OutputError, shown: OutputError, best: Fitted) -> tuple[float, ...]:
    """The step of the speed of each recording; empty where the speed is not coarse in all of them."""
    raw = as_shown(problem, shown)
    return tuple(coarse_steps(raw, raw.residuals(best.vector, best.candidate.active)))


def as_shown(problem: OutputError, shown: OutputError) -> OutputError:
    """`problem` with the speeds as they were recorded."""
    speeds = (t.speed for t in shown.targets)
    return replace(problem, targets=tuple(replace(t, speed=s) for t, s in zip(problem.targets, speeds, strict=True)))


def _settled(
    search: Search, fitted: Fitted, shown: OutputError, steps: Sequence[float], noises: Sequence[float], *, share: float
) -> tuple[Fitted, OutputError]:
    """The fit that expects the rounding which is shown, and the problem that it solves; each round may cost `share`."""
    problem = shown
    for _ in range(ROUNDS):
        residuals = shown.residuals(fitted.vector, fitted.candidate.active)
        targets = tuple(
            unrounded(t, r["speed"], step, noise)
            for t, r, step, noise in zip(shown.targets, residuals, steps, noises, strict=True)
        )
        problem = replace(shown, targets=targets)
        fitted = search.refit(fitted, problem, share=share)
    return fitted, problem
