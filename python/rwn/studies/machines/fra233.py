"""FRA233: a small brushed motor; voltage as commanded and speed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rwn.recording.recording import read_recording
from rwn.studies.machines.machine import Machine, Outcome, Say, cut, data_file, error_of, judged, nominal_model

LATE = (
    "the first samples are left out: at the start of a file the motor stands still under up to 4.3 V for 60-120 ms, "
    "though in the ramps it moves at 0.9 V; in the step runs, a second after the start, it does not"
)


def run(folder: Path, say: Say) -> tuple[Outcome, ...]:
    """Fitted on a sine and a ramp; judged by a step run and a stair run."""
    model = nominal_model("fra233")
    sine, ramp, step, stair = (
        read_recording(data_file(folder, f"{name}_1.mat"), layout=model.recording)
        for name in ("sine", "ramp", "step", "stair")
    )
    fitted = [cut(sine, 2000, 10000), cut(ramp, 1000)]  # 2 kHz: after a second, after half a second
    heldout = [step, cut(stair, 2000)]
    outcome = judged("FRA233", "linear motor", model, fitted, heldout, say)
    errors = [
        error_of(outcome.found, f"{name}_1.mat", "speed", f"speed, {name} run [rad/s]") for name in ("step", "stair")
    ]
    return (replace(outcome, errors=tuple(errors), notes=(LATE,)),)


MACHINE = Machine(name="fra233", folder="fra233", source="thuxrife/FRA233_Lab1_G04", run=run)
