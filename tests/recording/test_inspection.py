"""What the check of a recording finds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from rwn.recording.inspection import inspected
from rwn.recording.inspection.clipping import CLIPPING, _last_codes
from rwn.recording.recording import Recording

Array = NDArray[np.float64]

N = 4000


def _recording(signals: Mapping[str, Array]) -> Recording:
    time = 1e-3 * np.arange(N)
    voltage = 6.0 * np.sign(np.sin(3.0 * time))
    return Recording(name="run", time=time, signals={"voltage": voltage, **signals})


@pytest.fixture
def speed() -> Array:
    noise = np.random.default_rng(1).standard_normal(N)
    return 100.0 * np.sin(2.0 * np.arange(N) * 1e-3) + 0.1 * noise


def test_a_clean_signal_is_left_as_it_is(speed: Array) -> None:
    found = inspected([_recording({"speed": speed})])
    assert found.findings == ()
    assert np.array_equal(found.recordings[0].signals["speed"], speed)


def test_spikes_are_found_left_out_and_said(speed: Array) -> None:
    at = [50, 700, 701, 1500, 2200, 2201, 3000]
    speed[at] = [250.0, 0.0, -250.0, 0.0, 250.0, 250.0, 250.0]
    found = inspected([_recording({"speed": speed})])
    lost = found.recordings[0].missing["speed"]
    assert set(np.flatnonzero(lost)) >= {50, 1500, 2200, 2201, 3000}
    assert set(np.flatnonzero(lost)) <= set(at)
    assert found.findings[0].kind == "spikes"
    assert "speed" in found.findings[0].words
    assert np.abs(np.asarray(found.recordings[0].signals["speed"])[[50, 1500, 3000]]).max() < 101.0


def test_a_lone_spike_is_said_as_one(speed: Array) -> None:
    speed[50] = 250.0
    (found,) = inspected([_recording({"speed": speed})]).findings
    assert found.words == "1 single sample of the speed (sample 51) is far off those beside it"


def test_a_signal_that_jumps_often_has_no_spikes(speed: Array) -> None:
    speed[::23] += 30.0
    assert inspected([_recording({"speed": speed})]).findings == ()


def test_held_samples_are_found(speed: Array) -> None:
    held = np.repeat(speed[::4], 4)
    found = inspected([_recording({"speed": held})])
    assert [f.kind for f in found.findings] == ["held"]
    assert found.recordings[0].missing["speed"].mean() == pytest.approx(0.75, abs=0.01)


def test_a_clipped_signal_is_found(speed: Array) -> None:
    found = inspected([_recording({"speed": np.clip(speed, -60.0, 60.0)})])
    assert [f.kind for f in found.findings] == ["clipping"]
    lost = found.recordings[0].missing["speed"]
    assert np.abs(speed[lost]).min() > 59.0


def test_peaks_that_are_cut_off_for_a_sample_each_are_found(speed: Array) -> None:
    """Few rows for each swing: one or two are beyond the end of the range."""
    swinging = 62.0 * np.sin(1.1 * np.arange(speed.size)) + np.random.default_rng(3).standard_normal(speed.size)
    cut = np.clip(swinging, -60.0, 60.0)
    (found,) = inspected([_recording({"speed": cut})]).findings
    assert found.kind == "clipping"
    assert found.count == np.count_nonzero(cut != swinging)


def _peaks(highest: float) -> Array:
    """A current [A] in steps of 0.3125 A that decays from peaks, the highest alone beyond the others."""
    since = np.arange(4000) % 400
    peaks = np.where(np.arange(4000) // 400 == 3, highest, 20.0)
    return 0.3125 * np.round(peaks * np.exp(-since / 30.0) * (1.0 - np.exp(-(since + 1.0))) / 0.3125)


def _clipped(current: Array) -> Array:
    return np.asarray(CLIPPING.flags(_recording({"current": current}), "current"))


def test_the_last_codes_of_a_coarse_converter_are_clipped() -> None:
    """8 bits for 40 A: a peak of 60 A is 39.6875 A for some samples, too few to stand out by themselves."""
    cut = np.minimum(_peaks(60.0), 39.6875)
    assert 0 < np.count_nonzero(_clipped(cut)) < 20
    assert np.array_equal(_clipped(cut), cut == 39.6875)
    assert _clipped(np.maximum(-_peaks(60.0), -40.0)).any()


def test_a_largest_code_that_no_word_ends_at_is_a_peak_and_one_that_lasts_a_level() -> None:
    assert not _clipped(_peaks(36.0)).any()
    lasting = np.where(np.arange(4000) % 400 < 100, 39.6875, _peaks(20.0))
    assert not _last_codes(lasting, 0.3125).any()
    assert _last_codes(np.minimum(_peaks(60.0), 39.6875), 0.3125).any()


def test_a_largest_value_that_comes_twice_is_not_clipped(speed: Array) -> None:
    twice = np.minimum(speed, np.sort(speed)[-2])
    assert not inspected([_recording({"speed": twice})]).findings


def test_coarse_samples_are_held_where_all_changes_lie_on_one_grid(speed: Array) -> None:
    coarse = np.round(speed / np.ptp(speed) * 200.0)
    kept = np.flatnonzero(np.arange(speed.size) % 97 != 5)  # rows were lost, so that the grid is one of ticks
    assert inspected([_recording({"speed": coarse})]).findings == ()
    whole = _recording({"speed": np.repeat(coarse[::6], 6)[: speed.size]})
    held = replace(whole, time=whole.time[kept], signals={name: x[kept] for name, x in whole.signals.items()})
    (found,) = inspected([held]).findings
    assert (found.kind, found.words) == ("held", "the speed is updated every 6 samples and held between")
    assert found.count == pytest.approx(kept.size * 5 / 6, abs=20)  # an equal value on the grid is an update


def test_samples_that_repeat_the_last_now_and_then_are_held(speed: Array) -> None:
    rng = np.random.default_rng(4)
    written = np.round(speed, 4)
    assert inspected([_recording({"speed": written})]).findings == ()
    at = np.flatnonzero(rng.random(N) < 0.01)
    for k in at:
        written[k + 1 : k + int(rng.integers(2, 5))] = written[k]
    (found,) = inspected([_recording({"speed": written})]).findings
    assert (found.kind, found.words) == ("held", "the speed repeats its last sample now and then")
    assert found.count == int(np.sum(np.diff(written) == 0.0))


def test_noise_that_is_written_alike_by_chance_is_not_held(speed: Array) -> None:
    written = np.round(speed, 2)  # a tenth of its noise
    assert np.sum(np.diff(written) == 0.0) > 40
    assert inspected([_recording({"speed": written})]).findings == ()


def test_a_value_that_comes_back_is_that_of_a_standstill(speed: Array) -> None:
    at_rest = np.where(np.arange(N) % 100 < 80, np.round(speed, 4), 0.0)
    assert inspected([_recording({"speed": at_rest})]).findings == ()


def test_rows_between_coarse_samples_that_are_alike_are_not_held() -> None:
    rng, rows = np.random.default_rng(5), np.arange(N)
    counts = 0.7 * np.round(0.4 * rows)  # two or three rows have each of them
    between = np.interp(rows + 0.3 * rng.random(N), rows, counts)
    assert 0.1 < np.mean(np.diff(between) == 0.0) < 0.3
    assert inspected([_recording({"speed": between})]).findings == ()


def test_counts_at_standstill_are_neither_held_nor_clipped() -> None:
    rng = np.random.default_rng(2)
    counts = np.round(20.0 * np.maximum(np.sin(3e-3 * np.arange(N)), 0.0) + 0.3 * rng.standard_normal(N))
    assert inspected([_recording({"speed": 0.5 * counts})]).findings == ()


def test_a_held_signal_that_rests_at_its_largest_value_is_not_clipped(speed: Array) -> None:
    """An update may bring the same value once more: the plateau is that of the motion, and the usual gap is said."""
    updated = np.round(speed[::10], 2)
    updated[120:126] = np.max(updated) + 0.5
    found = inspected([_recording({"speed": np.repeat(updated, 10)})])
    assert [finding.kind for finding in found.findings] == ["held"]
    assert "every 10 samples" in found.findings[0].words


@pytest.mark.parametrize(
    ("ratio", "said"), [(60.0 / (2.0 * np.pi), "9.55 times"), (-1.0, "of the other sign"), (1.07, "1.07 times")]
)
def test_a_speed_that_contradicts_its_position_is_said(ratio: float, said: str, speed: Array) -> None:
    position = 3.0 - 50.0 * np.cos(2.0 * np.arange(N) * 1e-3)
    (found,) = inspected([_recording({"speed": ratio * speed, "position": position})]).findings
    assert (found.kind, found.signals) == ("contradiction", ("speed", "position"))
    assert said in found.words


@pytest.mark.parametrize("how", ["alike", "a bias of the speed", "2 % of a sensor", "wraps", "late", "steady", "still"])
def test_a_speed_and_position_that_may_be_of_one_motion_are_not_doubted(how: str, speed: Array) -> None:
    position = 3.0 - 50.0 * np.cos(2.0 * np.arange(N) * 1e-3)
    if how == "wraps":
        position = np.mod(position, 2.0 * np.pi)
    elif how == "late":
        speed = np.roll(speed, 20)
    elif how == "steady":
        position, speed = 500.0 * np.arange(N) * 1e-3, 1000.0 + speed / 100.0
    elif how == "still":
        position = np.zeros(N)
    speed = speed * (1.02 if how == "2 % of a sensor" else 1.0) + (5.0 if how == "a bias of the speed" else 0.0)
    found = inspected([_recording({"speed": speed, "position": position})]).findings
    assert "contradiction" not in [finding.kind for finding in found]
