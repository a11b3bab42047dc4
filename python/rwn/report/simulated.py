"""What is said of a simulation: how much there is of it, and how far it is off what its recording holds."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from rwn.recording.recording import Recording
from rwn.recording.signals import COLUMNS, si_unit
from rwn.recording.units import factor
from rwn.report.text import number, symbol
from rwn.simulate.recorded_error import recorded_errors
from rwn.simulate.simulation import Simulation


def simulated(run: Simulation, source: Recording, out: Path) -> Iterator[str]:
    """What `out` holds, and the rms error of each signal that was recorded too, in the recording's units."""
    yield f"{len(run.time)} samples of {', '.join(run.signals)} in {out}"
    errors = recorded_errors(run, source)
    if errors:
        said = [f"{_in_its_unit(error.rms, signal, source)} of the {signal}" for signal, error in errors.items()]
        left_out = sum(error.left_out for error in errors.values())
        beside = f" ({left_out} samples that measure nothing left out)" if left_out else ""
        yield f"rms error against {source.name}: {', '.join(said)}{beside}"


def _in_its_unit(rms: float, signal: str, source: Recording) -> str:
    si = si_unit(COLUMNS[signal], source.linear)
    unit = source.units.get(signal, si)
    return f"{number(rms if unit == si else rms / factor(unit, si, where=source.name))} {symbol(unit)}"
