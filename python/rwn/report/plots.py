"""Plots of the report as Plotly figures (plain JSON)."""

from __future__ import annotations

import base64
import json
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rwn.report import text as words
from rwn.report.diagnosis import Plot, Trace

Array = NDArray[np.float64]

COLOURS = {
    "measured": "#2b2d33",
    "nominal": "#c8384a",
    "refitted": "#e09f3e",
    "corrected": "#0b7285",
    "before": "#c8384a",
    "after": "#0b7285",
    "reference": "#e8590c",
    "noise-floor": "#adb5bd",
}
_DASHES = {"reference": "dash", "noise-floor": "dot", "nominal": "dash"}
_MAX_POINTS = 8000
_FONT = "Inter, 'Helvetica Neue', Arial, sans-serif"


def figure(plot: Plot) -> str:
    """The figure of `plot` as JSON: {"data": [...], "layout": {...}}."""
    x_scale, x_unit = _scale(plot.x_unit, [trace.x for trace in plot.traces])
    y_scale, y_unit = _scale(plot.y_unit, [trace.y for trace in plot.traces if trace.role != "reference"])
    data = [line for trace in plot.traces for line in _lines(trace, x_scale, y_scale)]
    layout = {
        "font": {"family": _FONT, "size": 13, "color": "#343a40"},
        "margin": {"l": 68, "r": 18, "t": 34, "b": 48},
        "height": 340,
        "paper_bgcolor": "white",
        "plot_bgcolor": "white",
        "hovermode": "closest",
        "legend": {
            "itemsizing": "constant",
            "orientation": "h",
            "x": 0,
            "y": 1.02,
            "yanchor": "bottom",
            "bgcolor": "rgba(0,0,0,0)",
        },
        "xaxis": _axis(plot.x_label, x_unit),
        "yaxis": {**_axis(plot.y_label, y_unit), "type": "log" if plot.log_y else "linear"},
        "shapes": [_mark(mark.low * x_scale, mark.high * x_scale) for mark in plot.marks],
        "annotations": [_label(mark.low * x_scale, mark.high * x_scale, mark.label) for mark in plot.marks],
    }
    return json.dumps({"data": data, "layout": layout}, separators=(",", ":")).replace("<", "\\u003c")


def _scale(unit: str, values: list[Array]) -> tuple[float, str]:
    largest = max((float(np.nanmax(np.abs(v))) for v in values if np.isfinite(v).any()), default=0.0)
    return words.prefix_for(largest, unit)


def _axis(label: str, unit: str) -> dict[str, Any]:
    label = label[:1].upper() + label[1:]
    return {
        "title": {"text": f"{label} [{unit}]" if unit else label, "standoff": 8},
        "gridcolor": "#e9ecef",
        "zerolinecolor": "#ced4da",
        "linecolor": "#adb5bd",
        "ticks": "outside",
        "tickcolor": "#adb5bd",
        "automargin": True,
    }


def _mark(low: float, high: float) -> dict[str, Any]:
    return {
        "type": "rect",
        "xref": "x",
        "yref": "paper",
        **{"x0": low, "x1": high, "y0": 0, "y1": 1},
        "fillcolor": "#ffd43b",
        "opacity": 0.22,
        "line": {"width": 0},
        "layer": "below",
    }


def _label(low: float, high: float, text: str) -> dict[str, Any]:
    place = {"x": (low + high) / 2, "y": 0.99, "xref": "x", "yref": "paper", "yanchor": "top"}
    return {**place, "text": text, "showarrow": False, "font": {"size": 11, "color": "#8a6d00"}}


def _lines(trace: Trace, x_scale: float, y_scale: float) -> list[dict[str, Any]]:
    colour = COLOURS[trace.role]
    kept = _kept(trace)
    x = trace.x[kept] * x_scale
    style: dict[str, Any] = {"type": "scatter", "name": trace.name, "x": _packed(x)}
    if trace.points:
        marker = {"color": colour, "size": 4, "opacity": 0.45}
        style |= {"mode": "markers", "marker": marker}
    else:
        width = 1.4 if trace.role in ("measured", "before", "after") else 1.8
        style |= {
            "mode": "lines",
            "line": {"color": colour, "width": width, "dash": _DASHES.get(trace.role, "solid")},
        }
    lines = [{**style, "y": _packed(trace.y[kept] * y_scale)}]
    if trace.low is not None and trace.high is not None:
        edge = {
            "type": "scatter",
            "mode": "lines",
            "line": {"width": 0},
            "showlegend": False,
            "hoverinfo": "skip",
        }
        upper = {**edge, "x": _packed(x), "y": _packed(trace.high[kept] * y_scale)}
        lower = {**edge, "x": _packed(x), "y": _packed(trace.low[kept] * y_scale)}
        lines = [upper, {**lower, "fill": "tonexty", "fillcolor": _faint(colour)}, *lines]
    return lines


def _kept(trace: Trace) -> NDArray[np.intp]:
    """Which samples to draw: all, or the extremes of equal stretches so that no spike is lost."""
    n = len(trace.x)
    if n <= _MAX_POINTS:
        return np.arange(n)
    if trace.points:
        return np.linspace(0, n - 1, _MAX_POINTS).astype(np.intp)
    edges = np.linspace(0, n, _MAX_POINTS // 2 + 1).astype(np.intp)
    filled = np.where(np.isfinite(trace.y), trace.y, 0.0)
    pairs = [(a + int(np.argmin(filled[a:b])), a + int(np.argmax(filled[a:b]))) for a, b in pairwise(edges)]
    return np.unique(np.array(pairs, dtype=np.intp))


def _packed(values: Array) -> dict[str, str]:
    """A typed array as Plotly reads it: small, and NaN breaks the line."""
    return {"dtype": "f4", "bdata": base64.b64encode(values.astype("<f4").tobytes()).decode("ascii")}


def _faint(colour: str) -> str:
    red, green, blue = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return f"rgba({red},{green},{blue},0.15)"
