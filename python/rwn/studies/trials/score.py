"""The figures of a set of blind trials, each a share with its count."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rwn.studies.trials.conceal import SINGLE
from rwn.studies.trials.grade import LARGEST_SET, Grade

FEW_INTERVALS = 20
BINS = np.linspace(0.0, 1.0, 6)


@dataclass(frozen=True)
class Share:
    """`hits` of `count`."""

    hits: int
    count: int

    @classmethod
    def of(cls, marks: Iterable[bool]) -> Share:
        listed = list(marks)
        return cls(sum(listed), len(listed))

    def __str__(self) -> str:
        return f"{100.0 * self.hits / self.count:.1f} % ({self.hits}/{self.count})" if self.count else "-"


@dataclass(frozen=True)
class Target:
    """A figure of the score and what is asked of it."""

    name: str
    asked: str
    found: str
    met: bool | None


def single(grades: Sequence[Grade]) -> list[Grade]:
    """One concealed effect that has a name."""
    return [g for g in grades if g.mode in SINGLE and g.truth]


def named_right(grade: Grade) -> bool:
    """First name right or a set of at most three that holds it; at visibility 2 honesty counts too."""
    return grade.right or (grade.level == "2" and grade.honest)


def both_found(grade: Grade) -> bool:
    return set(grade.truth) <= set(grade.names)


def mistakes(grades: Sequence[Grade]) -> dict[str, dict[str, Share | str]]:
    """Of each kind of recording mistake: found under its name, and the physics beneath it right."""
    groups: dict[str, list[Grade]] = {}
    for grade in grades:
        if grade.mistake:
            groups.setdefault(grade.mistake, []).append(grade)
    return {
        kind: {
            "called so": Share.of(g.mistaken[:1] == (kind,) for g in group),
            "or in its set": Share.of(kind in g.mistaken[:LARGEST_SET] for g in group),
            "single effect beneath it right": Share.of(named_right(g) for g in single(group)),
            "false alarms beneath it": Share.of(g.false_alarm for g in group if g.mode == "null"),
        }
        for kind, group in sorted(groups.items())
    }


def _share_target(name: str, asked: str, marks: Iterable[bool], bound: Callable[[float], bool]) -> Target:
    share = Share.of(marks)
    return Target(name, asked, str(share), bound(share.hits / share.count) if share.count else None)


def _at_least(limit: float) -> Callable[[float], bool]:
    return lambda value: value >= limit


def _at_most(limit: float) -> Callable[[float], bool]:
    return lambda value: value <= limit


def _coverage(marks: Iterable[bool]) -> Target:
    """A few intervals cannot show a share between 90 and 98 %."""
    share = Share.of(marks)
    met = 0.9 <= share.hits / share.count <= 0.98 if share.count >= FEW_INTERVALS else None
    return Target("95 % intervals that cover", "90-98 %", str(share), met)


def targets(grades: Sequence[Grade]) -> list[Target]:
    """Every figure that the project promises, with what was reached."""
    ones, doubles = single(grades), [g for g in grades if g.mode == "double"]
    novel = [g for g in grades if g.mode == "novel"]
    high = [g for g in ones if g.level in ("10", "30")]
    removed = [share for g in ones if g.first for share in g.removed]
    median = float(np.median(removed)) if removed else np.nan
    return [
        _share_target("name, visibility 10 and 30", ">= 95 %", map(named_right, high), _at_least(0.95)),
        *(
            _share_target(
                f"name, visibility {level}",
                asked,
                (named_right(g) for g in ones if g.level == level),
                _at_least(limit),
            )
            for level, asked, limit in (("4", ">= 85 %", 0.85), ("2", "right or honest", 1.0))
        ),
        _share_target("equation", ">= 97 %", (g.equation for g in ones), _at_least(0.97)),
        _share_target(
            "false alarms", "<= 3 %", (g.false_alarm for g in grades if g.mode == "null"), _at_most(0.03)
        ),
        _share_target(
            "unnamed given a confident wrong name",
            "<= 10 %",
            (g.confidently_wrong for g in novel),
            _at_most(0.1),
        ),
        _share_target("two effects, both found", ">= 80 %", map(both_found, doubles), _at_least(0.8)),
        _coverage(p.covered for g in grades for p in g.parameters if p.covered is not None),
        Target(
            "median removed held-out error, name right",
            ">= 0.95",
            f"{median:.3f} ({len(removed)} recordings)" if removed else "-",
            median >= 0.95 if removed else None,
        ),
    ]


def brier(grades: Sequence[Grade]) -> tuple[float, int]:
    """Mean squared difference of stated probability and outcome of the first name, where one is given."""
    pairs = [(g.probability, g.first) for g in grades if g.probability is not None]
    if not pairs:
        return np.nan, 0
    return float(np.mean([(p - hit) ** 2 for p, hit in pairs])), len(pairs)


@dataclass(frozen=True)
class Bin:
    low: float
    high: float
    stated: float
    right: Share


def reliability(grades: Sequence[Grade]) -> list[Bin]:
    """Stated probability against the share that was right, in bins of a fifth; no empty bins."""
    return binned([(g.probability, g.first) for g in grades if g.probability is not None])


def binned(pairs: Sequence[tuple[float, bool]]) -> list[Bin]:
    """Pairs of stated probability and outcome, in bins of a fifth; no empty bins."""
    bins = []
    for low, high in pairwise(BINS):
        inside = [(p, hit) for p, hit in pairs if low <= p < high or (high == 1.0 and p == 1.0)]
        if inside:
            stated = float(np.mean([p for p, _ in inside]))
            bins.append(Bin(float(low), float(high), stated, Share.of(hit for _, hit in inside)))
    return bins


def answer_given(grade: Grade) -> str:
    """The column of the confusion matrix."""
    if grade.verdict != "missing-physics":
        return grade.verdict
    return grade.names[0] if grade.names else "no-name"


def confusion(grades: Sequence[Grade]) -> dict[str, dict[str, int]]:
    """Rows: the single effect, unnamed effect or nothing; columns: the first name or verdict given."""
    table: dict[str, dict[str, int]] = {}
    for grade in grades:
        if grade.mode == "double":
            continue
        row = table.setdefault(grade.truth[0] if grade.truth else "(nothing)", {})
        given = answer_given(grade)
        row[given] = row.get(given, 0) + 1
    return dict(sorted(table.items()))


def broken_down(grades: Sequence[Grade], by: Callable[[Grade], str]) -> dict[str, dict[str, Share | str]]:
    """The main figures of single effects for each value of `by`."""
    groups: dict[str, list[Grade]] = {}
    for grade in single(grades):
        groups.setdefault(by(grade), []).append(grade)
    return {
        key: {
            "first name": Share.of(g.first for g in group),
            "exact name": Share.of(g.exact for g in group),
            "name or set": Share.of(g.right for g in group),
            "or honest": Share.of(g.right or g.honest for g in group),
            "equation": Share.of(g.equation for g in group),
            "covered": Share.of(p.covered for g in group for p in g.parameters if p.covered is not None),
            "parameter error": _median([p.error for g in group for p in g.parameters]),
            "removed": _median([share for g in group for share in g.removed]),
        }
        for key, group in sorted(groups.items(), key=lambda item: (len(item[0]), item[0]))
    }


def parameter_errors(grades: Sequence[Grade]) -> dict[str, dict[str, Share | str]]:
    """Median relative error and coverage of each parameter of rightly named effects."""
    groups: dict[str, list[tuple[float, bool | None]]] = {}
    for grade in grades:
        for p in grade.parameters:
            groups.setdefault(f"{p.effect}: {p.name}", []).append((p.error, p.covered))
    return {
        key: {
            "median error": _median([error for error, _ in rows]),
            "covered": Share.of(covered for _, covered in rows if covered is not None),
        }
        for key, rows in sorted(groups.items())
    }


def _median(values: Sequence[float]) -> str:
    return f"{float(np.median(values)):.3g}" if values else "-"
