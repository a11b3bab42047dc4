"""UNDC: a small geared brushed motor on a PWM bridge; commanded voltage with speed or with position."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from rwn.recording.recording import Recording
from rwn.studies.machines.machine import Machine, Outcome, Say, data_file, error_of, judged, nominal_model

# file, columns of voltage and of what was measured, which that is; in degrees, or degrees per second
FITTED = (("prbs_open_exp", (1, 2), "speed"), ("profile_closed_exp", (3, 2), "position"))
HELDOUT = (
    ("step_open_exp", (1, 2), "speed"),
    ("step_closed_exp", (3, 2), "position"),
    ("stairs_closed_exp", (3, 2), "position"),
)
UNITS = {"speed": "deg/s", "position": "deg"}
ROWS = 2000  # of the long file that are fitted


def run(folder: Path, say: Say) -> tuple[Outcome, ...]:
    """Small steps of speed and a position profile are fitted; a step of either and a stair of positions judge."""
    fitted, heldout = ([read_run(folder, *run) for run in runs] for runs in (FITTED, HELDOUT))
    outcome = judged("UNDC", "linear motor", nominal_model("undc"), fitted, heldout, say)
    errors = [
        error_of(outcome.found, name, signal, f"{signal}, {name} [{UNITS[signal]}]", scale=float(np.rad2deg(1.0)))
        for name, _, signal in HELDOUT
    ]
    return (replace(outcome, errors=tuple(errors)),)


def read_run(folder: Path, name: str, columns: tuple[int, int], signal: str) -> Recording:
    """A file of the kit, SI."""
    rows = np.genfromtxt(data_file(folder, f"{name}.csv"), delimiter=",", skip_header=1)[:ROWS]
    voltage, measured = (rows[:, k] for k in columns)
    return Recording(name=name, time=rows[:, 0], signals={"voltage": voltage, signal: np.deg2rad(measured)})


MACHINE = Machine(name="undc", folder="undc_motor", source="nebisman/UNDCMotor", run=run)
