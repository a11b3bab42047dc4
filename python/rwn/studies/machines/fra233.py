"""FRA233: a small brushed motor; voltage as commanded and speed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rwn.recording.recording import Recording, read_recording
from rwn.studies.machines.machine import Machine, Outcome, Say, cut, data_file, error_of, judged, nominal_model

LATE = (
    "the first samples are left out: at the start of a file the motor stands still under up to 4.3 V for 60-120 ms, "
    "though in the ramps it moves at 0.9 V; in the step runs, a second after the start, it does not"
)


def recordings(folder: Path) -> tuple[list[Recording], list[Recording]]:
    """A sine and a ramp to fit, a step run and a stair run to judge by."""
    layout = nominal_model("fra233").recording
    sine, ramp, step, stair = (
        read_recording(data_file(folder, f"{name}_1.mat"), layout=layout) for name in ("sine", "ramp", "step", "stair")
    )
    # 2 kHz: after a second, after half a second
    return [cut(sine, 2000, 10000), cut(ramp, 1000)], [step, cut(stair, 2000)]


def run(folder: Path, say: Say) -> tuple[Outcome, ...]:
    """The main job with these."""
    fitted, heldout = recordings(folder)
    outcome = judged("FRA233", "linear motor", nominal_model("fra233"), fitted, heldout, say)
    errors = [error_of(outcome.found, r.name, "speed", f"speed, {r.name.split('_')[0]} run [rad/s]") for r in heldout]
    return (replace(outcome, errors=tuple(errors), notes=(LATE,)),)


MACHINE = Machine(name="fra233", folder="fra233", source="thuxrife/FRA233_Lab1_G04", run=run)
