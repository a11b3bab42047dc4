"""Noise on a recorded voltage: a sensor's, or what the drive had."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from rwn.recording.denoising import denoised
from rwn.recording.inspection import inspected
from rwn.recording.inspection.input_noise import _goes_with, without_input_noise
from rwn.recording.noise import noise_of_differences

MOTOR = rwn.Model(
    kind="dc",
    parameters={
        "resistance": 1.1, "inductance": 4.5e-4, "torque_constant": 0.037, "back_emf_constant": 0.037,
        "inertia": 2.9e-5, "viscous_friction": 6e-6,
    },
)  # fmt: skip
TIME = 1e-3 * np.arange(3000)
INPUTS = {
    "steps": 5.0 * np.sign(np.sin(41.0 * TIME)) * np.where(np.sin(7.0 * TIME) > 0.0, 1.0, 0.4),
    "chirp": 5.0 * np.sin(20.0 * TIME * (1.0 + TIME)),
    "ramps": 4.0 * np.arcsin(np.sin(9.0 * TIME)),
}
LEFT = {"steps": 0.3, "chirp": 0.85, "ramps": 0.6}  # of the noise: a chirp of 22 Hz leaves little to smooth over
NOISE = 0.03  # V


def _run(voltage: np.ndarray, seed: int = 0) -> rwn.Recording:
    """What the drive does under a voltage, with noise on its sensors."""
    rng = np.random.default_rng(seed)
    bare = rwn.Recording(name="run", time=TIME, signals={"voltage": voltage})
    shown = rwn.simulate(MOTOR, bare).signals
    noisy = {s: shown[s] + level * rng.standard_normal(TIME.size) for s, level in (("current", 0.02), ("speed", 0.3))}
    return replace(bare, signals={"voltage": voltage, **noisy})


def _noisy(voltage: np.ndarray, seed: int = 1) -> np.ndarray:
    return np.asarray(voltage + NOISE * np.random.default_rng(seed).standard_normal(voltage.size))


@pytest.mark.parametrize("name", INPUTS)
def test_a_sensors_noise_is_taken_off(name: str) -> None:
    true = _run(INPUTS[name])
    recorded = replace(true, signals={**true.signals, "voltage": _noisy(INPUTS[name])})
    found, (said,) = without_input_noise(recorded)
    assert said.kind == "input-noise"
    assert 0.6 * NOISE < float(said.words.split(" noise of ")[1].split(" V")[0]) < 1.1 * NOISE
    left = found.signals["voltage"] - INPUTS[name]
    assert np.sqrt(np.mean(left**2)) < LEFT[name] * NOISE
    assert np.array_equal(found.signals["speed"], true.signals["speed"])


@pytest.mark.parametrize("seed", range(4))
def test_the_bends_of_ramps_are_no_noise(seed: int) -> None:
    """Smoothed over, the voltage would be off at each of them, where the current bends too."""
    rng = np.random.default_rng(seed)
    corners = np.cumsum(rng.integers(20, 90, 80))
    ramps = np.interp(np.arange(TIME.size), corners, 5.0 * rng.uniform(-1.0, 1.0, 80))
    recorded = replace(run := _run(ramps), signals={**run.signals, "voltage": _noisy(ramps)})
    assert [said.kind for said in without_input_noise(recorded)[1]] == ["input-noise"]


@pytest.mark.parametrize("name", INPUTS)
def test_noise_that_drives_a_current_stays(name: str) -> None:
    recorded = _run(_noisy(INPUTS[name]))
    assert without_input_noise(recorded) == (recorded, [])


def test_noise_that_a_controller_makes_of_a_sensors_stays() -> None:
    """A proportional controller, whose voltage has the noise of the speed that it answers."""
    run = _run(INPUTS["steps"])
    smooth = rwn.simulate(MOTOR, run).signals["speed"]
    answered = INPUTS["steps"] - 0.1 * (run.signals["speed"] - smooth)
    recorded = replace(run, signals={**run.signals, "voltage": answered})
    assert without_input_noise(recorded) == (recorded, [])


@pytest.mark.parametrize("name", INPUTS)
def test_a_voltage_without_noise_stays(name: str) -> None:
    assert without_input_noise(_run(INPUTS[name]))[1] == []


def test_values_between_two_steps_of_a_converter_are_no_noise() -> None:
    run, rng = _run(INPUTS["steps"]), np.random.default_rng(6)
    rounded = 0.1 * np.round((INPUTS["steps"] + 0.03 * rng.standard_normal(TIME.size)) / 0.1)
    assert without_input_noise(replace(run, signals={**run.signals, "voltage": rounded}))[1] == []


def test_rows_beside_their_clock_show_a_ramp_as_noise() -> None:
    rng = np.random.default_rng(4)
    time = np.sort(TIME + 3e-4 * rng.uniform(-1.0, 1.0, TIME.size))
    time -= time[0]
    signals = {"voltage": 4.0 * np.arcsin(np.sin(9.0 * time)), "speed": 0.3 * rng.standard_normal(time.size)}
    recorded = rwn.Recording(name="run", time=time, signals=signals)
    assert without_input_noise(recorded)[1] == []


def test_a_torque_is_left_as_it_is() -> None:
    """It may be what a model is judged by."""
    rng = np.random.default_rng(5)
    signals = {"torque": _noisy(INPUTS["steps"]), "speed": 0.3 * rng.standard_normal(TIME.size)}
    recorded = rwn.Recording(name="run", time=TIME, signals=signals)
    assert without_input_noise(recorded)[1] == []


def test_the_check_says_it() -> None:
    true = _run(INPUTS["steps"])
    recorded = replace(true, signals={**true.signals, "voltage": _noisy(INPUTS["steps"])})
    kinds = {finding.kind for finding in inspected([recorded]).findings}
    assert "input-noise" in kinds


def test_independent_noise_is_rarely_taken_for_what_acts() -> None:
    """At a level of 1 %: of 40 recordings at most 3 (more by chance in one of 1500)."""
    true = _run(INPUTS["steps"])
    kept = [
        not without_input_noise(replace(true, signals={**true.signals, "voltage": _noisy(INPUTS["steps"], seed)}))[1]
        for seed in range(40)
    ]
    assert sum(kept) <= 3


def test_two_estimates_of_white_noise_differ_by_their_deviation() -> None:
    """What a voltage that is smooth is told from one with noise by: 0.85 over sqrt(n)."""
    rng = np.random.default_rng(0)
    drawn = rng.standard_normal((200, 500))
    ratios = [noise_of_differences(np.diff(x, 4), 4) / noise_of_differences(np.diff(x, 2), 2) for x in drawn]
    assert np.std(ratios) * np.sqrt(500) == pytest.approx(0.85, rel=0.15)


def test_what_rounding_makes_negative_is_a_chance_of_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """The distance of two signals that are as unlike as can be may come out below 0; a chance that is no number decides
    as if the two went together."""
    rng = np.random.default_rng(1)
    noise, other = rng.standard_normal((2, 4000))
    assert 0.0 <= _goes_with(noise, other) <= 1.0
    pinv = np.linalg.pinv
    monkeypatch.setattr(np.linalg, "pinv", lambda *of, **how: -pinv(*of, **how))
    assert _goes_with(noise, other) == 1.0


def test_long_courses_are_followed_in_pieces_as_well_as_short_ones() -> None:
    """Lines with bends, over several times the rows in which lines are sought at once."""
    rng, rows = np.random.default_rng(7), np.arange(10_000)
    course = np.interp(rows, rows[::400], rng.uniform(-5.0, 5.0, rows[::400].size))
    found = denoised(course + 0.2 * rng.standard_normal(rows.size))
    assert found is not None
    assert found.noise == pytest.approx(0.2, rel=0.05)
    assert np.sqrt(np.mean((found.values - course) ** 2)) < 0.2 * 0.25
