"""What differs from recording to recording: friction, as a gear warms up, or the load that hangs on the drive.

Each recording then has a level of its own, a factor on one quantity or what is added to it, as an unknown of the
measurement. Whether they do differ is asked beside the best explanation, since what is missing of it may differ too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.intervals import AGREEMENT, covariance
from rwn.fit.prior import RunUnknown
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics
from rwn.model.vocabulary import motor_index, motor_parameters
from rwn.simulate.own_unknowns import LevelShare
from rwn.simulate.run import Run

Array = NDArray[np.float64]

# prior deviation of a level's logarithm: friction that halves, as a gear warms up, is 2.3 of it; of a load, as a share
# of the largest torque
SPREAD = 0.3
ITERATIONS = 10  # of a fit that begins near its end
DRY = "N m"  # the unit of a friction that does not depend on the speed
APART = 3.0  # deviations from the mean of all, from which a recording is said to differ: one in 370 by chance


@dataclass(frozen=True, kw_only=True)
class Level:
    """A quantity that may differ from recording to recording."""

    quantity: str
    parameters: tuple[int, ...]  # indices of what a factor on it scales, or of what it adds to
    unit: str = "1"  # of what is added
    adds: bool = False
    lasting: bool = False  # it is one number of a machine: recordings in which it differs contradict each other
    usual: str = ""  # the recording whose quantity is the machine's; none: the mean of all

    def of(self, recording: str) -> str:
        """The name of its unknown of one recording."""
        return f"{self.quantity} of {recording}"

    def contrasts(self, recordings: Sequence[str]) -> Array:
        """What takes levels (n,) of recordings to those beside the machine's, (n, n)."""
        machine = [float(name == self.usual) for name in recordings] if self.usual else [1.0 / len(recordings)]
        off: Array = np.eye(len(recordings)) - np.array(machine)
        return off


def friction(problem: Problem) -> Level:
    """The level of dry and viscous friction: of the nominal model, and of the effects that take its place."""
    return frictions(problem)[0]


def frictions(problem: Problem) -> list[Level]:
    """All friction, which is warm or cold, and each of its parts: a seal's may change where that of grease does not."""
    names = problem.drive.friction
    dry = [name for name in names if motor_parameters()[name].unit == DRY]
    instead = [e for e in problem.prior.table.values() if any(p.replaces in names for p in e.parameters)]
    torques = tuple(e.at(p.name) for e in instead for p in e.parameters if p.unit == DRY) if names else ()
    rubs, drags = (*map(motor_index, dry), *torques), tuple(motor_index(name) for name in names if name not in dry)
    return [
        Level(quantity="friction", parameters=(*drags, *rubs)),
        Level(quantity="dry friction", parameters=rubs),
        Level(quantity="viscous friction", parameters=drags),
    ]


def load(problem: Problem) -> Level:
    """The level of a load that stays the same along a recording."""
    steady = [e for e in problem.prior.table.values() if e.steady and e.site in problem.drive.sites]
    places = tuple(e.at(p.name) for e in steady for p in e.parameters)
    unit = problem.drive.unit_of(steady[0], steady[0].parameters[0].unit) if steady else "1"
    return Level(quantity="load", parameters=places, unit=unit, adds=True)


def all_levels(problem: Problem) -> list[Level]:
    """What may differ: friction and load, which do on one machine, and every uncertain number of the machine."""
    pairs = [(pair.name, pair.like) for pair in problem.drive.one_numbers]
    one = {name: pair for pair in pairs if set(pair) <= set(problem.prior.uncertainty) for name in pair}
    names = [n for n in problem.prior.uncertainty if n in motor_parameters() and n not in problem.drive.friction]
    numbers = dict.fromkeys(one.get(name, (name,)) for name in names)
    lasting = [
        Level(quantity=_in_words(of), parameters=tuple(map(motor_index, of)), lasting=True) for of in numbers
    ]  # fmt: skip
    return [*frictions(problem), load(problem), *lasting]


def as_described(problem: Problem, this: Fit, level: Level) -> Level:
    """The level whose machine is the one that was described: the recording that is nearest to what was declared of it.

    The mean is no machine's, and corrected.toml is to hold one that there is. Friction and loads, which change on one
    machine, keep their mean.
    """
    declared = {motor_index(name): value for name, value in problem.prior.motor.items() if level.lasting}
    given = declared.get(level.parameters[0], 0.0)
    if given <= 0.0:
        return level
    names = list(dict.fromkeys(run.name for run in problem.whole))
    values = dict(zip((u.name for u in this.hypothesis.unknowns), this.minimum.values, strict=True))
    beside = level.contrasts(names) @ np.array([values[level.of(name)] for name in names])
    away = np.abs(np.log(this.vector[level.parameters[0]] / given) + beside)
    return replace(level, usual=names[int(np.argmin(away))])


