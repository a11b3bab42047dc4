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
from rwn.recording.filters import as_filtered, before_filter, unfiltered
from rwn.recording.layout import Layout

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


def _thinned(every: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time, samples and what a filter of 2 ms shows of them, at every so many ticks of the 1 ms that it runs by."""
    samples = RNG.standard_normal(300)
    ticks = np.interp(np.arange(every * 299 + 1) / every, np.arange(300), samples)
    kept = np.exp(-1.0 / 2.0)
    shown = lfilter([1.0 - kept], [1.0, -kept], ticks, zi=[kept * ticks[0]])[0]
    return every * 1e-3 * np.arange(300), samples, shown[::every]


@pytest.mark.parametrize("every", [1, 2, 3])
def test_a_filter_runs_by_the_clock_of_the_drive_of_which_rows_show_every_so_many_ticks(every: int) -> None:
    time, samples, shown = _thinned(every)
    found, _ = before_filter(time, shown, 2e-3, ticks_per_row=every)
    assert found == pytest.approx(samples, abs=1e-9)
    assert as_filtered(time, samples, 2e-3, ticks_per_row=every) == pytest.approx(shown, abs=1e-12)


def test_a_filter_goes_on_over_a_row_that_was_lost() -> None:
    time, samples, _ = _thinned(1)
    samples[150] = 0.5 * (samples[149] + samples[151])
    kept, rest = np.exp(-1.0 / 2.0), np.arange(300) != 150
    shown = lfilter([1.0 - kept], [1.0, -kept], samples, zi=[kept * samples[0]])[0]
    found, _ = before_filter(time[rest], shown[rest], 2e-3)
    assert found == pytest.approx(samples[rest], abs=1e-9)


def test_what_was_not_measured_spoils_no_more_than_the_sample_after_it() -> None:
    time, samples, shown = _thinned(2)
    missing = np.arange(300) == 100
    wrong, lost = before_filter(time, np.where(missing, 1e6, shown), 2e-3, ticks_per_row=2, missing=missing)
    assert np.flatnonzero(lost).tolist() == [100, 101]
    right, _ = before_filter(time, shown, 2e-3, ticks_per_row=2, missing=missing)
    assert wrong[~lost] == pytest.approx(right[~lost], abs=1e-9)
    assert right[~lost] == pytest.approx(samples[~lost], abs=1.0)
