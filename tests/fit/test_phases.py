"""Phases are reported within one turn, whatever turn a fit ended in."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.fit.fit import Fit, fit
from rwn.fit.fitted_model import fitted_model, with_uncertainty
from rwn.fit.hypothesis import hypothesis
from rwn.fit.intervals import estimates
from rwn.fit.preparation import prepare
from rwn.fit.residuals import Statistics, statistics
from rwn.fit.unknown import Unknown
from rwn.model.model import Model

COGGING = {"amplitude": 4e-3, "periods_per_rev": 7.0, "phase": 1.6}
PHASE = "cogging-torque.phase"
TIME = 1e-3 * np.arange(2000)
INPUT = rwn.Recording(name="run", time=TIME, signals={"voltage": 3.0 * np.sin(2 * np.pi * TIME)})
TRUTH = Model(
    kind="dc", parameters=MOTOR, effects={"cogging-torque": COGGING}, uncertainty={"resistance": 0.05, PHASE: math.inf}
)


def _sheet(turns: int) -> Model:
    """The motor with its cogging as somebody may write it, whose phase nobody knows."""
    return replace(TRUTH, effects={"cogging-torque": {**COGGING, "phase": 1.5 + turns * math.tau}})


@pytest.fixture(scope="module", params=[-5, 5])
def turned(request: pytest.FixtureRequest) -> tuple[Fit, Statistics, Model]:
    seen = rwn.simulate(TRUTH, INPUT).signals
    rng = np.random.default_rng(1)
    noisy = {s: seen[s] + 0.01 * np.std(seen[s]) * rng.standard_normal(TIME.size) for s in ("current", "speed")}
    sheet = _sheet(request.param)
    problem = prepare([replace(INPUT, signals={"voltage": INPUT.signals["voltage"], **noisy})], sheet)
    this = fit(problem, hypothesis(problem.prior, (), problem.scales))
    assert abs(this.value(PHASE)) > math.tau  # the search goes on in the turn that it began in
    return this, statistics(problem, this), sheet


def test_a_phase_and_its_interval_are_reported_within_one_turn(turned: tuple[Fit, Statistics, Model]) -> None:
    found = estimates(*turned[:2])[PHASE]
    assert found.value == pytest.approx(COGGING["phase"], abs=0.05)
    low, high = found.interval or (0.0, 0.0)
    assert low < found.value < high < low + 0.3


def test_the_corrected_model_has_that_phase_and_moves_as_the_fit_does(turned: tuple[Fit, Statistics, Model]) -> None:
    this, left, sheet = turned
    corrected = fitted_model(this, sheet)
    phase = corrected.effects["cogging-torque"]["phase"]
    found = estimates(this, left)
    assert phase == found[PHASE].value <= math.pi
    undeclared = replace(corrected, uncertainty={})
    assert 0.0 < with_uncertainty(undeclared, found).uncertainty[PHASE] < 0.1
    as_fitted = replace(corrected, effects={"cogging-torque": this.values_of("cogging-torque")})
    one, other = (rwn.simulate(model, INPUT).signals["speed"] for model in (corrected, as_fitted))
    assert np.allclose(one, other, rtol=0.0, atol=1e-9 * np.ptp(other))  # 33 rad is known to 1e-14 of a turn


def test_an_unknown_phase_may_be_anywhere_in_one_turn(turned: tuple[Fit, Statistics, Model]) -> None:
    this, left, _ = turned
    low, high = estimates(this, replace(left, variance=1e12))[PHASE].interval or (0.0, 0.0)
    assert high - low == pytest.approx(math.tau)


def test_a_declared_phase_stays_beside_what_was_declared() -> None:
    """The refit is compared with it: 7.1 rad is a small move from 7 rad, 0.8 rad looks like none."""
    declared = Unknown(
        name=PHASE, unit="rad", index=0, lower=-np.inf, upper=np.inf, cyclic=True, prior=7.0, prior_std=0.1
    )
    assert declared.within_a_turn(7.1) == 7.1
    assert declared.within_a_turn(7.1 - math.tau) == pytest.approx(7.1)
    assert replace(declared, prior_std=np.inf).within_a_turn(7.1) == pytest.approx(7.1 - math.tau)
    assert replace(declared, cyclic=False).within_a_turn(33.0) == 33.0
