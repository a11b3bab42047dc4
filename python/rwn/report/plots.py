"""Plots of the report as Plotly figures (plain JSON)."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rwn.errors import InputError
from rwn.report import text as words
from rwn.report.plot import Plot, Role, Trace

if TYPE_CHECKING:
    import plotly.graph_objects

Array = NDArray[np.float64]

# Told apart by dash and width as well as by colour.
COLOURS: dict[Role, str] = {
    "measured": "#4a4f57",
    "nominal": "#8a6d00",
    "refitted": "#c2410c",
    "corrected": "#0b62a8",
    "before": "#c2410c",
    "after": "#0b62a8",
    "reference": "#7a3e9d",
    "noise-floor": "#8b9096",
}
_DASHES: dict[Role, str] = {
    "reference": "dash",
    "noise-floor": "dot",
    "nominal": "dot",
    "refitted": "dash",
    "before": "dash",
}
_WIDTHS: dict[Role, float] = {"measured": 1.2, "before": 1.1, "after": 1.6, "corrected": 2.0, "refitted": 1.6}
_INK, _GRID, _LINE, _MARK, _MARK_TEXT = "#343a40", "#e4e7ea", "#9aa1a8", "#ffd43b", "#6b5300"
DARK = {  # what stands for each colour on a dark page
    "#4a4f57": "#c9ced6", "#8a6d00": "#d8b840", "#c2410c": "#ff9a62", "#0b62a8": "#6cb8ff", "#7a3e9d": "#d0a2f0",
    "#8b9096": "#8b9096", _INK: "#d5d9de", _GRID: "#343b43", _LINE: "#6b737c", _MARK: "#8f7400", _MARK_TEXT: "#ffe08a",
}  # fmt: skip
_FONT = "Inter, 'Helvetica Neue', Arial, sans-serif"
_HEIGHTS = {"response": 0.5, "residual-time": 0.28, "input": 0.16}  # of panels over one time axis
_GAP = 0.03
_PANELS = {"residual-time": "Error", "input": "Input"}  # short names of low panels


def figure(plots: Sequence[Plot]) -> dict[str, Any]:
    """One Plotly figure: {"data", "layout"}, and "zoom", the changes of the layout that show the stretch of most.

    Several plots are panels over one x axis, from the top down.
    """
    first = plots[0]
    x_scale, x_unit = _scale(first.x_unit, [trace.x for plot in plots for trace in plot.traces])
    layout: dict[str, Any] = {
        "font": {"family": _FONT, "size": 13, "color": _INK},
        "margin": {"l": 66, "r": 14, "t": 30, "b": 46},
        "height": 330 if len(plots) == 1 else 470,
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
        "modebar": {"bgcolor": "rgba(0,0,0,0)", "color": _LINE, "activecolor": _INK},  # else of a transparent black
        "hovermode": "closest",
        "legend": {"itemsizing": "constant", "orientation": "h", "x": 0, "y": 1.01, "yanchor": "bottom"},
        "xaxis": {**_axis(first.x_label, x_unit), "anchor": _name("y", len(plots) - 1), "automargin": False},
        "shapes": [_mark(mark.low * x_scale, mark.high * x_scale) for mark in first.marks],
        "annotations": [_label(mark.low * x_scale, mark.high * x_scale, mark.label) for mark in first.marks],
    }
    zoom: dict[str, Any] = {}
    if first.zoom:
        low, high = (bound * x_scale for bound in first.zoom)
        zoom["xaxis.range"] = [low, high]
        layout["shapes"].append(_mark(low, high))
    data: list[dict[str, Any]] = []
    legend: set[str] = set()
    for k, (plot, domain) in enumerate(zip(plots, _domains(plots), strict=True)):
        scale, unit = _scale(plot.y_unit, [trace.y for trace in plot.traces if trace.role != "nominal"])
        label = _PANELS.get(plot.slot, plot.y_label) if len(plots) > 1 else plot.y_label
        axis = {**_axis(label, unit), "type": "log" if plot.log_y else "linear", "domain": domain}
        if plot.shown:
            axis |= {"range": [bound * scale for bound in plot.shown]}
        layout[_name("yaxis", k)] = axis
        if plot.zoom:
            zoom[f"{_name('yaxis', k)}.range"] = [bound * scale for bound in _seen_in(plot)]
        for trace in plot.traces:
            for line in _lines(trace, x_scale, scale):
                data.append({**line, "yaxis": _name("y", k)} if k else line)
                _in_legend(data[-1], _group(trace), legend, alone=plot.slot == "input")
                if plot.slot == "input":
                    data[-1]["line"] |= {"shape": "hv", "dash": "solid"}
    return {"data": data, "layout": layout, "zoom": zoom}


def _name(axis: str, k: int) -> str:
    return axis if k == 0 else f"{axis}{k + 1}"


def _domains(plots: Sequence[Plot]) -> list[list[float]]:
    if len(plots) == 1:
        return [[0.0, 1.0]]
    heights = [_HEIGHTS.get(plot.slot, 0.3) for plot in plots]
    free = 1.0 - _GAP * (len(plots) - 1)
    top, found = 1.0, []
    for height in heights:
        part = free * height / sum(heights)
        found.append([max(top - part, 0.0), top])
        top -= part + _GAP
    return found


def _group(trace: Trace) -> str:
    return {"before": "refitted", "after": "corrected"}.get(trace.role, trace.role)


def _in_legend(line: dict[str, Any], group: str, seen: set[str], *, alone: bool) -> None:
    """A model has one entry for its lines in all panels; clouds of several recordings have one each."""
    key = line.get("name", group)
    line["legendgroup"] = group if line["mode"] == "lines" else key
    if alone or key in seen or not line.get("showlegend", True):
        line["showlegend"] = False
    seen.add(key)


def _scale(unit: str, values: Sequence[Array]) -> tuple[float, str]:
    largest = max((float(np.nanmax(np.abs(v))) for v in values if np.isfinite(v).any()), default=0.0)
    return words.prefix_for(largest, unit)


def _seen_in(plot: Plot) -> tuple[float, float]:
    """The range of y over the stretch that shows most; a nominal model that runs away does not set it."""
    low, high = plot.zoom or (-np.inf, np.inf)
    parts = [t.y[(t.x >= low) & (t.x <= high)] for t in plot.traces if t.role != "nominal"]
    values = np.concatenate(parts)
    values = values[np.isfinite(values)]
    if not values.size:
        return plot.shown or (-1.0, 1.0)
    margin = 0.06 * float(np.ptp(values)) or 1.0
    return float(values.min()) - margin, float(values.max()) + margin


def _axis(label: str, unit: str) -> dict[str, Any]:
    label = words.capital(label)
    return {
        "title": {"text": f"{label} [{unit}]" if unit else label, "standoff": 8},
        "gridcolor": _GRID,
        "zerolinecolor": _LINE,
        "linecolor": _LINE,
        "ticks": "outside",
        "tickcolor": _LINE,
        "automargin": True,
    }


def _mark(low: float, high: float) -> dict[str, Any]:
    return {
        "type": "rect",
        "xref": "x",
        "yref": "paper",
        **{"x0": low, "x1": high, "y0": 0, "y1": 1},
        "fillcolor": _MARK,
        "opacity": 0.25,
        "line": {"width": 0},
        "layer": "below",
    }


def _label(low: float, high: float, text: str) -> dict[str, Any]:
    place = {"x": (low + high) / 2, "y": 0.99, "xref": "x", "yref": "paper", "yanchor": "top"}
    return {**place, "text": text, "showarrow": False, "font": {"size": 11, "color": _MARK_TEXT}}


def _lines(trace: Trace, x_scale: float, y_scale: float) -> list[dict[str, Any]]:
    colour = COLOURS[trace.role]
    x = _packed(trace.x * x_scale)
    style: dict[str, Any] = {"type": "scatter", "name": trace.name, "x": x}
    if trace.points:
        style |= {"mode": "markers", "marker": {"color": colour, "size": 4, "opacity": 0.45}}
        if trace.at is not None:
            style |= {"customdata": _packed(trace.at), "meta": trace.recording}
    else:
        line = {"color": colour, "width": _WIDTHS.get(trace.role, 1.6), "dash": _DASHES.get(trace.role, "solid")}
        style |= {"mode": "lines", "line": line}
    lines = [{**style, "y": _packed(trace.y * y_scale)}]
    if trace.low is not None and trace.high is not None:
        edge = {"type": "scatter", "mode": "lines", "line": {"width": 0}, "showlegend": False, "hoverinfo": "skip"}
        upper = {**edge, "x": x, "y": _packed(trace.high * y_scale)}
        lower = {**edge, "x": x, "y": _packed(trace.low * y_scale)}
        lines = [upper, {**lower, "fill": "tonexty", "fillcolor": _faint(colour)}, *lines]
    return lines


def _packed(values: Array) -> dict[str, str]:
    """A typed array as Plotly reads it: small, and NaN breaks the line."""
    return {"dtype": "f4", "bdata": base64.b64encode(values.astype("<f4").tobytes()).decode("ascii")}


def drawn(plots: Sequence[Plot], title: str) -> plotly.graph_objects.Figure:
    """The figure of `figure` as an object of plotly, its values as arrays for who works on with it.

    Raises InputError where plotly is not installed.
    """
    try:
        from plotly.graph_objects import Figure
    except ModuleNotFoundError as error:
        raise InputError("plotly is not installed", where="plot", expected="the extra 'plot'",
                         fix="pip install 'rwn[plot]'") from error  # fmt: skip
    made = figure(plots)
    return Figure(data=[_unpacked(line) for line in made["data"]], layout={**made["layout"], "title": title})


def _unpacked(line: dict[str, Any]) -> dict[str, Any]:
    return {
        key: np.frombuffer(base64.b64decode(value["bdata"]), dtype="<f4")
        if isinstance(value, dict) and "bdata" in value
        else value
        for key, value in line.items()
    }


def _faint(colour: str) -> str:
    red, green, blue = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return f"rgba({red},{green},{blue},0.15)"
