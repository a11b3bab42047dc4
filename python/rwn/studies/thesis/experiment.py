"""What an experiment is, and what it leaves behind: rows of a comparison table and figures as data."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike


@dataclass(frozen=True, kw_only=True)
class Row:
    """One line of the comparison.

    where: "Table 1", "Figure 30".  case: what the line is about.
    thesis: the thesis's number, None where it gives none.
    ours: our number (the median over seeds), None if the run diverged or could not be done; `missing` says it.
    spread: smallest and largest over the seeds.
    count: iterations, cycles, seeds, in words.
    judge: how the word is computed, a name in `rwn.studies.thesis.words`.
    answer: this row, and no other, speaks for a number of the thesis; other readings of the same number are asides.
    wanted: for the judge `wanted`, the value to reach; for `claim`, the share of cases that must hold.
    group: rows of one group must keep the thesis's order to count as `trend`.
    reason: what the run says of itself, shown where the word is not the best one; the causes of the thesis's numbers
    are in `rwn.studies.thesis.causes`.
    unit: "" for a mean squared error, "%" for a parameter error, "s" for a time.
    """

    where: str
    case: str
    thesis: float | None = None
    ours: float | None
    spread: tuple[float, float] | None = None
    count: str = ""
    judge: Literal["factor-2", "percentage-point", "wanted", "claim", "coverage", "none"] = "factor-2"
    wanted: float | None = None
    group: str = ""
    reason: str = ""
    unit: str = ""
    missing: str = "diverged"
    answer: bool = False


@dataclass(frozen=True, kw_only=True)
class Curve:
    """A line, or points when `style` says so ("-", "--", ".", "k-" as in matplotlib)."""

    x: list[float]
    y: list[float]
    label: str = ""
    style: str = "-"


@dataclass(frozen=True, kw_only=True)
class Surface:
    """z (len(y), len(x)) over a grid; drawn as a surface or, flat, as a colour map between `limits`."""

    x: list[float]
    y: list[float]
    z: list[list[float]]
    label: str = ""
    flat: bool = False
    log: bool = False
    limits: tuple[float, float] | None = None


@dataclass(frozen=True, kw_only=True)
class Panel:
    """One pair of axes: curves, or one surface; `thesis`: its own numbers by label, drawn as level lines."""

    xlabel: str = ""
    ylabel: str = ""
    title: str = ""
    curves: list[Curve] = field(default_factory=list)
    surface: Surface | None = None
    thesis: dict[str, float] = field(default_factory=dict)
    log_x: bool = False
    log_y: bool = False


@dataclass(frozen=True, kw_only=True)
class Figure:
    """A picture to hold beside the thesis's; `number` as there, or None for one of ours, then `name` is its
    file."""

    number: int | None
    title: str
    panels: list[Panel]
    name: str = ""

    @property
    def stem(self) -> str:
        """File name without suffix."""
        return self.name or f"figure_{self.number:02d}"


@dataclass(frozen=True, kw_only=True)
class Search:
    """What becomes of some of the thesis's numbers under choices that it leaves open.

    numbers: the thesis's, by label.  lines: for each choice our numbers in that order, None where a run diverged.
    taken: the choice that the experiment takes.  count: seeds and iterations, in words.
    """

    title: str
    numbers: dict[str, float]
    lines: dict[str, list[float | None]]
    taken: str
    count: str = ""
    unit: str = ""

    def near(self, choice: str) -> int:
        """How many numbers the choice reproduces: within a factor of 2, in percent within one point."""
        pairs = zip(self.numbers.values(), self.lines[choice], strict=True)
        if self.unit == "%":
            return sum(ours is not None and abs(ours - thesis) <= 1.0 for thesis, ours in pairs)
        return sum(ours is not None and 0.5 <= ours / thesis <= 2.0 for thesis, ours in pairs)


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """Rows, figures and searches of one run of an experiment."""

    rows: list[Row]
    figures: list[Figure] = field(default_factory=list)
    searches: list[Search] = field(default_factory=list)


Count = Literal["full", "quick", "tiny"]
SHORTER = 20  # times shorter than the full counts are the quick ones


@dataclass(frozen=True)
class Settings:
    """How to run: at which counts (`tiny` ones are for tests), where to report progress (share done, 0 to 1), and from
    how many starts (seeds) the trainings that take all of the thesis's cycles."""

    count: Count = "full"
    progress: Callable[[float], None] = lambda _: None
    seeds: int = 1

    def pick(self, full: int, tiny: int) -> int:
        """The count to use."""
        return {"full": full, "quick": max(full // SHORTER, tiny), "tiny": tiny}[self.count]


@dataclass(frozen=True, kw_only=True)
class Experiment:
    """An experiment: `run(settings)`; the choices the thesis leaves open are the docstring of the file of
    `run`. `minutes` of one core at full counts, roughly, weigh the time that is left; `seed_minutes` is what every
    start after the first costs, 0 where `Settings.seeds` means nothing."""

    name: str
    title: str
    run: Callable[[Settings], Outcome]
    tables: tuple[int, ...] = ()
    figures: tuple[int, ...] = ()
    minutes: float = 0.2
    seed_minutes: float = 0.0

    def minutes_of(self, seeds: int) -> float:
        """Minutes of one core with so many starts."""
        return self.minutes + (seeds - 1) * self.seed_minutes

    @property
    def module(self) -> str:
        """The module of `run`."""
        return self.run.__module__

    @property
    def choices(self) -> str:
        """The text at the top of the experiment's file."""
        return sys.modules[self.module].__doc__ or ""


def curve(y: ArrayLike, x: ArrayLike | None = None, *, label: str = "", style: str = "-") -> Curve:
    """A curve of at most about 400 points: long histories are thinned evenly on a logarithmic index."""
    ys = np.asarray(y, dtype=float)
    xs = np.arange(len(ys), dtype=float) if x is None else np.asarray(x, dtype=float)
    if len(ys) > 400 and x is None:
        keep = np.unique(np.geomspace(1, len(ys), 400).astype(int) - 1)
        xs, ys = xs[keep], ys[keep]
    elif len(ys) > 2000:
        keep = np.linspace(0, len(ys) - 1, 2000).astype(int)
        xs, ys = xs[keep], ys[keep]
    return Curve(x=xs.tolist(), y=ys.tolist(), label=label, style=style)


def band(histories: Sequence[ArrayLike], x: ArrayLike | None = None, *, label: str = "") -> list[Curve]:
    """Median over seeds of histories of one length, and dotted its smallest and largest."""
    values = np.array([np.asarray(h, dtype=float) for h in histories])
    middle = curve(np.median(values, axis=0), x, label=label)
    if len(values) == 1:
        return [middle]
    return [middle, curve(values.min(axis=0), x, style=":"), curve(values.max(axis=0), x, style=":")]


def median_row(where: str, case: str, thesis: float | None, values: Sequence[float], **rest: object) -> Row:
    """A row of the median over seeds, with its range; a run that diverged counts as infinite."""
    finite = np.where(np.isfinite(values), values, np.inf)
    median = float(np.median(finite))
    spread = (float(finite.min()), float(finite.max()))
    return Row(
        where=where,
        case=case,
        thesis=thesis,
        ours=median if np.isfinite(median) else None,
        spread=spread if np.isfinite(spread[1]) else None,
        **rest,  # type: ignore[arg-type]
    )
