"""Fits under errors that last: normal equations against NumPy, and transfer functions that come closer to the truth."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

import rwn
from ranked import ranked_from
from rwn.fit.coloured_noise import under_coloured_noise
from rwn.fit.fit import Fit, fit_nominal, refit
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics
from rwn.name.ranking import Ranking
from rwn.simulate.windows import windowed

Array = NDArray[np.float64]
STEP, NOISE, SHARE = 0.02, 0.05, 0.95
TRUTH = {"b0": 1500.0, "b1": -20.0, "a0": 1250.0, "a1": 70.0}  # a belt
BARE = rwn.Model(kind="lti", parameters=TRUTH, order=2)
UNKNOWN = rwn.Model(kind="lti", parameters={}, order=2)


def lasting(rng: np.random.Generator, samples: int, share: float = SHARE) -> Array:
    """Errors of which each keeps `share` of the one before."""
    errors = NOISE * rng.standard_normal(samples)
    for k in range(1, samples):
        errors[k] += share * errors[k - 1]
    return errors


def made(seed: int, *, share: float = SHARE, samples: int = 500, rectified: bool = False) -> rwn.Recording:
    rng = np.random.default_rng(seed)
    time = STEP * np.arange(samples)
    voltage = np.repeat(rng.uniform(-2.0, 2.0, samples // 20 + 1), 20)[:samples]
    bare = rwn.Recording(name="bare", time=time, signals={"voltage": voltage, "speed": np.zeros(samples)})
    speed = rwn.simulate(BARE, bare).signals["speed"]
    speed = np.abs(speed) if rectified else speed
    return rwn.Recording(
        name=f"made {seed}", time=time, signals={"voltage": voltage, "speed": speed + lasting(rng, samples, share)}
    )


def plain_fit(recording: rwn.Recording) -> tuple[Problem, Fit]:
    problem = prepare([recording], UNKNOWN)
    return problem, fit_nominal(problem)


def ranked(recording: rwn.Recording) -> Ranking:
    return ranked_from([recording], UNKNOWN, ["sensor-rectification"], at_once=1)


def by_hand(problem: Problem, this: Fit, share: float, every: int = 0) -> tuple[float, Array, Array]:
    """Squared error, gradient and curvature of what is new in each error; first samples by themselves."""
    (run,), active, by = problem.runs, this.active, this.hypothesis.by
    out = problem.simulate(run, this.vector, active, by)
    errors, slopes = run.speed - out.signals["speed"], out.slopes["speed"]
    rows, columns, last = [], [], -1
    for k in range(errors.size):
        if every and k % every == 0:
            last = -1
        if np.isnan(errors[k]):
            continue
        if last < 0:
            alone = np.sqrt(1.0 - share**2)
            rows.append(alone * errors[k])
            columns.append(alone * slopes[k])
        else:
            rows.append(errors[k] - share * errors[last])
            columns.append(slopes[k] - share * slopes[last])
        last = k
    r, j = (np.array(x) / problem.noise["speed"].level for x in (rows, columns))
    return float(r @ r), j.T @ r, j.T @ j


def with_share(problem: Problem, share: float) -> Problem:
    return replace(problem, noise={"speed": replace(problem.noise["speed"], reflection=(share,))})


MOTOR = rwn.Model(
    kind="dc",
    parameters={
        "resistance": 1.0, "inductance": 5e-4, "torque_constant": 0.05, "back_emf_constant": 0.05,
        "inertia": 2e-5, "viscous_friction": 1e-5, "coulomb_friction": 0.0,
    },
    uncertainty={"resistance": 0.1, "inertia": 0.1},
)  # fmt: skip


def motor_in_windows() -> tuple[Problem, Fit]:
    """A motor whose motion restarts from the recorded one, with some samples that were lost."""
    rng = np.random.default_rng(4)
    time = 1e-3 * np.arange(600)
    bare = rwn.Recording(name="bare", time=time, signals={"voltage": 5.0 * np.sin(9.0 * time), "speed": 0.0 * time})
    seen = rwn.simulate(MOTOR, bare).signals["speed"] + lasting(rng, time.size)
    problem = prepare([rwn.Recording(name="seen", time=time, signals={**bare.signals, "speed": seen})], MOTOR)
    this = fit_nominal(problem)
    run = windowed(problem.runs[0], length=60)
    gaps = seen.copy()
    gaps[100:103] = np.nan
    return replace(problem, runs=(replace(run, speed=gaps),)), this


def expect_what_is_new(problem: Problem, this: Fit, every: int = 0) -> None:
    chi2, gradient, curvature = by_hand(problem, this, 0.8, every)
    weighted = with_share(problem, 0.8)
    normal = weighted.normal(this.vector, this.active, this.hypothesis.by)
    assert normal.chi2 == pytest.approx(chi2, rel=1e-9)
    np.testing.assert_allclose(normal.gradient, gradient, rtol=1e-7, atol=1e-9 * np.abs(gradient).max())
    np.testing.assert_allclose(normal.curvature, curvature, rtol=1e-9, atol=1e-12 * np.abs(curvature).max())


def test_normal_equations_count_what_is_new_in_each_error() -> None:
    problem, this = plain_fit(made(1))
    expect_what_is_new(problem, this)


def test_windows_begin_anew_and_gaps_are_passed_over() -> None:
    expect_what_is_new(*motor_in_windows(), every=60)


@pytest.mark.parametrize("share", [-1.0, 1.0, float("nan")])
def test_a_share_is_a_correlation(share: float) -> None:
    problem, this = plain_fit(made(1))
    weighted = with_share(problem, share)
    with pytest.raises(ValueError, match="a reflection coefficient is a correlation: below 1 in size"):
        weighted.normal(this.vector, [], this.hypothesis.by)


def test_share_and_level_are_those_of_the_errors() -> None:
    problem, this = plain_fit(made(2, samples=4000))
    weighted = under_coloured_noise(problem, this)
    assert weighted.noise["speed"].reflection == pytest.approx((SHARE,), abs=0.02)
    assert weighted.noise["speed"].level == pytest.approx(NOISE, rel=0.05)
    assert weighted.noise["speed"].deviation == pytest.approx(NOISE / np.sqrt(1.0 - SHARE**2), rel=0.2)
    left = statistics(weighted, this)
    assert left.variance == pytest.approx(1.0, abs=0.01)
    assert left.correlation_time < 1.3


def test_independent_errors_have_none() -> None:
    problem, this = plain_fit(made(2, samples=4000, share=0.0))
    weighted = under_coloured_noise(problem, this)
    assert weighted.noise["speed"].reflection[0] < 0.05
    again = refit(this, weighted)
    np.testing.assert_allclose(again.minimum.values, this.minimum.values, rtol=5e-3)


@pytest.mark.slow
def test_free_runs_come_closer_to_the_truth() -> None:
    """Over 12 recordings, on an input that none of them had; plain least squares follows what drifts."""
    squares = []
    for seed in range(20, 32):
        problem, plain = plain_fit(made(seed))
        weighted = under_coloured_noise(problem, plain)
        fits = (plain, refit(plain, weighted))
        (other,) = prepare([made(99)], UNKNOWN).whole
        true = rwn.simulate(BARE, made(99)).signals["speed"]
        speeds = [problem.simulate(other, f.vector, ()).signals["speed"] for f in fits]
        squares.append([np.mean((speed - true) ** 2) for speed in speeds])
    plainly, counted = np.sqrt(np.mean(squares, axis=0))
    assert counted < 0.75 * plainly


def test_what_is_named_is_fitted_so_and_what_is_lacking_is_not() -> None:
    ranking = ranked(made(3, rectified=True))
    named, nothing = ranking.fits[0], ranking.nothing_missing
    assert named.added == ("sensor-rectification",)
    assert ranking.weighted.noise["speed"].reflection[0] > 0.8
    assert named.final is not named.fit
    assert nothing.final is nothing.fit
    assert ranking.counted.correlation_time < 0.2 * ranking.left.correlation_time


def test_where_nothing_but_noise_is_left_nothing_changes() -> None:
    ranking = ranked(made(3, rectified=True, share=0.0))
    assert ranking.weighted is ranking.problem
    assert all(r.final is r.fit for r in ranking.fits)
    assert ranking.counted is ranking.left


@pytest.mark.slow
def test_a_diagnosis_says_so() -> None:
    found = rwn.diagnose([made(3, rectified=True)], UNKNOWN, heldout=[made(4, rectified=True)])
    assert [e.name for e in found.effects] == ["sensor-rectification"]
    assert any("lasts (its correlation from sample to sample is 0.9" in text for text in found.warnings)
