"""What a check of recordings says before any search for physics, a line each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from rwn.faults.held_shaft import held_finding
from rwn.faults.late_enable import late_enables, powered
from rwn.faults.plain_faults import plain_faults
from rwn.model.files import model_to_fit
from rwn.model.model import Model
from rwn.recording.clock import clock_of
from rwn.recording.inspection import inspected
from rwn.recording.recording import Recording
from rwn.recording.signals import SIGNALS
from rwn.simulate.recorded_run import run_of
from rwn.simulate.run import Run

HALF = 0.5  # jitter, in times between rows, from which on rows lie nowhere near even times


def checked(recordings: Sequence[Recording], model: Model) -> Iterator[str]:
    """Sampling, start and sensors of each recording as they are taken, what is odd, and what is done about it.

    Raises InputError where a recording does not fit the model.
    """
    model = model_to_fit(model)
    usable = [inspected([each]) for each in recordings]
    late = late_enables([recording for (recording,), _ in usable], model)
    for place, ((recording,), findings) in enumerate(usable):
        run, signals = run_of(recording, model), ", ".join(recording.signals)
        enabled = [one.as_finding(model.drive.input) for one in late if one.place == place]
        yield f"{recording.name}: {len(recording)} samples of {signals}, {recording.duration:.4g} s"
        about = (_ranges(recording, model), *_sampling(run), _start(run, model), *_speed(run))
        yield from (f"  {words}" for words in about)
        held = [] if run.moves or model.drive.coefficients else [held_finding(run, model)]
        yield from (f"  {finding.words}: {finding.done}" for finding in (*findings, *enabled, *held))
        yield from (f"  {warning}" for warning in recording.warnings)
    on = powered([recording for (recording,), _ in usable], late, model)
    faults = [] if model.drive.coefficients else plain_faults(on, model)[0]
    yield from (f"{fault.meaning}: rwn diagnose undoes it, and weighs what is missing beneath" for fault in faults)


def _ranges(recording: Recording, model: Model) -> str:
    """From where to where each signal goes in SI, which shows a unit or a scale that is plainly wrong."""
    parts = []
    for name, values in recording.signals.items():
        signal = SIGNALS[name]
        unit = signal.linear_unit if model.linear and signal.linear_unit else signal.unit
        parts.append(f"{name} {np.nanmin(values):.3g} to {np.nanmax(values):.3g} {unit}")
    return ", ".join(parts)


def _sampling(run: Run) -> Iterator[str]:
    at = clock_of(run.time)
    period = f"a sample every {at.period:.4g} s"
    if at.jitter < HALF:
        yield period + (f"; rows come early or late by {at.jitter:.1%} of that, rms" if at.irregular else "")
    else:  # no even times lie beside these rows
        yield f"{period} on average, which varies from row to row by {np.std(np.diff(run.time)) / at.period:.1%}, rms"
    if at.lost:
        yield f"{at.lost} rows are missing: how the input acted meanwhile is read off the errors"


def _start(run: Run, model: Model) -> str:
    if not run.in_motion:
        return "starts at rest"
    linear = model.linear
    current, speed, _ = run.start
    parts = [f"{speed:.4g} {'m/s' if linear else 'rad/s'}"] + ([f"{current:.3g} A"] if model.drive.winding else [])
    how = "in motion" if run.begins_turning else "at standstill, held by its drive"
    return f"starts {how}, at about {' and '.join(parts)}; the exact state is fitted with it"


def _speed(run: Run) -> Iterator[str]:
    if run.speed_measured.is_difference:
        yield f"{run.speed_measured.in_words(run.sample_time)}: it is compared as such"
