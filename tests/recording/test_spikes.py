"""A spike is off a signal that rests beside it; a peak of the motion, however sharp, is none."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from made_up_motor import MOTOR
from rwn.model.files import read_model
from rwn.model.model import Model
from rwn.recording.inspection import inspected
from rwn.recording.inspection.spikes import SPIKES
from rwn.recording.recording import Recording, read_recording
from rwn.recording.signals import MEASURED
from rwn.simulate.simulation import simulate

Array = NDArray[np.float64]
TIME = np.arange(4000) * 1e-3


def _recording(**signals: Array) -> Recording:
    voltage = 8.0 * np.sign(np.sin(9.0 * TIME))
    return Recording(name="run", time=TIME, signals={"voltage": voltage, **signals})


def _peaks(noise: float, seed: int = 1) -> Array:
    """A current that peaks some samples after each step of the voltage: winding and coupling of 1 to 3 ms."""
    after = np.mod(TIME, np.pi / 9.0) / 1e-3
    way = np.sign(np.sin(9.0 * TIME))
    levels = np.repeat(1.0 + 0.02 * np.arange(20), 349)[: TIME.size]  # each may be the highest so far
    rng = np.random.default_rng(seed)
    return levels * way * 20.0 * (np.exp(-after / 30.0) - np.exp(-after / 1.5)) + noise * rng.standard_normal(TIME.size)


def test_a_current_that_peaks_by_itself_has_no_spikes() -> None:
    for seed in range(5):
        run = _recording(current=_peaks(0.02, seed))
        assert not SPIKES.flags(run, "current").any()


def test_a_speed_that_a_sensor_rectifies_has_none_where_it_turns() -> None:
    rng = np.random.default_rng(1)
    run = _recording(speed=np.abs(150.0 * np.sin(9.0 * TIME)) + 0.05 * rng.standard_normal(TIME.size))
    assert not SPIKES.flags(run, "speed").any()


@pytest.mark.parametrize("frequency", [210.0, 230.0])
def test_pairs_of_samples_at_the_tops_of_a_fast_ripple_are_none(frequency: float) -> None:
    """Of less than five samples a period, at one speed of the run: some are beyond all single tops, by little."""
    for seed in range(5):
        noise = 0.2 * np.random.default_rng(seed).standard_normal(TIME.size)
        at_this_speed = np.abs(TIME - 2.0) < 0.2
        ripple = 15.0 * at_this_speed * np.cos(2.0 * np.pi * frequency * (TIME - 2.0005))
        assert not SPIKES.flags(_recording(speed=ripple + noise), "speed").any()


@pytest.mark.parametrize("speeds", [[26.6, 16.9, 8.9, 0.0, 7.1, 16.6, 10.0], [-0.31, -0.31, 0.21, 0.0, 5.3, 9.1, 14.0]])
def test_a_speed_that_turns_or_begins_at_0_has_dropped_no_sample(speeds: list[float]) -> None:
    rng = np.random.default_rng(1)
    speed = np.repeat([30.0, -25.0, 20.0, 4.0], 1000) + 0.25 * rng.standard_normal(TIME.size)
    speed[1500:1507] = speeds
    assert not SPIKES.flags(replace(_recording(speed=speed), signals={"speed": speed}), "speed")[1503]


def test_spikes_among_such_peaks_are_found() -> None:
    at = [150, 151, 600, 900, 1801, 3000]
    current = _peaks(0.02)
    current[at] = [30.0, -30.0, 30.0, -30.0, 30.0, 30.0]
    assert set(np.flatnonzero(SPIKES.flags(_recording(current=current), "current"))) == set(at)


def _drive(seed: int, *, friction: float) -> Recording:
    """A motor under steps of all sizes; its current peaks within a sample of each."""
    rng = np.random.default_rng(seed)
    voltage = np.repeat(np.round(rng.uniform(-20.0, 20.0, 40)), TIME.size // 40)
    current, speed = np.zeros(TIME.size), np.zeros(TIME.size)
    for k in range(1, TIME.size):
        i, w = current[k - 1], speed[k - 1]
        current[k] = i + 0.6 * ((voltage[k - 1] - 0.05 * w) / 0.5 - i)
        speed[k] = w + 1e-3 * (0.05 * i - friction * np.sign(w) - 2e-5 * w) / 1.5e-4
    return Recording(
        name="run", time=TIME,
        signals={
            "voltage": voltage, "current": current + 0.04 * rng.standard_normal(TIME.size),
            "speed": speed + 0.3 * rng.standard_normal(TIME.size),
        },
    )  # fmt: skip


@pytest.mark.parametrize(("signal", "size"), [("speed", 50.0), ("current", 20.0)])
@pytest.mark.parametrize("late", [-1, 1, 2])
def test_a_spike_beside_a_step_is_told_from_what_the_step_does(signal: str, size: float, late: int) -> None:
    """It is not larger than all that steps do: the other steps tell what the motion does."""
    for seed in range(3):
        run = _drive(seed, friction=0.012)
        assert not SPIKES.flags(run, signal).any()
        steps = np.abs(np.diff(run.signals["voltage"]))
        at = sorted(int(k) + 1 + late for k in np.argsort(steps)[-2:])
        spoilt = run.signals[signal].copy()
        spoilt[at] += size
        assert np.max(np.abs(spoilt)) < 2.0 * np.max(np.abs(run.signals[signal]))
        found = SPIKES.flags(replace(run, signals={**run.signals, signal: spoilt}), signal)
        assert np.flatnonzero(found).tolist() == at


@pytest.mark.parametrize("fastest", [1.5, 60.0])
def test_under_a_sweep_no_sample_is_after_a_step(fastest: float) -> None:
    """Nor need a spike be beyond all of the motion: that a sine changes fast is no step."""
    voltage = 15.0 * np.sin(2.0 * np.pi * (0.3 + (fastest - 0.3) * TIME / 8.0) * TIME)
    speed = 120.0 * np.sin(2.0 * np.pi * 0.4 * TIME) + 0.25 * np.random.default_rng(2).standard_normal(TIME.size)
    at = np.arange(150, TIME.size, 400)
    speed[at] -= 200.0 * np.sign(speed[at])  # within the motion
    assert np.abs(speed[at]).max() < 200.0
    run = Recording(name="run", time=TIME, signals={"voltage": voltage, "speed": speed})
    assert np.flatnonzero(SPIKES.flags(run, "speed")).tolist() == at.tolist()


def test_a_dropout_on_a_steep_flank_is_found_by_the_value_that_others_have() -> None:
    current = _peaks(0.02)
    flank = 501 + int(np.argmax(np.diff(current)[500:]))
    current[flank] = 0.5 * (current[flank - 1] + current[flank + 1])
    assert not SPIKES.flags(_recording(current=current - current[flank]), "current")[flank]
    dropped = current - current[flank]
    dropped[[600, 900]] = 0.0
    assert set(np.flatnonzero(SPIKES.flags(_recording(current=dropped), "current"))) == {flank, 600, 900}


def test_a_value_that_is_a_spikes_once_and_often_a_measurement_is_no_spike() -> None:
    speed = np.rint(20.0 * np.sin(TIME))
    speed[1000] = 0.0
    flags = SPIKES.flags(_recording(speed=speed), "speed")
    assert flags[1000]
    assert np.sum(speed[~flags] == 0.0) > 20


def test_the_first_and_the_last_sample_beside_it_may_be_all_that_there_is() -> None:
    speed = 100.0 * np.sin(TIME) + 0.05 * np.random.default_rng(1).standard_normal(TIME.size)
    speed[[1, -2]] = 300.0
    assert np.flatnonzero(SPIKES.flags(_recording(speed=speed), "speed")).tolist() == [1, TIME.size - 2]


@pytest.mark.parametrize("at", [0, TIME.size - 1])
def test_so_may_a_spike_itself_be_where_it_is_beyond_the_motion(at: int) -> None:
    speed = 100.0 * np.sin(TIME) + 0.05 * np.random.default_rng(1).standard_normal(TIME.size)
    speed[at] = -150.0
    assert np.flatnonzero(SPIKES.flags(_recording(speed=speed), "speed")).tolist() == [at]


def test_a_run_that_begins_at_rest_under_a_step_begins_with_no_spike() -> None:
    noise = 0.01 * np.random.default_rng(1).standard_normal(TIME.size)
    current = np.where(TIME > 0.0, 5.0 * np.exp(-TIME / 0.5), 0.0) + noise
    assert not SPIKES.flags(_recording(current=current), "current").any()
    current[[0, -1]] = 0.0
    assert not SPIKES.flags(_recording(current=current), "current").any()


def test_a_spike_in_a_value_that_is_held_is_found_and_what_follows_it_is_held_too() -> None:
    noise = 0.01 * np.random.default_rng(1).standard_normal(TIME.size // 5)
    current = np.repeat(np.sin(TIME[::5]) + noise, 5)
    current[[503, 2001]] = 9.0
    (found,), _ = inspected([_recording(current=current)])
    measured = np.flatnonzero(~found.missing["current"])
    assert set(measured) == set(range(0, TIME.size, 5))


def test_spikes_of_a_value_that_is_held_are_counted_by_rows_not_by_updates() -> None:
    """One row in a hundred is 3 % of the updates of a speed that is held for three rows."""
    rng = np.random.default_rng(2)
    speed = np.repeat(100.0 * np.sin(TIME[::4]) + 0.1 * rng.standard_normal(TIME[::4].size), 4)
    at = np.arange(50, TIME.size, 100)
    speed[at] = 300.0
    (found,), findings = inspected([_recording(speed=speed)])
    assert [f.count for f in findings if f.kind == "spikes"] == [at.size]
    assert found.missing["speed"][at].all()


def _flagged(file: Path) -> tuple[Recording, dict[str, Array]]:
    model = read_model(file.parent / "model.toml")
    run = read_recording(file, layout=model.recording)
    return run, {s: SPIKES.flags(run, s) for s in MEASURED if s in run.signals}


@pytest.mark.parametrize("case", range(1, 15))
def test_the_clean_example_cases_have_none(case: int, shared: Path) -> None:
    for file in sorted((shared / f"cases/case_{case:02}").glob("*_?.csv")):
        _, found = _flagged(file)
        assert not any(flags.any() for flags in found.values()), file


def test_those_of_the_messy_cases_are_found_and_nothing_else(shared: Path) -> None:
    hit, there = 0, 0
    for file in sorted((shared / "messy/outliers").glob("*/*_?.csv")):
        run, found = _flagged(file)
        clean, _ = _flagged(shared / "cases" / file.parent.name / file.name)
        for signal, flags in found.items():
            spoilt = run.signals[signal] != clean.signals[signal]
            assert not (flags & ~spoilt).any(), (file, signal)
            hit, there = hit + int((flags & spoilt).sum()), there + int(spoilt.sum())
    # the others: zeros within the noise or the slope beside them, peaks no larger than that slope, one beside a zero
    assert there == 426
    assert hit >= 415


def test_what_follows_lost_rows_is_no_spike() -> None:
    """An inrush that began in rows which are lost is seen in one row, and that row says most."""
    rng, time = np.random.default_rng(0), 2e-3 * np.arange(2500)
    voltage = np.repeat(rng.uniform(-12.0, 12.0, 25), 100)
    voltage[:100] = 0.0
    run = Recording(name="run", time=time, signals={"voltage": voltage})
    current = simulate(Model(kind="dc", parameters=MOTOR), run).signals["current"]
    kept = rng.uniform(size=time.size) > 0.04
    signals = {"voltage": voltage, "current": current + 0.02 * rng.standard_normal(time.size)}
    _, found = inspected([replace(run, time=time[kept], signals={k: x[kept] for k, x in signals.items()})])
    assert not [f for f in found if f.kind == "spikes"]
