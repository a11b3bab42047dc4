"""Rows of the proof."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, recorded
from rwn.fit.preparation import prepare
from rwn.prove.heldout import _gain, gain_interval, heldout_rows
from rwn.prove.proof import hurts
from rwn.simulate.run import judging_run

MODEL = rwn.Model(kind="dc", parameters=MOTOR)


@pytest.mark.parametrize(("before", "after", "gain"), [(2.0, 1.0, 0.5), (0.0, 0.0, 0.0), (0.0, 1.0, -np.inf)])
def test_of_no_error_nothing_can_be_removed(before: float, after: float, gain: float) -> None:
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
    low, high = gain_interval(2.0 * noise[0], noise[1], seed=0)
    assert low < 0.5 < high
    assert high - low < 0.1


def test_an_error_that_ran_away_has_no_gain_to_hope_for() -> None:
    noise = np.random.default_rng(1).standard_normal(500)
    for before, after in ((noise, 1e200 * noise), (1e200 * noise, noise)):
        assert gain_interval(before, after, seed=0) == (-np.inf, -np.inf)


def test_a_correction_hurts_where_it_runs_away_or_is_certainly_worse_everywhere() -> None:
    run = recorded(3, lambda *_: 0.0)
    problem = prepare([run], MODEL)
    given = problem.as_given()
    units = {"speed": "rad/s", "current": "A"}
    (row, *_) = heldout_rows(problem, [judging_run(run, MODEL)], given, given, given, units=units, seed=0)
    worse, better = replace(row, gain_interval=(-0.2, -0.1)), replace(row, gain_interval=(0.1, 0.2))
    assert not hurts(())
    assert not hurts((row,))
    assert hurts((worse,))
    assert not hurts((worse, better))
    assert hurts((replace(better, corrected=np.inf), better))


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
