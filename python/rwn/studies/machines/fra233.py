"""FRA233: a small brushed motor; voltage as commanded and speed, whole files as recorded."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rwn.recording.recording import Recording, read_recording
from rwn.studies.machines.machine import Machine, Outcome, Say, cut, data_file, error_of, judged, nominal_model

FITTED, HELDOUT = ("sine", "ramp"), ("step", "stair")


def run(folder: Path, say: Say) -> tuple[Outcome, ...]:
    """Fitted on a sine and a ramp; judged by a step run and a stair run."""
    model = nominal_model("fra233")
    fitted, heldout = (
        [read_recording(data_file(folder, f"{name}_1.mat"), layout=model.recording) for name in names]
        for names in (FITTED, HELDOUT)
    )
    outcome = judged("FRA233", "linear motor", model, fitted, heldout, say)
    errors = [error_of(outcome.found, f"{name}_1.mat", "speed", f"speed, {name} run [rad/s]") for name in HELDOUT]
    return (replace(outcome, errors=tuple(errors)),)


def recordings(folder: Path) -> tuple[list[Recording], list[Recording]]:
    """The same where the drive is on: a sine and a ramp to fit, a step run and a stair run to judge by."""
    layout = nominal_model("fra233").recording
    sine, ramp, step, stair = (
        read_recording(data_file(folder, f"{name}_1.mat"), layout=layout) for name in ("sine", "ramp", "step", "stair")
    )
    # 2 kHz: after a second, after half a second
    return [cut(sine, 2000, 10000), cut(ramp, 1000)], [step, cut(stair, 2000)]


MACHINE = Machine(name="fra233", folder="fra233", source="thuxrife/FRA233_Lab1_G04", run=run)
