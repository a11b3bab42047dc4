"""Filters of the sensors that are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered, log_density, noise_before_filters
from rwn.model.model import Model
from rwn.recording.filters import as_filtered, before_filter
from rwn.recording.layout import Layout

STEP, TAU = 1e-3, 2e-3  # [s]
FILTER = SensorFilter(signal="speed", share=float(np.exp(-STEP / TAU)), time_constant=TAU, digital=True)


def _problem(law: str, speed: np.ndarray) -> Problem:
    time = STEP * np.arange(speed.size)
    run = rwn.Recording(name="run", time=time, signals={"voltage": np.sin(20.0 * time), "speed": speed})
    return prepare([run], Model(kind="dc", parameters=MOTOR, recording=Layout(intersample=law)))


@pytest.mark.parametrize(("law", "ticks"), [("held", 1), ("halves", 2), ("thirds", 3)])
def test_what_is_likely_before_a_filter_is_as_likely_as_its_volume_has_it(law: str, ticks: int) -> None:
    n = 60
    problem = filtered(_problem(law, np.random.default_rng(1).standard_normal(n)), [FILTER])
    time = STEP * np.arange(n)
    unit = np.stack([before_filter(time, row, TAU, ticks_per_row=ticks)[0] for row in np.eye(n)])
    assert log_density(problem) == pytest.approx(-np.linalg.slogdet(unit)[1] * n / (n - 1), rel=1e-9)


@pytest.mark.parametrize(("law", "ticks"), [("held", 1), ("halves", 2), ("thirds", 3)])
def test_the_noise_before_a_filter_is_that_of_its_samples(law: str, ticks: int) -> None:
    """Of samples at every so many ticks, each with noise of its own, that went through a filter tick by tick."""
    rng, rows = np.random.default_rng(2), 20_000
    shown = as_filtered(STEP / ticks * np.arange(rows * ticks), rng.standard_normal(rows * ticks), TAU)[::ticks]
    problem = _problem(law, shown)
    problem = replace(problem, noise={"speed": replace(problem.noise["speed"], level=float(np.std(shown)))})
    noise = noise_before_filters(replace(problem, filters={"speed": TAU}), problem.noise)["speed"]
    before, _ = before_filter(STEP * np.arange(rows), shown, TAU, ticks_per_row=ticks)
    new = noise.innovations(before)
    assert np.std(before) == pytest.approx(noise.deviation, rel=0.03)
    assert np.std(new[10:]) == pytest.approx(1.0, rel=0.03)
    assert np.corrcoef(new[10:-1], new[11:])[0, 1] == pytest.approx(0.0, abs=0.03)
