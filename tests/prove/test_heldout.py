"""Rows of the proof."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, recorded
from rwn.fit.preparation import prepare
from rwn.prove.heldout import (
    HeldoutRow,
    _gain,
    disagreeing,
    gain_interval,
    heldout_error,
    heldout_rows,
    helps,
    hurts,
    log_change,
)
from rwn.recording.signals import DRIVING_FORCE
from rwn.simulate.recorded_run import judging_run

MODEL = rwn.Model(kind="dc", parameters=MOTOR)


@pytest.mark.parametrize(
    ("before", "after", "gain"), [(2.0, 1.0, 0.5), (0.0, 0.0, 0.0), (0.0, 1.0, None), (np.inf, 1.0, None)]
)
def test_of_no_error_nothing_can_be_removed(before: float, after: float, gain: float | None) -> None:
    assert _gain(before, after) == gain


def test_a_model_that_is_exact_has_rows_of_zeros() -> None:
    run = recorded(3, lambda *_: 0.0)
    own = rwn.simulate(MODEL, run).signals
    exact = rwn.Recording(name="own", time=run.time, signals={"voltage": run.signals["voltage"], "speed": own["speed"]})
    problem = prepare([exact], MODEL)
    given = problem.as_given()
    rows = heldout_rows(problem, [judging_run(exact, MODEL)], given, given, given, units={"speed": "rad/s"}, seed=0)
    assert rows
    assert all(row.corrected == 0.0 and row.gain == 0.0 for row in rows)


def test_what_was_not_measured_does_not_count_as_no_error() -> None:
    run = recorded(3, lambda *_: 0.0)
    off = rwn.Recording(
        name="off",
        time=run.time,
        signals={"voltage": run.signals["voltage"], "speed": rwn.simulate(MODEL, run).signals["speed"] + 5.0},
    )
    held = np.arange(run.time.size) % 4 > 0
    problem = prepare([off], MODEL)
    given = problem.as_given()
    for missing, samples in (({}, run.time.size), ({"speed": held}, int((~held).sum()))):
        there = judging_run(replace(off, missing=missing), MODEL)
        there = replace(there, start=problem.runs[0].start)
        row = heldout_rows(problem, [there], given, given, None, units={"speed": "rad/s"}, seed=0)[0]
        assert row.samples == samples
        assert row.nominal == pytest.approx(5.0, rel=0.2)


def test_the_interval_of_a_gain_covers_it() -> None:
    noise = np.random.default_rng(1).standard_normal((2, 5000))
    low, high = gain_interval(2.0 * noise[0], noise[1], seed=0) or (np.nan, np.nan)
    assert low < 0.5 < high
    assert high - low < 0.1


def test_an_error_that_ran_away_has_no_gain() -> None:
    noise = np.random.default_rng(1).standard_normal(500)
    away = 1e101 * noise
    for before, after in ((noise, away), (away, noise), (away, away)):
        assert gain_interval(before, after, seed=0) is None


def test_of_no_error_the_interval_is_that_of_the_gain() -> None:
    none, some = np.zeros(500), np.ones(500)
    assert gain_interval(none, none, seed=0) == (0.0, 0.0)
    assert gain_interval(none, some, seed=0) is None


@pytest.mark.parametrize(
    ("refitted", "corrected", "better", "worse"),
    [
        (np.inf, 1.0, True, False),
        (1.0, np.inf, False, True),
        (np.inf, np.inf, False, False),
        (0.0, 1.0, False, True),
        (0.0, 0.0, False, False),
        (1.0, None, False, False),
    ],
)
def test_what_ran_away_is_certainly_worse(
    refitted: float, corrected: float | None, better: bool, worse: bool
) -> None:
    low, high = replace(BETTER, refitted=refitted, corrected=corrected, gain=None, gain_interval=None).certain_gain
    assert (low > 0.0, high < 0.0) == (better, worse)


def test_a_correction_that_keeps_a_signal_from_running_away_helps() -> None:
    tamed = replace(BETTER, refitted=np.inf, gain=None, gain_interval=None)
    assert helps([tamed])
    assert not hurts([tamed])


@pytest.mark.parametrize(("corrected", "worth"), [(0.97, False), (0.94, True)])
def test_what_stands_in_for_a_law_has_to_help_materially(corrected: float, worth: bool) -> None:
    sure = replace(BETTER, refitted=1.0, corrected=corrected, gain=1.0 - corrected, gain_interval=(0.02, 0.08))
    assert helps([sure]) is worth


def test_what_is_certainly_worse_at_low_speed_does_not_help() -> None:
    better = replace(BETTER, refitted=1.0, corrected=0.5, gain=0.5, gain_interval=(0.4, 0.6))
    slow = replace(better, region="low speed", corrected=1.5, gain=-0.5, gain_interval=(-0.8, -0.2))
    assert helps([better, replace(slow, gain_interval=(-0.8, 0.1))])
    assert not helps([better, slow])


@pytest.mark.parametrize(("samples", "judged"), [(900, False), (1100, True)])
def test_the_driving_force_is_judged_where_the_filters_leave_samples(samples: int, judged: bool) -> None:
    """Inverse dynamics filter the position at either end; a short recording has its free run alone."""
    axis = rwn.Model(kind="axis", linear=True, parameters={"inertia": 95.0, "viscous_friction": 200.0})
    time = 1e-3 * np.arange(samples)
    given = rwn.Recording(name="run", time=time, linear=True, signals={"force": 50.0 * np.sin(20.0 * time)})
    position = rwn.simulate(axis, given).signals["position"]
    run = replace(given, signals={**given.signals, "position": position})
    problem = prepare([run], axis)
    nominal = problem.as_given()
    rows = heldout_rows(problem, [judging_run(run, axis)], nominal, nominal, None, units={"position": "m"}, seed=0)
    assert any(row.unit == "%" for row in rows) == judged


def row(
    signal: str, before: float, after: float, interval: tuple[float, float] | None, region: str = "all"
) -> HeldoutRow:
    return HeldoutRow(
        recording="run", region=region, signal=signal, unit="%" if signal == DRIVING_FORCE else "rad/s", samples=100,
        nominal=before, refitted=before, corrected=after, noise_floor=None, gain=_gain(before, after),
        gain_interval=interval,
    )  # fmt: skip


BETTER, WORSE = row("speed", 2.0, 1.0, (0.4, 0.6)), row("speed", 1.0, 3.0, (-2.5, -1.5))
PERHAPS, AWAY = row("position", 1.0, 1.1, (-0.3, 0.1)), row("speed", 1.0, np.inf, None)
LITTLE = row("current", 1.0, 1.02, (-0.03, -0.01))


@pytest.mark.parametrize(
    ("rows", "expected"),
    [
        ([], False),
        ([BETTER], False),
        ([WORSE], True),
        ([PERHAPS], False),
        ([replace(PERHAPS, gain_interval=(-0.27, 0.07))], True),  # by 1.15 standard errors
        ([WORSE, PERHAPS], True),
        ([BETTER, LITTLE], False),  # of one signal a little is lost, of another much is gained
        ([BETTER, WORSE], True),  # more than is gained
        ([BETTER, AWAY], True),
        ([replace(WORSE, region="low speed")], False),
    ],
)
def test_what_hurts_is_worse_somewhere_by_more_than_an_error_and_worse_on_the_mean(
    rows: list[HeldoutRow], expected: bool
) -> None:
    assert hurts(rows) is expected


def test_the_driving_force_is_a_signal_where_the_position_alone_is_recorded() -> None:
    force, position = row(DRIVING_FORCE, 1.0, 2.0, (-1.2, -0.8)), row("position", 1.0, 0.5, (0.4, 0.6))
    assert heldout_error([position, force]) == pytest.approx(0.5 * (0.25 + 4.0))
    assert heldout_error([position, force, BETTER]) == pytest.approx(0.25)


def test_a_driving_force_is_no_judge_where_the_speed_was_recorded() -> None:
    """A friction with a memory asks for a force many times the one that acted, along the noise of a speed."""
    force = row(DRIVING_FORCE, 50.0, 400.0, (-8.0, -6.0))
    assert not hurts([BETTER, force])
    assert log_change([BETTER, force]) == log_change([BETTER])
    assert hurts([PERHAPS, force]), "a position alone drifts"


def test_recordings_disagree_where_one_is_certainly_better_and_another_certainly_worse() -> None:
    better, worse = replace(BETTER, recording="a"), replace(WORSE, recording="b")
    assert disagreeing([better, worse]) == (("a",), ("b",))
    assert disagreeing([better, worse, replace(PERHAPS, recording="b")]) == (("a",), ("b",))
    assert disagreeing([better, replace(worse, recording="a"), worse]) == ((), ()), "the first says both"
    assert disagreeing([better, replace(PERHAPS, recording="b")]) == ((), ())
    assert disagreeing([worse]) == disagreeing([better]) == disagreeing([]) == ((), ())
