"""Intervals of fitted values, and what a doubt does to them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.intervals import AGREEMENT, Estimate, Widening, deviations, estimates
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


def test_a_doubt_widens_what_nobody_declared_and_no_interval_beyond_the_data_sheet(
    rubbing: tuple[Fit, Statistics],
) -> None:
    this, left = rubbing
    sure = estimates(this, left)
    doubted = estimates(this, left, widening=Widening(birge=2000.0))
    assert _width(doubted["coulomb-friction.coulomb_torque"]) > 1.0
    for name, std in KNOWN_TO.items():
        declared = MOTOR[name] * np.exp(np.array([-1.96, 1.96]) * std)
        (low, high), (least, most) = sure[name].interval or (0.0, 0.0), doubted[name].interval or (0.0, 0.0)
        assert least == pytest.approx(min(declared[0], low))
        assert most == pytest.approx(max(declared[1], high))


def test_what_is_not_explained_moves_a_value_in_proportion_to_its_noise(rubbing: tuple[Fit, Statistics]) -> None:
    """Half of the square is no noise: 1 + 6^2 / 2 times the variance of each value, and none where all is noise."""
    this, left = rubbing
    name, wide = "coulomb-friction.coulomb_torque", Widening(misfit_factor=6.0)
    halved = replace(left, variance=2.0, structured=("speed",))
    k = [u.name for u in this.hypothesis.unknowns].index(name)
    noise = float(deviations(this, halved)[k] / this.minimum.values[k])
    expected = 2.0 * 1.96 * np.hypot(np.sqrt(19.0) * noise, AGREEMENT)
    assert _width(estimates(this, halved, widening=wide)[name]) == pytest.approx(expected, rel=1e-6)
    quiet = replace(left, structured=())
    assert estimates(this, quiet, widening=wide) == estimates(this, quiet)
