"""Errors, places and pictures of a diagnosis in the units of its files, so that a user can compare them at sight."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rwn.mismatch_map.regions import Region
from rwn.prove.heldout import HeldoutRow
from rwn.recording.recording import Recording
from rwn.recording.signals import SIGNALS, si_unit
from rwn.recording.units import factor
from rwn.report.diagnosis import Diagnosis
from rwn.report.plot import Plot

Units = Mapping[str, str]


def in_file_units(found: Diagnosis, recordings: Sequence[Recording]) -> Diagnosis:
    """A diagnosis whose errors, and the signals of its pictures, are in the units of the files of its recordings.

    What is of no single recording has those of the first.
    """
    linear = recordings[0].linear
    units = {run.name: run.units for run in recordings}
    first = recordings[0].units
    rows = tuple(_row(row, units.get(row.recording, first), linear=linear) for row in found.heldout)
    drawn = (_plot(plot, units.get(plot.recording, first), linear=linear) for plot in found.curves)
    curves = tuple(_over(plot, first, linear=linear) for plot in drawn)
    return replace(found, heldout=rows, curves=curves)


def regions_in_file_units(where: Sequence[Region], units: Units, *, linear: bool) -> tuple[Region, ...]:
    """Regions of a signal in the `units` of a file."""

    def of(region: Region) -> Region:
        if region.coordinate not in SIGNALS:  # an angle within a revolution, an acceleration
            return region
        scale, unit = _in_unit(region.coordinate, units, linear=linear)
        return replace(region, low=region.low * scale, high=region.high * scale, unit=unit)

    return tuple(of(region) for region in where)


def _in_unit(signal: str, units: Units, *, linear: bool) -> tuple[float, str]:
    """What SI numbers of a signal are multiplied by to be in the unit of a file, and that unit."""
    si = si_unit(SIGNALS[signal], linear)
    unit = units.get(signal, si)
    return (1.0, si) if unit in ("", si) else (1.0 / factor(unit, si, where=signal), unit)


def _row(row: HeldoutRow, units: Units, *, linear: bool) -> HeldoutRow:
    if row.signal not in SIGNALS:  # a driving force is in percent
        return row
    scale, unit = _in_unit(row.signal, units, linear=linear)
    corrected, floor, simulated = (x and x * scale for x in (row.corrected, row.noise_floor, row.simulated))
    return replace(
        row, unit=unit, nominal=row.nominal * scale, refitted=row.refitted * scale, corrected=corrected,
        noise_floor=floor, simulated=simulated,
    )  # fmt: skip


def _plot(plot: Plot, units: Units, *, linear: bool) -> Plot:
    signal = plot.y_label.removesuffix(" error")
    if not plot.recording or signal not in SIGNALS:
        return plot
    scale, unit = _in_unit(signal, units, linear=linear)
    traces = tuple(replace(trace, y=trace.y * scale) for trace in plot.traces)
    return replace(plot, y_unit=unit, traces=traces, shown=_scaled(plot.shown, scale))


def _over(plot: Plot, units: Units, *, linear: bool) -> Plot:
    """A picture over a signal, over that in the unit of a file."""
    if plot.x_label not in SIGNALS:
        return plot
    scale, unit = _in_unit(plot.x_label, units, linear=linear)
    traces = tuple(replace(trace, x=trace.x * scale) for trace in plot.traces)
    marks = tuple(replace(mark, low=mark.low * scale, high=mark.high * scale) for mark in plot.marks)
    return replace(plot, x_unit=unit, traces=traces, marks=marks, zoom=_scaled(plot.zoom, scale))


def _scaled(stretch: tuple[float, float] | None, scale: float) -> tuple[float, float] | None:
    return None if stretch is None else (stretch[0] * scale, stretch[1] * scale)
