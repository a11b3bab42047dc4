"""Recordings that differ, as what is one number of the machine is another in each of them."""

from __future__ import annotations

from collections.abc import Sequence

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.measurement.levels import Level, known_levels, level_beside, uneven
from rwn.measurement.unseen_level import explained_by_a_level
from rwn.name.ranking import Ranking
from rwn.recording.inspection import Finding
from rwn.simulate.run import Run


def uneven_files(ranking: Ranking) -> list[Finding]:
    """What is said, by file, of quantities that are fitted apart."""
    problem, best = ranking.weighted, ranking.fits[0].final
    return [finding for level in known_levels(problem) for finding in _said(problem, best, level)]


def uneven_unseen(ranking: Ranking, unseen: Sequence[Run]) -> list[Finding]:
    """What is said, by file, of recordings that were not fitted, of quantities that differ between those that were.

    Each is simulated at the level that fits it best, since the levels of other recordings say nothing of its own.
    """
    problem, best = ranking.weighted.in_free_run(), ranking.fits[0].final
    found = []
    for level in known_levels(problem):
        for run in problem.on(unseen).runs:
            off = level_beside(problem, best, level, run)
            found.append(
                Finding(
                    kind=_kind(level), recording=run.name, signals=(), count=0,
                    words=f"its {level.quantity} is {_off(level, off)} off the mean of the fitted recordings",
                    done="judged at this level, which fits it best; rwn simulate has the mean of corrected.toml",
                )
            )  # fmt: skip
    return found


def contradicting_unseen(ranking: Ranking, unseen: Sequence[Run]) -> list[Finding]:
    """What is said of recordings that were not fitted and contradict those that were in one number alone."""
    problem, best = ranking.weighted.in_free_run(), ranking.fits[0].final
    pairs = [(run.name, explained_by_a_level(problem, best, run)) for run in unseen]
    return [
        Finding(
            kind=_kind(one.level), recording=name, signals=(), count=0, done="judged as it is",
            words=f"its {one.level.quantity} is {_off(one.level, one.off)} off that of the fitted recordings, which "
            "explains all of its error",
        )
        for name, one in pairs
        if one is not None
    ]  # fmt: skip


def _said(problem: Problem, this: Fit, level: Level) -> list[Finding]:
    fitted = "a level of its own is fitted with it; corrected.toml holds the mean"
    if level.lasting:
        fitted += ": leave out what was recorded of another machine, load or temperature"
    return [
        Finding(
            kind=_kind(level), recording=name, signals=(), count=0, done=fitted,
            words=f"its {level.quantity} is {_off(level, off)} off the mean of the recordings "
            f"(deviation {_size(level, deviation)})",
        )
        for name, (off, deviation) in uneven(problem, this, level).items()
    ]  # fmt: skip


def _kind(level: Level) -> str:
    return "files-disagree" if level.lasting else "uneven-load" if level.adds else "uneven-friction"


def _off(level: Level, off: float) -> str:
    return f"{off:+.3g} {level.unit}" if level.adds else f"{float(f'{100.0 * (off - 1.0):.2g}'):+g} %"


def _size(level: Level, deviation: float) -> str:
    return f"{deviation:.1g} {level.unit}" if level.adds else f"{100.0 * deviation:.1g} %"
