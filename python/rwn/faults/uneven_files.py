"""Recordings that contradict each other: what is one number of the machine is another in each of them."""

from __future__ import annotations

from collections.abc import Sequence

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.measurement.levels import Level, can_differ, friction, level_beside, uneven
from rwn.model.vocabulary import motor_index, motor_parameters
from rwn.name.ranking import Ranking
from rwn.name.uneven import uneven_beside
from rwn.parallel import side_by_side
from rwn.recording.inspection import Finding
from rwn.simulate.run import Run


def uneven_files(ranking: Ranking) -> list[Finding]:
    """What is said, by file, of friction that is fitted apart, and of the parameter that the files disagree on most.

    A parameter is said only where a value of its own in each file leaves nothing but noise: physics that is missing
    makes parameters differ from file to file as well.
    """
    problem, best = ranking.weighted, ranking.fits[0].final
    fitted = "a level of its own is fitted with it; corrected.toml holds the mean"
    found = _said("uneven-friction", problem, best, friction(problem), fitted)
    levels = [
        Level(quantity=name.replace("_", " "), parameters=(motor_index(name),))
        for name in problem.prior.uncertainty
        if name in motor_parameters() and name not in problem.drive.friction
    ]
    asked = [level for level in levels if can_differ(problem, level)]
    tried = side_by_side(lambda level: (level, uneven_beside(problem, best, level)), asked)
    decisive = [row for row in tried if row[1].is_decisive and row[1].left.at_the_floor]
    if decisive:
        level, apart = max(decisive, key=lambda row: row[1].log_odds)
        together = "one value is fitted to all; leave out what was recorded of another machine, load or temperature"
        found += _said("files-disagree", apart.problem, apart.fit, level, together)
    return found


def uneven_unseen(ranking: Ranking, unseen: Sequence[Run]) -> list[Finding]:
    """What is said, by file, of friction in recordings that were not fitted, where it differs between those that were.

    Each is simulated at the level that fits it best, since the levels of other recordings say nothing of its own.
    """
    problem, best = ranking.weighted.in_free_run(), ranking.fits[0].final
    level = friction(problem)
    if not (level.parameters and problem.prior.levels):
        return []
    found = []
    for run in problem.on(unseen).runs:
        factor = level_beside(problem, best, level, run)
        found.append(
            Finding(
                kind="uneven-friction", recording=run.name, signals=(), count=0,
                words=f"its {level.quantity} is {100.0 * (factor - 1.0):+.2g} % off the mean of the fitted recordings",
                done="judged at this level, which fits it best; rwn simulate has the mean of corrected.toml",
            )
        )  # fmt: skip
    return found


def _said(kind: str, problem: Problem, this: Fit, level: Level, done: str) -> list[Finding]:
    return [
        Finding(
            kind=kind, recording=name, signals=(), count=0, done=done,
            words=f"its {level.quantity} is {100.0 * (factor - 1.0):+.2g} % off the mean of the recordings "
            f"(deviation {100.0 * deviation:.1g} %)",
        )
        for name, (factor, deviation) in uneven(problem, this, level).items()
    ]  # fmt: skip
