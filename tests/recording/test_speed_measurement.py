"""Whether a recorded speed is that of a tachometer or a difference of positions, and of which."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import lfilter

import rwn
from made_up_motor import MOTOR, plant, shaking
from rwn.fit.hypothesis import hypothesis
from rwn.fit.preparation import prepare
from rwn.recording.speed_measurement import (
    BACKWARD,
    CENTRAL,
    DIFFERENCES,
    FORWARD,
    INSTANTANEOUS,
    SpeedMeasurement,
    difference,
    integral,
    speed_measurement,
)
from rwn.recording.speed_window import window_of

Array = NDArray[np.float64]
TIME = np.arange(4000) * 1e-3
ANGLE = 200.0 * TIME - 30.0 * np.sin(8.0 * TIME)
SPEED = np.gradient(ANGLE, 1e-3)
NONE = np.empty(0)


def counted(angle: Array, counts: int) -> Array:
    return 2.0 * np.pi / counts * np.floor(angle * counts / (2.0 * np.pi))


@pytest.mark.parametrize("counts", [415, 1024, 2000])
def test_differences_of_counts_are_told_from_a_coarse_converter(counts: int) -> None:
    angle = counted(ANGLE, counts)
    assert speed_measurement(TIME, difference(CENTRAL, TIME, angle), NONE) is CENTRAL
    assert speed_measurement(TIME, difference(BACKWARD, TIME, angle), NONE) is BACKWARD
    coarse = 2.337 * np.round(SPEED / 2.337)
    assert speed_measurement(TIME, coarse, NONE) is INSTANTANEOUS


@pytest.mark.parametrize("way", [BACKWARD, FORWARD])
def test_counts_over_the_time_that_passed_tell_which_time_it_was(way: SpeedMeasurement) -> None:
    """A small computer reads the counts and the clock when it comes to it, and divides."""
    noted = np.round(TIME + 1e-4 * np.random.default_rng(3).standard_normal(TIME.size), 6)
    angle = counted(np.interp(noted, TIME, 0.3 * ANGLE), 2000)
    read = np.round(difference(way, noted, angle) * 9.5493, 1) / 9.5493
    assert speed_measurement(noted, read, NONE) == way
    coarse = 3.14 * np.round(0.3 * SPEED / 3.14)
    assert speed_measurement(noted, coarse, NONE) is INSTANTANEOUS
    lost = np.delete(np.arange(TIME.size), slice(7, None, 50))  # the drive divides by its own period all the same
    assert speed_measurement(TIME[lost], coarse[lost], NONE) is INSTANTANEOUS


@pytest.mark.parametrize("window", [3, 4, 5, 8])
def test_a_moving_average_of_differences_is_a_difference_over_more_samples(window: int) -> None:
    over = SpeedMeasurement(window, 0)
    assert speed_measurement(TIME, difference(over, TIME, counted(ANGLE, 1024)), NONE) == over


@pytest.mark.parametrize("window", [2, 3, 4, 8])
def test_a_moving_average_of_a_noisy_speed_is_no_difference_of_counts(window: int) -> None:
    noisy = SPEED + 2.0 * np.random.default_rng(5).standard_normal(TIME.size)
    mean = lfilter(np.full(window, 1.0 / window), 1.0, noisy)
    assert speed_measurement(TIME, np.round(mean, 2), NONE) is INSTANTANEOUS


def test_a_central_difference_is_known_through_a_gear() -> None:
    assert speed_measurement(TIME, 0.36612 * difference(CENTRAL, TIME, counted(ANGLE, 1024)), NONE) is CENTRAL


@pytest.mark.parametrize("noise", [0.0, 0.1, 0.5])
def test_a_coarse_converter_whose_step_fits_an_encoder_is_no_difference_of_counts(noise: float) -> None:
    """Of steps that no encoder of few counts makes, one in fifty comes near a whole number (trial 58 of seed 10035)."""
    step = np.pi / 415 / 1e-3
    shown = step * np.round(SPEED / step + noise * np.random.default_rng(1).standard_normal(TIME.size))
    assert speed_measurement(TIME, shown, NONE) is INSTANTANEOUS


@pytest.mark.parametrize("counts", [1024, 8000])
def test_steps_of_a_quick_motor_do_not_hide_differences_of_counts(counts: int) -> None:
    """It follows its steps within some rows, and hardly moves for a hundred: most of the power is of steps."""
    steps = np.repeat(np.random.default_rng(6).uniform(-150.0, 150.0, 40), 100)
    quick = lfilter([0.4], [1.0, -0.6], steps) + 8.0 * np.sin(9.0 * TIME)
    angle = 0.3 + np.concatenate([[0.0], np.cumsum(0.5 * (quick[1:] + quick[:-1]))]) * 1e-3
    assert speed_measurement(TIME, difference(BACKWARD, TIME, counted(angle, counts)), NONE) is BACKWARD
    over_four = difference(SpeedMeasurement(4, 0), TIME, counted(angle, counts))
    assert speed_measurement(TIME, over_four, NONE) is not BACKWARD
    step = 2.0 * np.pi / counts / 1e-3
    assert speed_measurement(TIME, step * np.round(quick / step), NONE) is INSTANTANEOUS


def test_a_difference_is_told_where_the_times_jitter_that_it_was_not_divided_by() -> None:
    rng = np.random.default_rng(7)
    position = ANGLE + 1e-4 * rng.standard_normal(TIME.size)
    shown = TIME + 2e-5 * rng.standard_normal(TIME.size)
    assert speed_measurement(shown - shown[0], difference(BACKWARD, TIME, position), position) is BACKWARD


@pytest.mark.parametrize("way", DIFFERENCES)
def test_a_difference_of_the_recorded_position_repeats_its_noise(way: SpeedMeasurement) -> None:
    position = ANGLE + 1e-4 * np.random.default_rng(2).standard_normal(TIME.size)
    speed = np.round(difference(way, TIME, position), 4)
    assert speed_measurement(TIME, speed, np.round(position, 7)) == way
    tachometer = SPEED + 0.1 * np.random.default_rng(3).standard_normal(TIME.size)
    assert speed_measurement(TIME, tachometer, position) is INSTANTANEOUS


@pytest.mark.parametrize("update", [1, 2])
def test_the_position_beside_it_tells_where_the_middle_of_a_difference_is(update: int) -> None:
    """A drive that runs twice as fast as it updates what is logged, and takes differences about its own instants."""
    fine = np.arange(8000) * 0.5e-3
    angle = counted(200.0 * fine - 30.0 * np.sin(8.0 * fine), 8192)
    centred, backward = (difference(way, fine, angle)[::2] for way in (CENTRAL, SpeedMeasurement(2, 0)))
    position, time = angle[::2], np.arange(4000 * update) * 1e-3 / update

    def found(speed: Array) -> SpeedMeasurement:
        new = np.arange(time.size) % update == 0
        rows = [np.repeat(x, update) for x in (speed, position)]
        return speed_measurement(time, *rows, new=new, new_position=new)

    assert found(backward) == SpeedMeasurement(update, 0)
    assert found(centred) == SpeedMeasurement(update // 2, update // 2)


def test_a_speed_that_holds_no_noise_is_taken_as_it_is() -> None:
    assert speed_measurement(TIME, 200.0 - 240.0 * np.cos(8.0 * TIME), ANGLE) is INSTANTANEOUS
    assert speed_measurement(TIME, 0.0 * SPEED, 0.0 * ANGLE) is INSTANTANEOUS


def test_what_differences_add_up_to_is_the_position() -> None:
    for way in (BACKWARD, FORWARD):
        assert np.allclose(integral(way, TIME, difference(way, TIME, ANGLE)), ANGLE - ANGLE[0], atol=1e-9)
    assert integral(CENTRAL, TIME, NONE).size == 0


@pytest.mark.parametrize("way", DIFFERENCES)
def test_the_core_takes_the_same_difference(way: SpeedMeasurement) -> None:
    problem = prepare([_recorded(1, way, counts=500, friction=0.0)], _model())
    problem = replace(problem, runs=tuple(replace(r, speed_measured=way) for r in problem.whole))
    this = hypothesis(problem.prior, (), problem.scales)
    (left,) = problem.residuals(this.vector, this.active)
    by_hand = sum(float(np.sum((left[s] / problem.noise[s].level) ** 2)) for s in left)
    assert problem.error(this.vector, this.active) == pytest.approx(by_hand, rel=1e-9)
    (out,) = (problem.simulate(r, this.vector, this.active) for r in problem.runs)
    assert np.allclose(out.signals["speed"], difference(way, problem.whole[0].time, out.signals["position"]))


@pytest.mark.slow
@pytest.mark.parametrize("counts", [500, 8000])
def test_a_drive_that_takes_backward_differences_lacks_nothing(counts: int) -> None:
    runs = [_recorded(seed, BACKWARD, counts=counts, friction=0.0) for seed in (1, 2)]
    assert rwn.diagnose(runs, _model()).verdict == "adequate"


@pytest.mark.slow
def test_friction_is_right_beneath_backward_differences() -> None:
    runs = [_recorded(seed, BACKWARD, counts=8000, friction=0.01) for seed in (1, 2)]
    runs = [replace(r, signals={s: r.signals[s] for s in ("voltage", "speed")}) for r in runs]
    found = rwn.diagnose(runs, _model(), effort=0.3)
    assert [e.name for e in found.effects] == ["coulomb-friction"]
    assert found.effects[0].parameters["coulomb_torque"].value == pytest.approx(0.01, rel=0.01)


def _model() -> rwn.Model:
    sure = {"resistance": 0.07, "torque_constant": 0.04, "back_emf_constant": 0.04, "inertia": 0.08}
    return rwn.Model(kind="dc", parameters=MOTOR, uncertainty={**sure, "viscous_friction": 0.3})


def _recorded(seed: int, way: SpeedMeasurement, *, counts: int, friction: float) -> rwn.Recording:
    rng, t = np.random.default_rng(seed), 1e-3 * np.arange(2000)
    voltage = shaking(rng, t)
    rows = plant(voltage, lambda w, _: -friction * np.tanh(w / 0.05), parts=8)
    signals = {
        "voltage": voltage,
        "current": rows[:, 0] + rng.normal(0, 0.02, t.size),
        "speed": difference(way, t, counted(rows[:, 2], counts)),
    }
    return rwn.Recording(name=f"run_{seed}.csv", time=t, signals=signals)


def _held(values: Array, rows: int) -> tuple[Array, NDArray[np.bool_]]:
    """Values (n,) updated every so many rows, and where they are new."""
    return np.repeat(values[::rows], rows)[: values.size], np.arange(values.size) % rows == 0


@pytest.mark.parametrize("update", [1, 4])
def test_a_difference_over_many_rows_is_told_by_the_position_beside_it(update: int) -> None:
    angle = counted(ANGLE + 20.0 * np.sin(2.0 * np.pi * 3.0 * TIME), 4096)
    speed, new = _held(difference(SpeedMeasurement(20, 0), TIME, angle), update)
    position, _ = _held(angle, update)
    assert speed_measurement(TIME, speed, position, new=new, new_position=new) == SpeedMeasurement(20, 0)


def _first_order(speed: Array) -> Array:
    return np.asarray(lfilter([0.1], [1.0, -0.9], speed), dtype=np.float64)


@pytest.mark.parametrize("of", [_first_order, lambda w: np.roll(w, 10), lambda w: w], ids=["filter", "delay", "none"])
def test_a_lag_or_a_delay_of_the_speed_is_no_difference_over_many_rows(of: Callable[[Array], Array]) -> None:
    angle = ANGLE + 20.0 * np.sin(2.0 * np.pi * 3.0 * TIME)
    speed = of(np.gradient(angle, 1e-3) + 0.05 * np.random.default_rng(4).standard_normal(TIME.size))
    assert window_of(TIME, speed, counted(angle, 4096), np.full(TIME.size, True)) == 0


@pytest.mark.parametrize("least", [1e-25, 5e-324])
def test_a_speed_next_to_zero_is_no_count(least: float) -> None:
    """As of a simulated shaft at rest: a turn would have more counts than there are whole numbers."""
    rng = np.random.default_rng(0)
    time = np.cumsum(1e-3 * (1.0 + 0.1 * rng.uniform(-1.0, 1.0, 400)))
    speed = np.append(np.full(100, least), rng.uniform(-5.0, 5.0, 300))
    assert speed_measurement(time, speed, np.empty(0)) == INSTANTANEOUS


def test_a_shaft_that_turns_slowly_does_not_say_where_the_middle_is_by_most_rows() -> None:
    """It stands, or turns by as many counts after a row as before it, in most of them: both differences fit there."""
    fine = np.arange(8000) * 0.5e-3
    angle = counted(5.0 * fine + 0.4 * np.sin(2.0 * fine), 512)
    centred = difference(CENTRAL, fine, angle)[::2]
    assert speed_measurement(TIME, centred, angle[::2]) is INSTANTANEOUS
    assert speed_measurement(TIME, difference(CENTRAL, TIME, angle[::2]), angle[::2]) is CENTRAL


@pytest.mark.parametrize("way", [CENTRAL, BACKWARD])
def test_rows_that_are_lost_do_not_hide_how_a_speed_was_measured(way: SpeedMeasurement) -> None:
    position = counted(20.0 * TIME + 2.0 * np.sin(5.0 * TIME), 2048)
    kept = np.random.default_rng(1).random(TIME.size) > 0.3
    assert speed_measurement(TIME[kept], difference(way, TIME, position)[kept], position[kept]) is way
