"""The angle that effects of the angle act along where none was recorded."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.output_error import Target
from rwn.search import Fitted, Search, foremost

Array = NDArray[np.float64]
Track = Callable[[Search, Fitted], Search]

MOST_TRACKS = 4  # times that the angle is simulated anew


def retracked(
    search: Search, nominal: Fitted, fits: list[Fitted], recorded: Sequence[Target]
) -> tuple[Search, Fitted, list[Fitted]]:
    """The same fits with another angle where none was recorded: one that the best fit simulates, or each fit its own.

    The integral of a noisy speed wanders, and that of a late or biased sensor is late or drifts: thirty periods a
    revolution further on, it has lost the phase. What the best fit knows of the sensor is undone first, in the angles
    of the recordings as they were prepared (`recorded`). Effects on their own angle are the exact equations, but only
    near the solution a smooth problem.
    """
    best = min([nominal, *fits], key=lambda f: f.cost)
    if not _turns(best) or any(t.position.size for t in search.problem.targets):
        return search, nominal, fits
    other, again = _followed(search, best, lambda s, f: _without_the_sensor(s, f, recorded))
    other, again = _followed(other, again, _tracked)
    free = replace(search, problem=replace(search.problem, targets=tuple(map(_on_its_own, search.problem.targets))))
    freed = free.refit(again, free.problem)
    if freed.cost < again.cost - 2.0:
        other, again = free, freed
    if other is search:
        return search, nominal, fits
    first, *rest = other.refit_all([nominal, *(f for f in foremost(fits) if f is not best)])
    return other, first, sorted([again, *rest], key=lambda f: f.cost)


def _followed(search: Search, fitted: Fitted, track: Track) -> tuple[Search, Fitted]:
    """The fit on the angles that itself makes probable, again and again as long as it gains."""
    for _ in range(MOST_TRACKS):
        tried = track(search, fitted)
        refitted = tried.refit(fitted, tried.problem)
        if refitted.cost > fitted.cost - 2.0:
            break
        search, fitted = tried, refitted
    return search, fitted


def _on_its_own(target: Target) -> Target:
    return replace(target, follows=False)


def _turns(fitted: Fitted) -> bool:
    """Whether an effect of this explanation depends on the angle."""
    return any(fitted.candidate.table[name].turns for name in fitted.added)


def _tracked(search: Search, fitted: Fitted) -> Search:
    """The search on targets whose angle is the one that `fitted` simulates."""
    runs = _runs(search, fitted)
    return _along(search, [run["position"] for run in runs])


def _without_the_sensor(search: Search, fitted: Fitted, recorded: Sequence[Target]) -> Search:
    """The search on the recorded angles less the integral of what the sensor of `fitted` adds to the speed."""
    from scipy.integrate import cumulative_trapezoid  # late: the command line starts without it

    angles = []
    for target, run in zip(recorded, _runs(search, fitted), strict=True):
        shown = cumulative_trapezoid(run["speed"], target.time, initial=0.0)
        angles.append(target.angle - (shown - (run["position"] - run["position"][0])))
    return _along(search, angles)


def _runs(search: Search, fitted: Fitted) -> list[dict[str, Array]]:
    problem, active = search.problem, fitted.candidate.active
    return [problem.simulate(t, fitted.vector, active).signals for t in problem.targets]


def _along(search: Search, angles: Sequence[Array]) -> Search:
    pairs = zip(search.problem.targets, angles, strict=True)
    targets = tuple(replace(t, angle=np.ascontiguousarray(a), follows=True) for t, a in pairs)
    return replace(search, problem=replace(search.problem, targets=targets))
