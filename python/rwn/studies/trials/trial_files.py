"""A trial as files: model.toml, train_*.csv, heldout_*.csv. Nothing of the answer is among them."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np

from rwn.studies.trials.bench import Recording
from rwn.studies.trials.conceal import Nominal
from rwn.studies.trials.damaged import reading, refused
from rwn.studies.trials.plant import Array
from rwn.studies.trials.trial import Trial

UNITS = {
    "resistance": "ohm",
    "inductance": "H",
    "torque_constant": "N m/A",
    "back_emf_constant": "V s/rad",
    "inertia": "kg m^2",
    "viscous_friction": "N m s/rad",
    "coulomb_friction": "N m",
}


def model_toml(nominal: Nominal) -> str:
    """The nominal model; an exact value is written in full, an uncertain one with five figures."""
    lines = ["[motor]", 'kind = "dc"']
    for name, value in nominal.values.items():
        text = f"{name} = {value:.5g}" if name in nominal.uncertainty else f"{name} = {value:.15g}"
        lines.append(f"{text:<37} # {UNITS[name]}")
    lines += ["", "[uncertainty]"]
    lines += [f"{name} = {sigma:.2g}" for name, sigma in nominal.uncertainty.items()]
    return "\n".join(lines) + "\n"


def write_recording(path: Path, recording: Recording) -> None:
    """CSV with the units in the header; six figures, voltage seven."""
    columns: list[tuple[str, str, Array | None]] = [
        ("time [s]", "%.9g", recording.time),
        ("voltage [V]", "%.7g", recording.voltage),
        ("current [A]", "%.6g", recording.current),
        ("speed [rad/s]", "%.6g", recording.speed),
        ("position [rad]", "%.9g", recording.position),
    ]
    present = [(name, figures, values) for name, figures, values in columns if values is not None]
    np.savetxt(
        path,
        np.column_stack([values for _, _, values in present]),
        fmt=[figures for _, figures, _ in present],
        delimiter=",",
        header=",".join(name for name, _, _ in present),
        comments="",
    )


def read_columns(path: Path) -> dict[str, Array]:
    """The columns of a recording by signal: time, voltage, current, speed, position."""
    with reading(path):
        with path.open(encoding="utf-8") as file:
            names = [name.split(" [")[0] for name in file.readline().strip().split(",")]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # of no rows, which is said below
            table = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
        if not table.size:
            raise refused(path, "there are no rows of numbers")
        return {name: np.ascontiguousarray(table[:, k]) for k, name in enumerate(names)}


def read_speed(path: Path, *, rows: int | None = None) -> Array:
    """The speeds of a recording (rows,). Raises InputError where it has none, or not so many."""
    columns = read_columns(path)
    if "speed" not in columns:
        raise refused(path, f"there is no column speed, but {', '.join(columns)}")
    if rows is not None and columns["speed"].size != rows:
        raise refused(path, f"{columns['speed'].size} rows; its held-out recording has {rows}")
    if not np.isfinite(columns["speed"]).all():
        raise refused(path, "a speed is not a finite number")
    return columns["speed"]


def write_trial(folder: Path, trial: Trial) -> None:
    folder.mkdir(parents=True)
    (folder / "model.toml").write_text(model_toml(trial.nominal), encoding="utf-8")
    for name, text in trial.notes.items():
        (folder / name).write_text(text, encoding="utf-8")
    for use, recordings in (("train", trial.train), ("heldout", trial.heldout)):
        for number, recording in enumerate(recordings, start=1):
            write_recording(folder / f"{use}_{number}.csv", recording)
