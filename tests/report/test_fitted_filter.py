"""A filter of a sensor that was found in the noise is reported with its time constant, and explains the colour."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.fit.fit import fit_nominal
from rwn.fit.preparation import prepare
from rwn.fit.residual_noise import with_noise_of
from rwn.fit.residuals import statistics
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered
from rwn.model.model import Model
from rwn.report.fitted_filter import fitted_filters
from rwn.report.text import filter_in_words

SHARE, STEP = 0.6, 1e-3  # of a sample's noise that was in the sample before; [s]
MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "viscous_friction": 0.1})


def recorded(samples: int = 2000) -> rwn.Recording:
    """A run of the model itself whose speed, with its noise, went through a digital filter of first order."""
    rng, time = np.random.default_rng(7), STEP * np.arange(samples)
    voltage = np.repeat(3.0 * rng.uniform(-1.0, 1.0, samples // 50), 50)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(MODEL, run).signals["speed"] + 0.2 * rng.standard_normal(samples)
    return replace(run, signals={"voltage": voltage, "speed": lfilter([1.0 - SHARE], [1.0, -SHARE], speed)})


def test_the_time_constant_is_reported_with_its_interval() -> None:
    problem = prepare([recorded()], MODEL)
    seen = SensorFilter(signal="speed", share=SHARE, time_constant=-STEP / np.log(SHARE))
    problem = filtered(problem, [seen])
    problem = with_noise_of(problem, fit_nominal(problem))
    this = fit_nominal(problem)
    (fitted,) = fitted_filters(this, statistics(problem, this), problem.filters)
    assert fitted.signal == "speed"
    # a digital filter passes 1 - phi of the present sample at once: it is half a sample less late than the analog one
    assert fitted.time_constant.value == pytest.approx(-STEP / np.log(SHARE) - 0.5 * STEP, rel=0.2)
    low, high = fitted.time_constant.interval or (0.0, 0.0)
    assert 0.0 < low < fitted.time_constant.value < high < 1.5 * fitted.time_constant.value


def test_a_fit_without_a_filter_reports_none() -> None:
    problem = prepare([recorded()], MODEL)
    this = fit_nominal(problem)
    assert fitted_filters(this, statistics(problem, this), problem.filters) == ()


def test_a_filter_that_is_undone_is_reported_too() -> None:
    problem = prepare([recorded()], MODEL)
    problem = filtered(problem, [SensorFilter(signal="speed", share=SHARE, time_constant=2e-3, digital=True)])
    this = fit_nominal(problem)
    (undone,) = fitted_filters(this, statistics(problem, this), problem.filters)
    assert undone.time_constant.value == 2e-3
    assert undone.time_constant.interval is None
    assert "it was undone" in filter_in_words(undone.signal, undone.time_constant)


@pytest.mark.slow
def test_no_warning_says_that_what_is_left_lasts_where_a_filter_explains_it() -> None:
    found = rwn.diagnose([recorded()], MODEL, effort=0.1)
    assert [f.signal for f in found.sensor_filters] == ["speed"]
    assert not any("lasts" in warning for warning in found.warnings)
