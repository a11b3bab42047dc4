"""FRC: two robots' mechanisms as recorded by WPILib SysId: slow ramps and fast steps, both ways."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from rwn.errors import InputError
from rwn.recording.recording import Recording
from rwn.report.diagnosis import Diagnosis
from rwn.studies.machines.machine import Machine, Outcome, Say, data_file, error_of, judged, nominal_model

FITTED, HELDOUT = ("slow-forward", "fast-backward"), ("slow-backward", "fast-forward")
# file, words, columns of voltage, position and velocity, rad per unit
MECHANISMS = (
    ("simple_mechanism.json", "FRC simple mechanism", (1, 2, 3), 1.0),
    ("drivetrain_4277.json", "FRC drivetrain 4277", (1, 3, 5), 2.0 * np.pi / 0.478778),
)


def read_sysid(path: Path, test: str, columns: tuple[int, int, int], unit: float) -> Recording:
    """One test of a SysId file; rows that repeat an instant are left out, the position counts from the start."""
    content = json.loads(path.read_text(encoding="utf-8"))
    if test not in content:
        raise InputError(
            f"there is no test '{test}'", where=path, expected="a WPILib SysId file", fix="give the file as recorded"
        )
    rows = np.array(content[test], dtype=float)
    rows = rows[np.concatenate([[True], np.diff(rows[:, 0]) > 0.0])]
    voltage, position, speed = (rows[:, k] for k in columns)
    signals = {"torque": voltage, "speed": unit * speed, "position": unit * (position - position[0])}
    return Recording(name=f"{path.stem} {test}", time=rows[:, 0] - rows[0, 0], signals=signals)


def run(folder: Path, say: Say) -> tuple[Outcome, ...]:
    """A slow run one way and a fast one the other way are fitted; their opposites judge."""
    return tuple(_mechanism(folder, *mechanism, say) for mechanism in MECHANISMS)


def _mechanism(folder: Path, file: str, words: str, columns: tuple[int, int, int], unit: float, say: Say) -> Outcome:
    path = data_file(folder, file)
    runs = {test: read_sysid(path, test, columns, unit) for test in (*FITTED, *HELDOUT)}
    outcome = judged(
        words, "inertia and back-EMF", nominal_model("frc"), [runs[t] for t in FITTED], [runs[t] for t in HELDOUT], say
    )
    errors = [error_of(outcome.found, runs[test].name, "speed", f"speed, {test} [rad/s]") for test in HELDOUT]
    lag = (f"the measured speed follows a voltage step after {dead_time(runs['fast-forward']) * 1e3:.0f} ms",)
    return replace(outcome, errors=tuple(errors), notes=(*lag, *_static_friction(outcome.found)))


def dead_time(run: Recording) -> float:
    """From the first voltage to the first motion beyond 1 % of the largest speed [s]."""
    begins = int(np.argmax(run.signals["torque"] != 0.0))
    speed = np.abs(run.signals["speed"])
    return float(run.time[int(np.argmax(speed > 0.01 * speed.max()))] - run.time[begins])


def _static_friction(found: Diagnosis) -> tuple[str, ...]:
    levels: Mapping[str, float] = {
        f"{e.name} {name}": p.value
        for e in found.effects
        for name, p in e.parameters.items()
        if name.endswith("_torque")
    }
    return tuple(f"{name.replace('_', ' ')} {value:.2f} V" for name, value in levels.items())


MACHINE = Machine(name="frc", folder="frc_sysid", source="FRC4277; calcmogul/SysIdOpt", run=run)
