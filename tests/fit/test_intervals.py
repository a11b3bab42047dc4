"""Intervals of fitted values, and how they go by the samples that the recordings count for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.intervals import AGREEMENT, Estimate, deviations, estimates
from rwn.fit.preparation import prepare
from rwn.fit.residuals import Statistics, statistics
from rwn.model.model import Model

KNOWN_TO = {"resistance": 0.05, "inertia": 0.1}


@pytest.fixture(scope="module")
def rubbing() -> tuple[Fit, Statistics]:
    time = 1e-3 * np.arange(2000)
    voltage = 6.0 * np.sign(np.sin(2 * np.pi * 2.0 * time))
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    truth = Model(kind="dc", parameters=MOTOR, effects={"coulomb-friction": {"coulomb_torque": 0.01}})
    seen = rwn.simulate(truth, run).signals
    rng = np.random.default_rng(1)
    noisy = {s: seen[s] + 0.01 * np.std(seen[s]) * rng.standard_normal(time.size) for s in ("current", "speed")}
    recorded = replace(run, signals={"voltage": voltage, **noisy})
    problem = prepare([recorded], Model(kind="dc", parameters=MOTOR, uncertainty=KNOWN_TO))
    this = fit(problem, hypothesis(problem.prior, ("coulomb-friction",), problem.scales))
    return this, statistics(problem, this)


def _width(of: Estimate) -> float:
    assert of.interval is not None
    return (of.interval[1] - of.interval[0]) / of.value


def test_few_samples_widen_what_nobody_declared_and_leave_the_data_sheet(rubbing: tuple[Fit, Statistics]) -> None:
    this, left = rubbing
    doubted = estimates(this, left, samples=left.effective / 2000.0**2)
    assert _width(doubted["coulomb-friction.coulomb_torque"]) > 1.0
    for name, std in KNOWN_TO.items():
        low, high = doubted[name].interval or (0.0, 0.0)
        assert np.log(high / low) == pytest.approx(2.0 * 1.96 * std, rel=0.02)


def test_all_samples_that_noise_is_worth_count_where_nothing_is_said(rubbing: tuple[Fit, Statistics]) -> None:
    this, left = rubbing
    assert estimates(this, left) == estimates(this, left, samples=left.effective)


def test_a_quarter_of_the_samples_doubles_what_they_alone_tell(rubbing: tuple[Fit, Statistics]) -> None:
    """Where nothing was declared, and beside what no noise shows."""
    this, left = rubbing
    alone = replace(this, minimum=replace(this.minimum, information=this.minimum.data_information))
    name = "coulomb-friction.coulomb_torque"
    k = [u.name for u in this.hypothesis.unknowns].index(name)
    once = float(deviations(alone, left)[k] / this.minimum.values[k])
    expected = 2.0 * 1.96 * np.hypot(2.0 * once, AGREEMENT)
    fewer = estimates(alone, left, samples=left.effective / 4.0)
    assert _width(fewer[name]) == pytest.approx(expected, rel=1e-6)
