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
    wanted: for the judge `wanted`, the value to reach; for `claim`, the share of cases that must hold.
    group: rows of one group must keep the thesis's order to count as `trend`.
    reason: the measured cause, shown where the word is not the best one.
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
    """One pair of axes: curves, or one surface."""

    xlabel: str = ""
    ylabel: str = ""
    title: str = ""
    curves: list[Curve] = field(default_factory=list)
    surface: Surface | None = None
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
class Outcome:
    """Rows and figures of one run of an experiment."""

    rows: list[Row]
    figures: list[Figure] = field(default_factory=list)


@dataclass(frozen=True)
class Settings:
    """How to run: at a reduced count (for tests), and where to report progress (share done, 0 to 1)."""

    reduced: bool = False
    progress: Callable[[float], None] = lambda _: None

    def pick(self, full: int, reduced: int) -> int:
        """The count to use."""
        return reduced if self.reduced else full


@dataclass(frozen=True, kw_only=True)
class Experiment:
    """An experiment: `run(settings)`; the choices the thesis leaves open are the docstring of the file of
    `run`."""

    name: str
    title: str
    run: Callable[[Settings], Outcome]
    tables: tuple[int, ...] = ()
    figures: tuple[int, ...] = ()

    @property
    def choices(self) -> str:
        """The text at the top of the experiment's file."""
        return sys.modules[self.run.__module__].__doc__ or ""


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


def median_row(where: str, case: str, thesis: float | None, values: Sequence[float], **rest: object) -> Row:
    """A row of the median over seeds; a run that diverged counts as infinite."""
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
