"""Filters that a drive runs its samples through."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.model.files import write_model
from rwn.model.model import Model
from rwn.recording.columns import Layout
from rwn.recording.filters import as_filtered, unfiltered

RNG = np.random.default_rng(3)
TIME = np.cumsum(1e-3 * RNG.uniform(0.75, 1.25, 400))  # off its clock
RUN = rwn.Recording(name="run", time=TIME, signals={"voltage": np.sin(30.0 * TIME), "speed": RNG.standard_normal(400)})


def test_a_filtered_signal_is_put_back_as_it_was() -> None:
    shown = replace(RUN, signals={**RUN.signals, "speed": as_filtered(TIME, RUN.signals["speed"], 2e-3)})
    made = unfiltered(shown, {"speed": 2e-3})
    assert made.signals["speed"] == pytest.approx(RUN.signals["speed"], abs=1e-12)
    assert unfiltered(RUN, {}) is RUN
    assert unfiltered(RUN, {"current": 1e-3}) is RUN


def test_a_program_filters_sample_by_sample_however_late_each_is() -> None:
    rng = np.random.default_rng(1)
    time = 1e-3 * (np.arange(600) + rng.uniform(0.0, 0.25, 600))
    speed, kept = rng.standard_normal(600), np.exp(-1.0 / 2.0)
    shown = lfilter([1.0 - kept], [1.0, -kept], speed, zi=[kept * speed[0]])[0]
    made = unfiltered(rwn.Recording(name="run", time=time, signals={"voltage": speed, "speed": shown}), {"speed": 2e-3})
    assert made.signals["speed"] == pytest.approx(speed, abs=0.02)  # as well as the clock is known from its rows


def test_what_follows_a_missing_sample_is_missing() -> None:
    missing = np.zeros(400, dtype=bool)
    missing[[50, 399]] = True
    made = unfiltered(replace(RUN, missing={"speed": missing}), {"speed": 2e-3})
    assert np.flatnonzero(made.missing["speed"]).tolist() == [50, 51, 399]


def test_a_filter_is_in_the_simulation_against_the_file(tmp_path: Path) -> None:
    model = Model(kind="dc", parameters=MOTOR, recording=Layout(filters={"speed": 2e-3}))
    write_model(model, tmp_path / "corrected.toml")
    read = rwn.read_model(tmp_path / "corrected.toml")
    assert read.recording.filters == {"speed": pytest.approx(2e-3)}
    bare = replace(RUN, signals={"voltage": RUN.signals["voltage"]})
    plain = rwn.simulate(replace(model, recording=Layout()), bare).signals["speed"]
    assert rwn.simulate(read, bare).signals["speed"] == pytest.approx(as_filtered(TIME, plain, 2e-3), rel=1e-12)


@pytest.mark.parametrize("entry", ["filters.voltage = 0.002", "filters.speed = 0", "filters.speed = -1e-3"])
def test_what_is_no_filter_is_refused(tmp_path: Path, entry: str) -> None:
    path = tmp_path / "model.toml"
    write_model(Model(kind="dc", parameters=MOTOR, recording=Layout(filters={"speed": 2e-3})), path)
    path.write_text(path.read_text().replace("filters.speed = 0.002", entry))
    with pytest.raises(rwn.InputError, match="filter"):
        rwn.read_model(path)
