"""The word of a row, computed from its numbers: one function per judge and one entry in the registry."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rwn.studies.thesis.experiment import Row

REPRODUCED, BETTER = "reproduced", "better than printed"
TREND, NOT_REPRODUCIBLE = "trend", "not reproducible"
WORDS = (REPRODUCED, BETTER, TREND, NOT_REPRODUCIBLE)


def factor_2(row: Row, group: Sequence[Row]) -> str:
    """Reproduced within a factor of 2; better where ours is smaller still; else trend if the row's group keeps the
    thesis's order."""
    if row.ours is None or row.thesis is None:
        return NOT_REPRODUCIBLE
    if 0 <= row.ours < 0.5 * row.thesis:
        return BETTER
    return REPRODUCED if 0 < row.ours <= 2.0 * row.thesis else _trend(row, group)


def percentage_point(row: Row, group: Sequence[Row]) -> str:
    """Reproduced within one percentage point; better where our error is smaller still; else trend if the row's
    group keeps the thesis's order."""
    if row.ours is None or row.thesis is None:
        return NOT_REPRODUCIBLE
    if abs(row.ours - row.thesis) <= 1.0:
        return REPRODUCED
    return BETTER if abs(row.ours) < abs(row.thesis) else _trend(row, group)


def wanted(row: Row, group: Sequence[Row]) -> str:  # noqa: ARG001
    """Reached if our number is at or below the wanted one."""
    reached = row.ours is not None and row.wanted is not None and row.ours <= row.wanted
    return "reached" if reached else "not reached"


def claim(row: Row, group: Sequence[Row]) -> str:  # noqa: ARG001
    """Holds if our share is at least the wanted one, in part if above one half."""
    if row.ours is None or row.wanted is None:
        return "does not hold"
    return "holds" if row.ours >= row.wanted else "holds in part" if row.ours > 0.5 else "does not hold"


def coverage(row: Row, group: Sequence[Row]) -> str:  # noqa: ARG001
    """Reached if the share of 95 % intervals that hold the truth is 90 to 98 %."""
    return "reached" if row.ours is not None and 0.90 <= row.ours <= 0.98 else "not reached"


def none(row: Row, group: Sequence[Row]) -> str:  # noqa: ARG001
    """A number beside the comparison."""
    return ""


JUDGES: dict[str, Callable[[Row, Sequence[Row]], str]] = {
    "factor-2": factor_2,
    "percentage-point": percentage_point,
    "wanted": wanted,
    "claim": claim,
    "coverage": coverage,
    "none": none,
}


def word(row: Row, rows: Sequence[Row]) -> str:
    """The word of a row among all rows of its experiment."""
    group = [other for other in rows if row.group and other.group == row.group]
    return JUDGES[row.judge](row, group)


def _trend(row: Row, group: Sequence[Row]) -> str:
    """Every pair of this row with another of its group is ordered as in the thesis."""
    pairs = [(other.thesis, other.ours) for other in group if other is not row and other.thesis != row.thesis]
    if row.ours is None or row.thesis is None or not pairs:
        return NOT_REPRODUCIBLE
    kept = all(
        ours is not None and thesis is not None and (ours > row.ours) == (thesis > row.thesis)
        for thesis, ours in pairs
    )
    return TREND if kept else NOT_REPRODUCIBLE
