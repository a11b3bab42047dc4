"""Filters of the sensors, seen in the noise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import lfilter

import rwn
from rwn.fit.fit import fit, fit_nominal
from rwn.fit.hypothesis import hypothesis
from rwn.fit.noise import with_noise_of
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.sensor_filter import filtered, refitted_beside, sensor_filters
from rwn.model.model import Model

Array = NDArray[np.float64]

MOTOR = {"resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 2e-5,
         "viscous_friction": 2e-5}  # fmt: skip
MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "viscous_friction": 0.1})


def _problem(share: float, samples: int = 4000) -> tuple[Problem, list[dict[str, Array]]]:
    """A run whose speed, with its noise, went through a filter; the residual of the model without it is noise alone."""
    rng, time = np.random.default_rng(7), 1e-3 * np.arange(samples)
    voltage = np.repeat(3.0 * rng.uniform(-1.0, 1.0, samples // 50), 50)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(MODEL, run).signals["speed"]
    noise = lfilter([1.0 - share], [1.0, -share], 0.2 * rng.standard_normal(samples))
    recorded = replace(run, signals={"voltage": voltage, "speed": lfilter([1.0 - share], [1.0, -share], speed) + noise})
    return prepare([recorded], MODEL), [{"speed": noise}]


@pytest.mark.parametrize("share", [0.4, 0.6])
def test_a_filter_is_seen_in_the_noise_that_went_through_it(share: float) -> None:
    problem, noise = _problem(share)
    (found,) = sensor_filters(problem, noise)
    assert found.signal == "speed"
    assert found.share == pytest.approx(share, abs=0.12)
    assert found.time_constant == pytest.approx(-1e-3 / np.log(share), rel=0.35)


def test_white_noise_shows_no_filter_and_neither_does_a_model_that_is_wrong() -> None:
    problem, noise = _problem(0.0)
    assert sensor_filters(problem, noise) == ()
    wrong = noise[0]["speed"] + 3.0 * np.sin(0.05 * np.arange(4000))
    assert sensor_filters(problem, [{"speed": wrong}]) == ()


def test_a_filter_is_fitted_with_whatever_else_and_is_no_missing_physics() -> None:
    problem, noise = _problem(0.6)
    plain = fit_nominal(problem)
    nuisance = filtered(problem, sensor_filters(problem, noise))
    fitted = fit_nominal(with_noise_of(nuisance, fit_nominal(nuisance)))
    assert fitted.added == ()
    assert "speed-sensor-lag" in fitted.hypothesis.effects
    # a digital filter passes 1 - phi of the present sample at once: it is half a sample less late than the analog one
    assert fitted.value("speed-sensor-lag.time_constant") == pytest.approx(-1e-3 / np.log(0.6) - 0.5e-3, rel=0.2)
    off, before = (abs(f.value("inertia") / MOTOR["inertia"] - 1.0) for f in (fitted, plain))
    assert off < 0.05
    assert before > 2.0 * off


def test_explanations_by_several_effects_go_on_beside_a_filter() -> None:
    """What was found before the filter was is not lost; the lag that is the filter is no part of it any more."""
    problem, noise = _problem(0.6)
    added = ("coulomb-friction", "speed-sensor-lag")
    before = fit(problem, hypothesis(problem.prior, added, problem.scales))
    (again,) = refitted_beside([before], filtered(problem, sensor_filters(problem, noise)))
    assert again.added == ("coulomb-friction",)
    assert again.hypothesis.effects == ("speed-sensor-lag", "coulomb-friction")
