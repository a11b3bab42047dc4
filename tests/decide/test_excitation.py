"""Recordings that teach nothing, what they lack, and the run that would show it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from made_up_motor import MOTOR
from rwn.decide.excitation import LEARNED, advice, learns_nothing, missing
from rwn.fit.hypothesis import hypothesis
from rwn.fit.preparation import prepare
from rwn.model.model import Model
from rwn.recording.recording import Recording
from rwn.simulate.run import Run

TIME = 1e-3 * np.arange(2000)
NOISE = 0.01 * np.random.default_rng(0).normal(size=TIME.size)
TURNS = 50.0 * np.sin(8.0 * TIME)


def run(speed: np.ndarray, voltage: np.ndarray | float) -> Run:
    return Run(name="x", time=TIME, input=np.broadcast_to(voltage, TIME.shape).astype(float), speed=speed + NOISE)


@pytest.mark.parametrize(
    ("speed", "voltage", "lacks"),
    [
        (TURNS, TURNS, []),
        (0.0 * TURNS, TURNS, ["no motion"]),
        (np.abs(TURNS), TURNS, ["no change of direction"]),
        (-np.abs(TURNS), TURNS, ["no change of direction"]),
        (50.0 + 0.0 * TURNS, TURNS, ["no change of direction", "one speed only"]),
        (np.sign(TURNS) * 50.0, TURNS, ["one speed only"]),
        (TURNS, 12.0, ["an input that does not change"]),
        (np.where(TURNS < 0, 0.08 * TURNS, TURNS), TURNS, ["no change of direction"]),
        (np.where(TURNS < 0, 0.15 * TURNS, TURNS), TURNS, []),
    ],
)
def test_what_a_recording_does_not_show_is_said(speed: np.ndarray, voltage: np.ndarray, lacks: list[str]) -> None:
    assert missing([run(speed, voltage)]) == lacks
    said = advice([run(speed, voltage)])
    assert said.startswith("Record steps to both directions at several levels")
    assert said.endswith(f"; these recordings show {' and '.join(lacks)}." if lacks else "with pauses at standstill.")


def levels(*speeds: float) -> np.ndarray:
    """Equally long stretches of each speed, in both directions."""
    each = TIME.size // (2 * len(speeds))
    return np.concatenate([np.repeat(x, each) for x in (*speeds, *(-x for x in speeds))])


@pytest.mark.parametrize(("factor", "one_speed"), [(1.2, True), (1.28, True), (1.32, False), (1.5, False)])
def test_speeds_that_differ_by_a_third_are_several(factor: float, one_speed: bool) -> None:
    assert missing([run(levels(50.0, 50.0 * factor), TURNS)]) == (["one speed only"] if one_speed else [])


@pytest.mark.parametrize(("share", "one_speed"), [(0.08, True), (0.12, False)])
def test_a_tenth_of_the_time_at_another_speed_counts(share: float, one_speed: bool) -> None:
    some = np.where(np.arange(TIME.size) % 100 < 100 * share, 20.0, 50.0) * np.sign(TURNS + 1e-9)
    assert missing([run(some, TURNS)]) == (["one speed only"] if one_speed else [])


@pytest.mark.parametrize(("change", "lacks"), [(0.9e-3, ["an input that does not change"]), (1.1e-3, [])])
def test_an_input_changes_from_a_thousandth_of_it(change: float, lacks: list[str]) -> None:
    voltage = -12.0 + 12.0 * change * (np.arange(TIME.size) % 2)
    assert missing([run(TURNS, voltage)]) == lacks
    assert missing([run(TURNS, 0.0)]) == ["an input that does not change"]
    assert missing([run(TURNS, 1e-6 * TURNS)]) == []


@pytest.mark.parametrize(("level", "lacks"), [(2.0, ["no motion"]), (3.1, [])])
def test_motion_stands_out_of_the_noise(level: float, lacks: list[str]) -> None:
    """Steps of a few rad/s under noise of 1; what smoothing leaves of it adds half as much to their peak."""
    noise = np.random.default_rng(0).standard_normal(TIME.size)
    steps = levels(0.3 * level, level)
    noisy = Run(name="x", time=TIME, input=TURNS, speed=steps + noise)
    assert missing([noisy]) == lacks


def test_one_recording_makes_up_for_what_another_lacks() -> None:
    forwards, backwards = run(np.abs(TURNS), TURNS), run(-np.abs(TURNS), 12.0)
    assert missing([forwards, backwards]) == []


def test_no_recording_shows_no_motion() -> None:
    assert missing([]) == ["no motion"]


def test_nothing_is_learned_where_no_value_is_better_known_than_before() -> None:
    """The deviation after a fit against the declared one: 10 % of the inertia, 30 % of the friction."""
    model = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "viscous_friction": 0.3})
    signals = {"voltage": 0.1 * TURNS, "speed": TURNS + NOISE}
    problem = prepare([Recording(name="x", time=TIME, signals=signals)], model)
    nominal = hypothesis(problem.prior, (), problem.scales)
    declared = np.array([u.prior_std * (abs(v) if u.logarithmic else abs(u.prior))
                         for u, v in zip(nominal.unknowns, nominal.start, strict=True)])  # fmt: skip
    known = [k for k, u in enumerate(nominal.unknowns) if np.isfinite(u.prior_std) and u.prior_std > 0.0 and u.prior]
    assert len(known) == 2
    assert learns_nothing(nominal, 1.05 * LEARNED * declared, nominal.start)
    for k in known:
        better = np.where(np.arange(declared.size) == k, 0.95 * LEARNED, 1.0) * declared
        assert not learns_nothing(nominal, better, nominal.start), "one is enough"
    certain = replace(nominal, unknowns=tuple(replace(u, prior_std=np.inf) for u in nominal.unknowns))
    assert not learns_nothing(certain, declared, nominal.start), "where nothing was declared, whatever is found is new"
