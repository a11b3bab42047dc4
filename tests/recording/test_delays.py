"""Signals that a logger shows late."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.faults.fault import SHIFT, UNIT, Fault
from rwn.model.files import write_model
from rwn.model.model import Model
from rwn.model.recordings import read_recordings
from rwn.recording.delays import delayed, in_time
from rwn.recording.layout import Column, Layout
from rwn.recording.recording import write_csv

TIME = 1e-3 * np.arange(500)
RUN = rwn.Recording(name="run", time=TIME, signals={"voltage": np.sin(30.0 * TIME), "speed": np.cos(30.0 * TIME)})


@pytest.mark.parametrize("delay", [4e-3, -3e-3])
def test_a_late_signal_is_put_in_time_and_shown_late_again(delay: float) -> None:
    shown = replace(RUN, signals={**RUN.signals, "speed": delayed(TIME, RUN.signals["speed"], delay)})
    made = in_time(shown, {"speed": delay})
    lost = made.missing["speed"]
    assert lost.sum() == round(abs(delay) / 1e-3)
    assert made.signals["speed"][~lost] == pytest.approx(RUN.signals["speed"][~lost], abs=1e-12)
    assert in_time(RUN, {}) is RUN


def test_a_delay_that_was_found_is_in_the_simulation_against_the_file(tmp_path: Path) -> None:
    fault = Fault(name=SHIFT, signals=("speed",), meaning="", delay=4, step=1e-3)
    model = Model(kind="dc", parameters=MOTOR)
    found = replace(model, recording=fault.in_layout(Layout()))
    write_model(found, tmp_path / "corrected.toml")
    read = rwn.read_model(tmp_path / "corrected.toml")
    assert read.recording.delays == {"speed": pytest.approx(4e-3)}
    bare = replace(RUN, signals={"voltage": RUN.signals["voltage"]})
    plain, late = (rwn.simulate(m, bare).signals["speed"] for m in (model, read))
    assert late[4:] == pytest.approx(plain[:-4], abs=1e-9)


def test_a_scale_that_was_found_is_in_the_simulation_against_the_file(tmp_path: Path) -> None:
    fault = Fault(name=UNIT, signals=("speed",), meaning="", factor=9.55)
    model = Model(kind="dc", parameters=MOTOR)
    mapped = Layout(columns={"speed": Column(source="w", unit="rad/s", scale=2.0)})
    assert fault.in_layout(mapped).columns["speed"].scale == pytest.approx(2.0 / 9.55)
    write_model(replace(model, recording=fault.in_layout(Layout())), tmp_path / "corrected.toml")
    write_csv(tmp_path / "run.csv", TIME, {**RUN.signals, "speed": 9.55 * RUN.signals["speed"]})
    (seen,) = read_recordings(tmp_path / "run.csv", tmp_path / "corrected.toml")
    assert seen.signals["speed"] == pytest.approx(RUN.signals["speed"], rel=1e-6)
    write_csv(tmp_path / "input.csv", TIME, {"voltage": RUN.signals["voltage"]})
    (bare,) = read_recordings(tmp_path / "input.csv", tmp_path / "corrected.toml", compared=False)
    assert set(bare.signals) == {"voltage"}
    with pytest.raises(rwn.InputError, match="no column 'speed'"):
        read_recordings(tmp_path / "input.csv", tmp_path / "corrected.toml")


def test_what_is_not_measured_has_no_delay(tmp_path: Path) -> None:
    path = tmp_path / "model.toml"
    write_model(Model(kind="dc", parameters=MOTOR, recording=Layout(delays={"speed": 1e-3})), path)
    path.write_text(path.read_text().replace("delays.speed", "delays.voltage"))
    with pytest.raises(rwn.InputError, match="voltage"):
        rwn.read_model(path)


def test_what_was_missing_is_missing_where_it_belongs_in_time() -> None:
    lost = np.zeros(TIME.size, dtype=bool)
    lost[100:103] = True
    made = in_time(replace(RUN, missing={"speed": lost}), {"speed": 4e-3}).missing["speed"]
    assert np.flatnonzero(made[:400]).tolist() == [96, 97, 98]


def test_a_delay_is_reported_in_seconds() -> None:
    found = Fault(name=SHIFT, signals=("speed",), meaning="", delay=-4, step=1e-3).found()
    assert found.parameters["shift"].value == pytest.approx(-4e-3)
    assert "factor" not in found.parameters
