"""Where the torque sits that the nominal model does not know."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rwn.mismatch_map.regions import Region, regions
from rwn.simulate.unknown_inputs import UnknownInputs

TIME = np.linspace(0.0, 10.0, 4000)
SPEED = 100.0 * np.sin(2.0 * np.pi * 0.5 * TIME)


def found(torque: np.ndarray, *, linear: bool = False, speed: np.ndarray = SPEED) -> tuple[Region, ...]:
    still = np.zeros(TIME.size)
    unknown = UnknownInputs(
        time=TIME, speed=speed, acceleration=np.gradient(speed, TIME), current=still, angle=still, torque=torque,
        voltage=np.empty(0),
    )  # fmt: skip
    return regions([unknown], linear=linear)


def test_a_torque_at_low_speed_is_found_there() -> None:
    places = {r.name: r for r in found(np.where(np.abs(SPEED) < 20.0, 1.0, 0.0)) if r.coordinate == "speed"}
    low = places["low speed"]
    assert low.share > 0.95
    assert low.high == pytest.approx(20.0, rel=0.5)
    assert low.samples_share < 0.3
    assert places["reversals"].share > places["reversals"].samples_share


def test_a_voltage_is_found_where_that_of_the_winding_is_asked_for() -> None:
    still, high = np.zeros(TIME.size), np.where(np.abs(SPEED) > 80.0, 1.0, 0.0)
    unknown = UnknownInputs(
        time=TIME, speed=SPEED, acceleration=np.gradient(SPEED, TIME), current=still, angle=still,
        torque=1.0 - high, voltage=high,
    )  # fmt: skip
    both = (unknown, replace(unknown, lacking="voltage"))
    by_torque, by_voltage = (next(r for r in regions([u]) if r.coordinate == "speed") for u in both)
    assert by_torque.low < 1.0
    assert by_voltage.low == pytest.approx(80.0, rel=0.1)


def test_a_shaft_at_rest_has_no_speed_that_rounding_made() -> None:
    """A tenth of the samples are at 0 and as many at 1e-14 rad/s, which alone have a torque: both are low speed."""
    at_rest = np.where(TIME < 1.0, 0.0, np.where(TIME < 2.0, 1e-14, SPEED + 100.0))
    torque = np.where((TIME >= 1.0) & (TIME < 2.0), 1.0, 0.0)
    places = [r for r in found(torque, speed=at_rest) if r.coordinate == "speed"]
    assert [r.low for r in places if r.name == "low speed"] == [0.0]


def test_a_torque_of_one_stretch_of_time_comes_first() -> None:
    place = found(np.where((TIME > 2.5) & (TIME < 5.0), 1.0, 0.0))[0]
    assert (place.coordinate, place.unit) == ("time", "s")
    assert place.low == pytest.approx(2.5, abs=0.1)
    assert place.high == pytest.approx(5.0, abs=0.1)
    assert place.share > 0.95


def test_a_torque_of_one_direction_is_found_there() -> None:
    place = next(r for r in found(np.where(SPEED > 0.0, 1.0, 0.0)) if r.coordinate == "direction")
    assert (place.low, place.high) == (0.0, 1.0), "forwards"
    assert place.share > 0.95


def test_a_torque_that_is_everywhere_is_nowhere_more_than_elsewhere() -> None:
    assert all(abs(r.share - r.samples_share) < 0.02 for r in found(np.ones(TIME.size)))


def test_an_axis_has_metres() -> None:
    assert {r.unit for r in found(np.ones(TIME.size), linear=True)} <= {"m/s", "m/s^2", "s", ""}


def test_a_blow_now_and_then_is_at_single_instants() -> None:
    struck = 0.01 * np.random.default_rng(3).standard_normal(SPEED.size)
    struck[::500] += 5.0
    best, *others = found(struck)
    assert best.name == "single instants"
    assert best.share > 0.5
    assert best.samples_share <= 0.01
    assert not any(r.name == "single instants" for r in (*others, *found(0.01 * np.sign(SPEED))))
