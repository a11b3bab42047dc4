"""FRA233: a small brushed motor; voltage as commanded and speed, whole files as recorded."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rwn.recording.recording import read_recording
from rwn.studies.machines.machine import Machine, Outcome, Say, data_file, error_of, judged, nominal_model

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


MACHINE = Machine(name="fra233", folder="fra233", source="thuxrife/FRA233_Lab1_G04", run=run)
