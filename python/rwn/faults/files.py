"""Recordings that contradict each other: what is one number of the machine is another in each of them."""

from __future__ import annotations

from rwn.fit.fit import Fit
from rwn.fit.levels import Level, beside_levels, can_differ, friction, uneven
from rwn.fit.likelihood import DECISIVE
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics
from rwn.model.vocabulary import motor_index, motor_parameters
from rwn.name.ranking import Ranking
from rwn.name.weights import log_odds
from rwn.parallel import side_by_side
from rwn.recording.inspection import Finding


def uneven_files(ranking: Ranking) -> list[Finding]:
    """What is said, by file, of friction that is fitted apart, and of the parameter that the files disagree on most.

    Of parameters only where nothing but noise is left then: what is missing differs from file to file as well.
    """
    problem, best = ranking.weighted, ranking.fits[0].final
    apart = "a level of its own is fitted with it; corrected.toml holds the mean"
    found = _said("uneven-friction", problem, best, friction(problem), apart)
    levels = [
        Level(quantity=name.replace("_", " "), parameters=(motor_index(name),))
        for name in problem.prior.uncertainty
        if name in motor_parameters() and name not in problem.drive.friction
    ]
    tried = side_by_side(
        lambda level: _beside(problem, best, level), [level for level in levels if can_differ(problem, level)]
    )
    decisive = [row for row in tried if row[0] > DECISIVE]
    if decisive:
        _, on, this, level = max(decisive, key=lambda row: row[0])
        together = "one value is fitted to all; leave out what was recorded of another machine, load or temperature"
        found += _said("files-disagree", on, this, level, together)
    return found


def _beside(problem: Problem, best: Fit, level: Level) -> tuple[float, Problem, Fit, Level]:
    """Log evidence for a level of each recording, with the fit beside it; 0 where more than noise is left."""
    on, this = beside_levels(problem, best, level)
    left = statistics(on, this)
    return log_odds(this, best, left) if left.at_the_floor else 0.0, on, this, level


def _said(kind: str, problem: Problem, this: Fit, level: Level, done: str) -> list[Finding]:
    return [
        Finding(
            kind=kind, recording=name, signals=(), count=0, done=done,
            words=f"its {level.quantity} is {100.0 * (factor - 1.0):+.2g} % off the mean of the recordings "
            f"(deviation {100.0 * deviation:.1g} %)",
        )
        for name, (factor, deviation) in uneven(problem, this, level).items()
    ]  # fmt: skip
