"""Whether a recording starts at rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from rwn.model.initial_state import initial_state_of
from rwn.model.model import Model
from rwn.recording.speed_measurement import CENTRAL

Array = NDArray[np.float64]

MODEL = Model(
    kind="dc",
    parameters={"resistance": 2.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05,
                "inertia": 2e-5, "viscous_friction": 2e-5},
)  # fmt: skip
TIME = 1e-3 * np.arange(500)


def _signals(speed: Array) -> dict[str, Array]:
    noise = np.random.default_rng(3).standard_normal(TIME.size)
    return {"voltage": np.full(TIME.size, 5.0), "speed": speed + 0.05 * noise}


def test_noise_about_zero_is_rest_however_fast_the_start() -> None:
    start = initial_state_of(TIME, _signals(80.0 * (1.0 - np.exp(-TIME / 0.01))), MODEL)
    assert not start.in_motion
    assert start.state == (0.0, 0.0, 0.0)


def test_a_first_sample_off_zero_is_motion_with_the_current_that_goes_with_it() -> None:
    start = initial_state_of(TIME, _signals(np.full(TIME.size, 60.0)), MODEL)
    assert start.in_motion
    assert start.state[1] == pytest.approx(60.0, abs=0.3)
    assert start.state[0] == pytest.approx((5.0 - 0.05 * 60.0) / 2.0, abs=0.02)
    assert set(start.spread) == {"initial_speed", "initial_current", "initial_position"}


@pytest.mark.parametrize(("lost", "in_motion"), [(1, True), (3, True), (400, False)])
def test_where_the_first_sample_is_missing_the_next_that_was_measured_tells(lost: int, in_motion: bool) -> None:
    missing = {"speed": np.arange(TIME.size) < lost}
    signals = _signals(np.where(missing["speed"], 1e6, 60.0))
    start = initial_state_of(TIME, signals, MODEL, missing=missing)
    assert start.in_motion is in_motion
    assert start.state[1] == pytest.approx(60.0 if in_motion else 0.0, abs=0.3)


def test_values_held_between_updates_do_not_make_the_noise_small() -> None:
    """As a bus brings them: a rest with noise is a rest, a motion is a motion."""
    last = np.arange(TIME.size) // 4 * 4
    missing = {"speed": np.arange(TIME.size) % 4 > 0}
    for speed in (0.0, 60.0):
        signals = {n: x[last] for n, x in _signals(np.full(TIME.size, speed)).items()}
        assert initial_state_of(TIME, signals, MODEL, missing=missing).in_motion is (speed > 0.0)


def test_the_model_file_may_say_it() -> None:
    resting = replace(MODEL, recording=replace(MODEL.recording, initial="rest"))
    assert not initial_state_of(TIME, _signals(np.full(TIME.size, 60.0)), resting).in_motion
    moving = replace(MODEL, recording=replace(MODEL.recording, initial="estimate"))
    assert initial_state_of(TIME, _signals(np.zeros(TIME.size)), moving).in_motion


def test_a_position_starts_within_its_steps_of_the_first_sample() -> None:
    count = 2.0 * np.pi / 2000.0
    position = np.round(40.0 * TIME**2 / count) * count + 0.7
    start = initial_state_of(TIME, {"voltage": np.ones(TIME.size), "position": position}, MODEL)
    assert not start.in_motion
    assert start.state[2] == pytest.approx(0.7)
    assert start.spread["initial_position"] == pytest.approx(count, rel=0.01)


def test_the_speed_of_a_position_is_known_to_the_bend_of_its_first_samples() -> None:
    """An axis that gathers speed; steps of 1e-8 m."""
    position = np.round((0.006 * TIME + 0.5 * TIME**2 - 2.0 * TIME**3) / 1e-8) * 1e-8
    axis = Model(kind="axis", parameters={"inertia": 95.0, "viscous_friction": 200.0}, linear=True)
    start = initial_state_of(TIME, {"force": np.ones(TIME.size), "position": position}, axis)
    assert start.in_motion
    assert start.state[1] == pytest.approx(0.006, abs=4.0 * start.spread["initial_speed"])
    assert start.spread["initial_speed"] < 0.1 * 0.006


@pytest.mark.parametrize("recorded", [True, False])
def test_the_difference_of_a_position_that_starts_from_rest_is_no_motion(recorded: bool) -> None:
    counts = np.round(512 / (2.0 * np.pi) * 40_000.0 * TIME**2) * (2.0 * np.pi / 512)
    speed = np.gradient(counts, TIME)
    signals = {"voltage": np.full(TIME.size, 5.0), "speed": speed} | ({"position": counts} if recorded else {})
    assert initial_state_of(TIME, signals, MODEL).in_motion is not recorded  # taken for a speed
    assert not initial_state_of(TIME, signals, MODEL, way=CENTRAL).in_motion


def test_the_difference_of_a_position_that_moves_is_a_motion() -> None:
    counts = np.round(512 / (2.0 * np.pi) * 60.0 * TIME) * (2.0 * np.pi / 512)
    signals = {"voltage": np.full(TIME.size, 5.0), "speed": np.gradient(counts, TIME)}
    start = initial_state_of(TIME, signals, MODEL, way=CENTRAL)
    assert start.in_motion
    assert start.state[1] == pytest.approx(60.0, rel=0.15)


def test_an_input_that_switches_soon_does_not_hide_that_it_moves() -> None:
    """One curve through the first samples, before and after, says little of the first."""
    turned = 60.0 * TIME - 0.5 * 4e3 * np.maximum(TIME - 8e-3, 0.0) ** 2
    counts = np.round(4096 / (2.0 * np.pi) * turned) * (2.0 * np.pi / 4096)
    signals = {"voltage": np.where(TIME < 8e-3, 5.0, -5.0), "speed": np.gradient(counts, TIME)}
    start = initial_state_of(TIME, signals, MODEL, way=CENTRAL)
    assert start.in_motion
    assert start.state[1] == pytest.approx(60.0, rel=0.05)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(("first", "in_motion"), [(0.0, False), (12.0, True)])
def test_a_start_from_rest_that_no_parabola_follows_is_a_rest(seed: int, first: float, in_motion: bool) -> None:
    """A voltage that rises from 0 moves the shaft with the fourth power of the time, seen by a position alone."""
    time = 0.5e-3 * np.arange(400)
    noise = 4e-4 * np.random.default_rng(seed).standard_normal(time.size)
    position = first * time + 2e6 * np.maximum(time - 1e-3, 0.0) ** 4 + noise
    start = initial_state_of(time, {"voltage": 300.0 * time, "position": position}, MODEL)
    assert start.in_motion is in_motion


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(("first", "in_motion"), [(0.0, False), (6e-3, True)])
def test_a_speed_whose_noise_lasts_is_no_motion_where_the_position_rests(
    seed: int, first: float, in_motion: bool
) -> None:
    """The mean of 8 differences of a noisy position: differences show a third of its noise."""
    noise = 1e-6 * np.random.default_rng(seed).standard_normal(TIME.size + 8)
    position = first * TIME + 5e-4 * TIME**2 + noise[8:]
    speed = first + 1e-3 * TIME + (noise[8:] - noise[:-8]) / 8e-3
    speed[0] = first + 1.2e-3  # as far off as the noise has it now and then
    speed[1:4] = speed[0] - np.array([3e-5, 9e-5, 3e-4])
    axis = Model(kind="axis", parameters={"inertia": 40.0, "viscous_friction": 160.0}, linear=True)
    signals = {"force": np.zeros(TIME.size), "speed": speed, "position": position}
    assert initial_state_of(TIME, signals, axis).in_motion is in_motion
