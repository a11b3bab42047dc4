"""From recordings to runs: the samples, how the speed was measured, the start, and the input between the rows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.model.initial_state import initial_state_of
from rwn.model.model import Model
from rwn.recording.delays import in_time
from rwn.recording.filters import unfiltered
from rwn.recording.interpolated import InterpolatedRows
from rwn.recording.intersample import AUTO, INTERSAMPLE
from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED
from rwn.recording.speed_measurement import INSTANTANEOUS, SpeedMeasurement, integral, speed_measurement
from rwn.simulate.run import Run

Array = NDArray[np.float64]
_NONE: Array = np.empty(0)


def run_of(recording: Recording, model: Model) -> Run:
    """A recording as the core takes it; samples are at the rows' times, the input acts as the model's layout says."""
    drive, layout = model.drive, model.recording
    law = None if layout.intersample == AUTO else INTERSAMPLE[layout.intersample]
    recording = in_time(recording, layout.delays)
    when = recording.time - recording.time[0]
    rows = law.samples(when) if law else None
    ticks = law.ticks_per_row if law else 1
    recording = unfiltered(sampled(recording, rows), layout.filters, ticks_per_row=ticks)
    signals = {name: np.array(values) for name, values in recording.signals.items()}
    given = signals[drive.input]
    time = recording.time - recording.time[0]
    speed, position = signals.get("speed", _NONE), signals.get("position", _NONE)
    way = INSTANTANEOUS
    if layout.speed_rows is not None:
        way = SpeedMeasurement(*layout.speed_rows)
    elif not drive.coefficients:
        new = {s: ~recording.missing.get(s, np.zeros(time.size, dtype=bool)) for s in ("speed", "position")}
        way = speed_measurement(time, speed, position, new=new["speed"], new_position=new["position"])
    start = initial_state_of(time, signals, model, missing=recording.missing, way=way)
    run = Run(
        name=recording.name,
        time=np.ascontiguousarray(time),
        input=np.ascontiguousarray(given),
        current=signals.get("current", _NONE) if "current" in drive.outputs else _NONE,
        speed=speed,
        position=position,
        speed_measured=way,
        missing=recording.missing,
        start=start.state,
        start_spread=start.spread,
        in_motion=start.in_motion,
        start_samples=start.start_samples,
        input_before=float(given[0]) if start.in_motion else 0.0,
        angle=position if position.size else integral(way, time, speed),
        angle_from_speed=position.size == 0,
        ticks_per_row=ticks,
        interpolated=rows,
        input_noise=recording.input_noise,
    )
    known = recording.applied_input
    return replace(run, applied_input=law.applied(when, run.input) if known is None and law else known)


def sampled(recording: Recording, rows: InterpolatedRows | None) -> Recording:
    """A recording with the samples that its rows lie between in place of them; its input stays."""
    if rows is None:
        return recording
    signals, missing = dict(recording.signals), dict(recording.missing)
    for name in (s for s in MEASURED if s in signals):
        signals[name], missing[name] = rows.samples(np.asarray(signals[name]), missing.get(name))
    return replace(recording, time=recording.time[0] + rows.ticks, signals=signals, missing=missing)


def judging_run(recording: Recording, model: Model) -> Run:
    """As `run_of`, for a recording that is not fitted: a state to be estimated comes from its first samples alone."""
    run = run_of(recording, model)
    estimated = model.drive.coefficients and run.in_motion
    return replace(run, judged_from=model.recording.initial_samples if estimated else 0)


def measured_alike(runs: Sequence[Run], known: Sequence[Run]) -> list[Run]:
    """The runs with their speed measured as in `known`, which were all measured by one sensor."""
    way = next((k.speed_measured for k in known if k.speed.size), None)
    return [replace(r, speed_measured=way) if way and r.speed.size else r for r in runs]
