"""The figures of a set of bench trials, what is asked of each beside it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from rwn.studies.trials.bench_trials.grade import BenchGrade
from rwn.studies.trials.bench_trials.plan import BACKGROUND_ALONE, NOTHING
from rwn.studies.trials.score import FEW_INTERVALS, Bin, Share, Target, binned

SURE = 0.5  # a name stated with more than this is a claim
CLEAR, VISIBLE = 10.0, 4.0
BRIER = 0.06

Keys = Callable[[BenchGrade], Sequence[str]]

BREAKDOWNS: dict[str, Keys] = {
    "imperfection": lambda g: g.kinds,
    "background": lambda g: (g.background or "none",),
    "judge": lambda g: (g.judge,),
    "mode": lambda g: (g.mode,),
    "named effects": lambda g: (str(len(g.truth)),),
    "effect": lambda g: g.truth,
}


def targets(grades: Sequence[BenchGrade]) -> list[Target]:
    """Every figure that is asked of the tool on a bench, with what was reached."""
    named = [g for g in grades if g.named]
    value, count = brier(grades)
    return [
        _least("name right (or in a set of 3), visibility >= 10", 0.9, _right(named, CLEAR)),
        _least("name right (or in a set of 3), visibility >= 4", 0.8, _right(named, VISIBLE)),
        _most("nothing missing: a name above 0.5", 0.03, (_claims(g) for g in grades if g.mode == NOTHING)),
        _most(
            "missing without a name: a name above 0.5", 0.05, (_claims(g) for g in grades if g.mode == BACKGROUND_ALONE)
        ),
        _most("named effects: a wrong name above 0.5", 0.05, map(_claims, named)),
        _coverage(p.covered for g in grades for p in g.parameters if p.covered is not None),
        Target(
            "Brier, everything stated", f"<= {BRIER:g}", f"{value:.3f} ({count} statements)" if count else "-",
            value <= BRIER if count else None,
        ),
        _most("corrected worse than refitted, held out", 0.02, (worse for g in grades for worse in g.worse)),
    ]  # fmt: skip


def _right(named: Sequence[BenchGrade], visibility: float) -> Iterable[bool]:
    return (g.right for g in named if g.visibility >= visibility)


def _claims(grade: BenchGrade) -> bool:
    return bool(grade.wrong_above(SURE))


def _least(name: str, limit: float, marks: Iterable[bool]) -> Target:
    share = Share.of(marks)
    met = share.hits >= limit * share.count if share.count else None
    return Target(name, f">= {100.0 * limit:g} %", str(share), met)


def _most(name: str, limit: float, marks: Iterable[bool]) -> Target:
    share = Share.of(marks)
    met = share.hits <= limit * share.count if share.count else None
    return Target(name, f"<= {100.0 * limit:g} %", str(share), met)


def _coverage(marks: Iterable[bool]) -> Target:
    share = Share.of(marks)
    met = 0.9 <= share.hits / share.count <= 0.98 if share.count >= FEW_INTERVALS else None
    return Target("95 % intervals that cover", "90-98 %", str(share), met)


def statements(grades: Sequence[BenchGrade]) -> list[tuple[float, bool]]:
    """Probability and truth of everything stated."""
    return [(s.probability, s.right) for g in grades for s in g.stated]


def brier(grades: Sequence[BenchGrade]) -> tuple[float, int]:
    """Mean squared difference of stated probability and outcome, and the number of statements."""
    pairs = statements(grades)
    return (float(np.mean([(p - right) ** 2 for p, right in pairs])), len(pairs)) if pairs else (np.nan, 0)


def reliability(grades: Sequence[BenchGrade]) -> list[Bin]:
    """Stated probability against the share that was right; no empty bins."""
    return binned(statements(grades))


def broken_down(grades: Sequence[BenchGrade], keys: Keys) -> dict[str, dict[str, str]]:
    """The main figures of the trials with each key; a trial counts for every key that it has."""
    groups: dict[str, list[BenchGrade]] = {}
    for grade in grades:
        for key in keys(grade):
            groups.setdefault(key, []).append(grade)
    return {
        key: {
            "trials": str(len(group)),
            "right at >= 10": str(Share.of(_right([g for g in group if g.named], CLEAR))),
            "right at >= 4": str(Share.of(_right([g for g in group if g.named], VISIBLE))),
            "wrong name above 0.5": str(Share.of(map(_claims, group))),
            "covered": str(Share.of(p.covered for g in group for p in g.parameters if p.covered is not None)),
            "Brier": f"{brier(group)[0]:.3f}" if brier(group)[1] else "-",
            "corrected worse": str(Share.of(worse for g in group for worse in g.worse)),
        }
        for key, group in sorted(groups.items())
    }


def missed(grade: BenchGrade) -> bool:
    """Whether it counts against a target."""
    unseen = grade.named and not grade.right and grade.visibility >= VISIBLE
    return unseen or _claims(grade) or any(grade.worse)
