"""Hall BLDC: a brushless motor under six-step control; its speed is known at the edges of its Hall sensors alone."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from rwn.recording.recording import Recording
from rwn.studies.machines.machine import Machine, Outcome, Say, cut, data_file, error_of, judged, nominal_model

SUPPLY = 24.0  # [V]
SPEED, DUTY = 1, 2  # of the captured signals
TRAINED = 5000  # rows of 0.72 ms; the rest judges


def run(folder: Path, say: Say) -> tuple[Outcome, ...]:
    """The first 3.6 s are fitted, the last 2.4 s judge."""
    train, test = parts(folder)
    outcome = judged("Hall BLDC", "linear motor", nominal_model("hall"), [train], [test], say)
    return (replace(outcome, errors=(error_of(outcome.found, test.name, "speed", "speed, last rows [rad/s]"),)),)


def parts(folder: Path) -> tuple[Recording, Recording]:
    """What is fitted, and what judges."""
    whole = read_capture(data_file(folder, "dataset.mat"))
    return replace(cut(whole, 0, TRAINED), name="first rows"), replace(cut(whole, TRAINED), name="last rows")


def read_capture(path: Path) -> Recording:
    """Duty times supply, and speed, of a ControlDesk capture."""
    import scipy.io

    capture = scipy.io.loadmat(str(path), struct_as_record=False, squeeze_me=True)["cigan"]
    speed, duty = (np.asarray(capture.Y[k].Data, dtype=np.float64) for k in (SPEED, DUTY))
    time = np.asarray(np.atleast_1d(capture.X)[0].Data, dtype=np.float64)
    return Recording(name=path.name, time=time, signals={"voltage": SUPPLY * duty, "speed": speed})


MACHINE = Machine(
    name="hall", folder="bldc_hall", source="CiganOliviu/brushless-DC-electric-motor-identification", run=run
)
