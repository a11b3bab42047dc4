"""How much of what was recorded a model explains by itself, signal by signal."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rwn.model.model import Model
from rwn.recording.recording import Recording
from rwn.recording.signals import COLUMNS, si_unit
from rwn.recording.units import factor
from rwn.simulate.simulation import simulate


@dataclass(frozen=True, kw_only=True)
class ExplainedSignal:
    """How much of one recorded signal a model explains in free run, and the rms of what it does not."""

    recording: str
    signal: str
    explained: float  # share of the variance; negative where it is worse than the mean
    error: float  # rms, in `unit`
    unit: str  # that of the file, else SI


def explained_signals(model: Model, recordings: Sequence[Recording]) -> tuple[ExplainedSignal, ...]:
    """What a model explains of every recorded output; nothing of an error that is not finite."""
    rows = []
    for recording in recordings:
        made = simulate(model, recording).signals
        for signal in (s for s in made if s in recording.signals):
            measured = np.array(recording.signals[signal])
            measured[recording.missing.get(signal, np.zeros(measured.size, dtype=bool))] = np.nan
            spread = float(np.nanvar(measured))
            error = float(np.nanmean((measured - made[signal]) ** 2))
            explained = 1.0 - error / spread if spread > 0.0 else float(error == 0.0)
            rms, unit = _as_recorded(error**0.5, signal, recording)
            rows.append(
                ExplainedSignal(recording=recording.name, signal=signal, explained=explained, error=rms, unit=unit)
            )
    return tuple(rows)


def _as_recorded(value: float, signal: str, recording: Recording) -> tuple[float, str]:
    """A value in SI in the unit that the file has for the signal, and that unit."""
    si = si_unit(COLUMNS[signal], recording.linear)
    unit = recording.units.get(signal, si)
    return value / factor(unit, si, where=recording.name), unit
