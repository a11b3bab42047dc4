"""Errors and pictures of a diagnosis in the units of its files, so that a user can compare them at sight."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rwn.prove.heldout import HeldoutRow
from rwn.recording.columns import si_unit
from rwn.recording.recording import Recording
from rwn.recording.signals import SIGNALS
from rwn.recording.units import factor
from rwn.report.diagnosis import Diagnosis
from rwn.report.plot import Plot

Units = Mapping[str, str]


def in_file_units(found: Diagnosis, recordings: Sequence[Recording]) -> Diagnosis:
    """A diagnosis whose errors, and signals over time, are in the units of the files of its recordings.

    What is of no single recording has those of the first.
    """
    linear = recordings[0].linear
    units = {run.name: run.units for run in recordings}
    first = recordings[0].units
    rows = tuple(_row(row, units.get(row.recording, first), linear=linear) for row in found.heldout)
    curves = tuple(_plot(plot, units.get(plot.recording, first), linear=linear) for plot in found.curves)
    return replace(found, heldout=rows, curves=curves)


def _in_unit(signal: str, units: Units, *, linear: bool) -> tuple[float, str]:
    """What SI numbers of a signal are multiplied by to be in the unit of a file, and that unit."""
    si = si_unit(SIGNALS[signal], linear)
    unit = units.get(signal, si)
    return (1.0, si) if unit in ("", si) else (1.0 / factor(unit, si, where=signal), unit)


def _row(row: HeldoutRow, units: Units, *, linear: bool) -> HeldoutRow:
    if row.signal not in SIGNALS:  # a driving force is in percent
        return row
    scale, unit = _in_unit(row.signal, units, linear=linear)
    corrected, floor = (None if x is None else x * scale for x in (row.corrected, row.noise_floor))
    return replace(
        row, unit=unit, nominal=row.nominal * scale, refitted=row.refitted * scale, corrected=corrected,
        noise_floor=floor,
    )  # fmt: skip


def _plot(plot: Plot, units: Units, *, linear: bool) -> Plot:
    signal = plot.y_label.removesuffix(" error")
    if not plot.recording or signal not in SIGNALS:
        return plot
    scale, unit = _in_unit(signal, units, linear=linear)
    traces = tuple(replace(trace, y=trace.y * scale) for trace in plot.traces)
    shown = None if plot.shown is None else (plot.shown[0] * scale, plot.shown[1] * scale)
    return replace(plot, y_unit=unit, traces=traces, shown=shown)