def level_off(level: Level, machine: Array, own: Array) -> float:
    """The quantity of parameters (all,) over that of others; less it, of what is added."""
    if level.adds:
        return float(own[level.parameters[0]] - machine[level.parameters[0]])
    scaled = [p for p in level.parameters if machine[p] != 0.0]
    return float(own[scaled[0]] / machine[scaled[0]]) if scaled else 1.0


def level_spread(problem: Problem, level: Level) -> float:
    """Prior deviation of a level."""
    return SPREAD * problem.scales["torque"] if level.adds else SPREAD


def _in_words(names: Sequence[str]) -> str:
    return " and ".join(name.replace("_", " ") for name in names)


def known_levels(problem: Problem) -> list[Level]:
    """What does differ: the levels that are unknowns of a problem."""
    usual = {own.name: own.usual for own in problem.prior.of_runs if own.level}
    known = [(level, level.of(problem.whole[0].name)) for level in all_levels(problem) if is_known(problem, level)]
    return [replace(level, usual=usual[name]) for level, name in known]


def is_known(problem: Problem, level: Level) -> bool:
    """Whether a level is an unknown of each recording."""
    return any(own.name == level.of(run.name) for own in problem.prior.of_runs for run in problem.whole)


def can_differ(problem: Problem, level: Level) -> bool:
    """Whether there are several recordings of a drive with such a quantity, and no part of it is unknown of each."""
    parts = [set(own.parameters) for own in problem.prior.of_runs if own.level]
    return len(problem.whole) > 1 and bool(level.parameters) and not any(p <= set(level.parameters) for p in parts)


def with_levels(problem: Problem, level: Level) -> Problem:
    """The problem with a level of a quantity for each recording among what is unknown.

    A recording has the quantity times its own level over their geometric mean, or plus its level less their mean: the
    mean is the parameter's, which the data sheet knows, and no level's. Where one recording is the machine's, its level
    stands for the mean.
    """
    first = _core.parameter_count() + len(problem.prior.of_runs)
    names = dict.fromkeys(run.name for run in problem.whole)
    spread = level_spread(problem, level)
    own = [
        RunUnknown(
            name=level.of(name), unit=level.unit, place=first + k, parameters=level.parameters, spread=spread,
            level=True, adds=level.adds, usual=level.usual,
        )
        for k, name in enumerate(names)
    ]  # fmt: skip
    shares = {
        name: tuple(LevelShare(u.place, float(x), level.parameters, level.adds) for u, x in zip(own, row, strict=True))
        for name, row in zip(names, level.contrasts(list(names)), strict=True)
    }

    def placed(runs: Sequence[Run]) -> tuple[Run, ...]:
        return tuple(replace(run, levels=(*run.levels, *shares[run.name])) for run in runs)

    prior = replace(problem.prior, of_runs=(*problem.prior.of_runs, *own))
    return replace(problem, runs=placed(problem.runs), whole=placed(problem.whole), prior=prior)


def beside_levels(problem: Problem, this: Fit, level: Level) -> tuple[Problem, Fit]:
    """The problem with levels, and an explanation refitted beside them."""
    on = with_levels(problem, level)
    begun = hypothesis(on.prior, this.added, on.scales, this.starts(this.added), this.motor)
    return on, fit(on, begun, max_iterations=ITERATIONS)


def uneven(problem: Problem, this: Fit, level: Level) -> dict[str, tuple[float, float]]:
    """The quantity of each recording over the machine's, with a deviation, of those that certainly differ.

    Less the machine's, of what is added.
    """
    unknowns = [u.name for u in this.hypothesis.unknowns]
    names = [run.name for run in problem.whole if level.of(run.name) in unknowns]
    places = [unknowns.index(level.of(name)) for name in names]
    if not places:
        return {}
    contrasts = level.contrasts(names)
    off = contrasts @ this.minimum.values[places]
    spread = contrasts @ covariance(this, statistics(problem, this))[np.ix_(places, places)] @ contrasts
    # no level is better known than any other number of a fit
    whole = float(np.ptp(off)) if level.adds else 1.0
    deviations = np.hypot(np.sqrt(np.maximum(np.diag(spread), 0.0)), AGREEMENT * whole)
    rows = [(name, x, d) for name, x, d in zip(names, off, deviations, strict=True) if abs(x) > APART * d]
    if level.adds:
        return {name: (float(x), float(d)) for name, x, d in rows}
    return {name: (float(np.exp(x)), float(np.exp(x) * d)) for name, x, d in rows}


def level_beside(problem: Problem, this: Fit, level: Level, run: Run) -> float:
    """The quantity of one recording over that of the machine, as a fit has both; less it, of what is added."""
    return level_off(level, this.vector, problem.started(run, this.vector, this.active))
