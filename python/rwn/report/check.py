"""What a check of recordings says before any physics, a line each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from rwn.model.model import Model
from rwn.recording.inspection import inspected
from rwn.recording.recording import Recording
from rwn.simulate.run import Run, run_of

IRREGULAR = 1e-3  # relative deviation of the sample time that is more than rounded timestamps


def checked(recordings: Sequence[Recording], model: Model) -> Iterator[str]:
    """Sampling, start and sensors of each recording as they are taken, and what is odd with what is done about it."""
    for each in recordings:
        (recording,), findings = inspected([each])
        run, signals = run_of(recording, model), ", ".join(recording.signals)
        yield f"{recording.name}: {len(recording)} samples of {signals}, {recording.duration:.4g} s"
        yield from (f"  {words}" for words in (*_sampling(run), _start(run, model), *_speed(run)))
        yield from (f"  {finding.words}: {finding.done}" for finding in findings)
        yield from (f"  {warning}" for warning in recording.warnings)


def _sampling(run: Run) -> Iterator[str]:
    steps, usual = np.diff(run.time), run.sample_time
    lost = int(np.sum(np.round(steps[steps > 1.5 * usual] / usual) - 1))
    spread = float(np.std(steps[steps < 1.5 * usual])) / usual
    yield f"a sample every {usual:.4g} s" + (f", jitter {spread:.1%} of it" if spread > IRREGULAR else "")
    if lost:
        yield f"{lost} rows are missing: the input is taken as held over them"


def _start(run: Run, model: Model) -> str:
    if not run.in_motion:
        return "starts at rest"
    linear = model.linear
    current, speed, _ = run.start
    parts = [f"{speed:.4g} {'m/s' if linear else 'rad/s'}"] + ([f"{current:.3g} A"] if model.drive.winding else [])
    return f"starts in motion, at about {' and '.join(parts)}; the exact state is fitted with it"


def _speed(run: Run) -> Iterator[str]:
    if run.speed_measured.is_difference:
        yield "the speed is a difference of positions: it is compared as such"
