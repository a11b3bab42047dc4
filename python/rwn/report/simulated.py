"""What is said of a simulation: how much there is of it, and how far it is off what its recording holds."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from rwn.recording.columns import si_unit
from rwn.recording.inspection import inspected
from rwn.recording.recording import Recording
from rwn.recording.signals import COLUMNS, MEASURED
from rwn.recording.units import factor
from rwn.report.text import number, symbol
from rwn.simulate.simulation import Simulation


def simulated(run: Simulation, source: Recording, out: Path) -> Iterator[str]:
    """What `out` holds, and the rms error of each signal that was recorded too, in the recording's units.

    Samples that measure nothing (spikes, what is held between updates) do not count.
    """
    yield f"{len(run.time)} samples of {', '.join(run.signals)} in {out}"
    (recording,), _ = inspected([source])
    errors, left_out = [], 0
    for signal in (s for s in MEASURED if s in run.signals and s in recording.signals):
        missing = recording.missing.get(signal, np.zeros(len(recording), dtype=bool))
        error = (recording.signals[signal] - run.signals[signal])[~missing]
        if not error.size:
            continue
        si = si_unit(COLUMNS[signal], source.linear)
        unit = source.units.get(signal, si)
        rms = float(np.sqrt(np.mean(error**2))) / (1.0 if unit == si else factor(unit, si, where=source.name))
        errors.append(f"{number(rms)} {symbol(unit)} of the {signal}")
        left_out += int(missing.sum())
    if errors:
        beside = f" ({left_out} samples that measure nothing left out)" if left_out else ""
        yield f"rms error against {source.name}: {', '.join(errors)}{beside}"
