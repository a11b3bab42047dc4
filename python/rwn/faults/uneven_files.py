"""Recordings that differ, as what is one number of the machine is another in each of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.measurement.levels import Level, known_levels, level_beside, uneven
from rwn.measurement.unseen_level import explained_by_a_level
from rwn.model.vocabulary import motor_index
from rwn.name.ranking import Ranking
from rwn.recording.inspection import Finding
from rwn.simulate.run import Run

DISAGREE = "files-disagree"  # kind of the finding that a number differs which is one of a machine
JUDGED_AT_ITS_OWN = "judged with its own"  # what is done about a recording that was not fitted


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
                    words=f"its {level.quantity} is {_off(level, off)} off {_of_the_machine(level)}",
                    done=f"{JUDGED_AT_ITS_OWN}, which fits it best; rwn simulate has that of corrected.toml",
                )
            )  # fmt: skip
    return found


def at_own_levels(ranking: Ranking, unseen: Sequence[Run]) -> tuple[tuple[Run, ...], tuple[Finding, ...]]:
    """Recordings that were not fitted, those that contradict the fitted ones in one number alone at their own of it.

    With what is said of them.
    """
    problem, best = ranking.weighted.in_free_run(), ranking.fits[0].final
    runs, found = list(unseen), []
    for k, run in enumerate(unseen):
        one = explained_by_a_level(problem, best, run)
        if one is None:
            continue
        runs[k] = replace(run, own_levels=(one.prior,))
        found.append(
            Finding(
                kind=_kind(one.level), recording=run.name, signals=(), count=0,
                done=f"{JUDGED_AT_ITS_OWN}; corrected.toml has that of the fitted recordings",
                words=f"its {one.level.quantity} is {_off(one.level, one.off)} off that of the fitted recordings, "
                "which explains all of its error",
            )
        )  # fmt: skip
    return tuple(runs), tuple(found)


def _said(problem: Problem, this: Fit, level: Level) -> list[Finding]:
    held = f"that of {level.usual}" if level.usual else "the mean"
    fitted = f"a level of its own is fitted with it; corrected.toml holds {held}"
    if level.lasting:
        fitted += ": leave out what was recorded of another machine, load or temperature"
    return [
        Finding(
            kind=_kind(level), recording=name, signals=(), count=0, done=fitted, quantity=level.quantity, held=held,
            words=f"its {level.quantity} is {_off(level, off)} off {_of_the_machine(level)} "
            f"({_value(problem, this, level, off)}deviation {_size(level, deviation)})",
        )
        for name, (off, deviation) in uneven(problem, this, level).items()
    ]  # fmt: skip


def _of_the_machine(level: Level) -> str:
    return f"that of {level.usual}" if level.usual else "the mean of the recordings that are fitted"


def _kind(level: Level) -> str:
    return DISAGREE if level.lasting else "uneven-load" if level.adds else "uneven-friction"


def _off(level: Level, off: float) -> str:
    return f"{off:+.3g} {level.unit}" if level.adds else f"{float(f'{100.0 * (off - 1.0):.2g}'):+g} %"


def _value(problem: Problem, this: Fit, level: Level, off: float) -> str:
    """The quantity itself where it is one number: "0.000217 kg m^2, "; else nothing."""
    if len(level.parameters) != 1:
        return ""
    mean, drive = float(this.vector[level.parameters[0]]), problem.drive
    if level.adds:
        return f"{mean + off:.3g} {level.unit}, "
    known = next(p for p in drive.parameters if motor_index(p.name) == level.parameters[0])
    unit = known.linear_unit if drive.linear and known.linear_unit else known.unit
    return f"{mean * off:.3g} {unit}, "


def _size(level: Level, deviation: float) -> str:
    return f"{deviation:.1g} {level.unit}" if level.adds else f"{100.0 * deviation:.1g} %"
