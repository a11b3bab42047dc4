"""A picture in words, for who cannot see it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.report import text as words
from rwn.report.plot import Plot

Array = NDArray[np.float64]


def in_words(plots: Sequence[Plot]) -> str:
    """What the panels of a picture show: axes with their ranges, and each line with the range of its values."""
    return " ".join(_one(plot) for plot in plots)


def _one(plot: Plot) -> str:
    x = np.concatenate([trace.x for trace in plot.traces]) if plot.traces else np.zeros(1)
    lines = [
        f"{trace.name} ({'points' if trace.points else 'line'}) {_range(trace.y, plot.y_unit)}" for trace in plot.traces
    ]
    marks = [
        f"{mark.label} at {_range(np.array([mark.low, mark.high]), plot.x_unit)}" for mark in plot.marks if mark.label
    ]
    axes = f"{words.capital(plot.y_label)} over {plot.x_label}, {_range(x, plot.x_unit)}"
    said = f"{plot.title}. {axes}: {'; '.join(lines)}."
    return f"{said} {words.capital('; '.join(marks))}." if marks else said


def _range(values: Array, unit: str) -> str:
    values = values[np.isfinite(values)]
    if not values.size:
        return "without values"
    low, high = float(values.min()), float(values.max())
    scale, shown = words.prefix_for(max(abs(low), abs(high)), unit)
    return f"{words.number(low * scale)} to {words.number(high * scale)} {shown}".strip()
