"""A position that errs as under a torque which is new in every row, and one that errs with the motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

import rwn
from rwn.fit.disturbance import FEWEST, distance_from_disturbance
from rwn.fit.fit import fit_nominal
from rwn.fit.preparation import prepare
from rwn.fit.residual_noise import with_noise_of
from rwn.fit.residuals import structured
from rwn.model.model import Model

SHARE, SAMPLES, LIMIT = 0.99, 4000, 1.63  # Kolmogorov, Smirnov: at 1 %
AXIS = Model(kind="axis", parameters={"inertia": 9e-4, "viscous_friction": 1.2e-3}, uncertainty={"inertia": 0.1})


def _answer(torque: np.ndarray) -> np.ndarray:
    return lfilter([1.0], np.convolve([1.0, -1.0], [1.0, -SHARE]), torque)


def _white(seed: int) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal(SAMPLES)


@pytest.mark.parametrize("sensor", [0.0, 1.0, 30.0, 1e6])
def test_white_torque_and_the_noise_of_the_sensor_are_a_disturbance(sensor: float) -> None:
    far = [distance_from_disturbance(_answer(_white(k)) + sensor * _white(k + 100), SHARE) for k in range(40)]
    assert sum(one > LIMIT for one in far) <= 2
    assert max(far) < 2.0


@pytest.mark.parametrize("law", ["wanders", "turns"])
def test_a_torque_that_lasts_or_goes_with_the_motion_is_none(law: str) -> None:
    wandering, turning = 0.02 * np.cumsum(_white(3)), 0.3 * np.sin(np.cumsum(0.05 + 0.04 * np.sin(_times())))
    error = _answer(_white(1) + {"wanders": wandering, "turns": turning}[law]) + _white(2)
    assert distance_from_disturbance(error, SHARE) > LIMIT


def test_little_tells_nothing() -> None:
    assert distance_from_disturbance(_white(1)[: FEWEST - 1], SHARE) == np.inf
    assert distance_from_disturbance(np.zeros(SAMPLES), SHARE) == np.inf
    lost = _answer(_white(1)) + _white(2)
    lost[::50] = np.nan
    assert distance_from_disturbance(lost, SHARE) < LIMIT


def _times() -> np.ndarray:
    return np.arange(SAMPLES) / 200.0


@pytest.mark.parametrize("lasting", [False, True])
def test_a_drift_that_is_new_in_each_row_is_no_structure(lasting: bool) -> None:
    """What acts between the rows is not in the file; a torque that wanders is what a model may lack."""
    rng, time = np.random.default_rng(7), 1e-3 * np.arange(6000)
    torque = 0.25 * np.sign(np.sin(5.0 * time + 0.2)) + 0.1 * np.repeat(rng.uniform(-1.0, 1.0, 60), 100)
    beside = 5e-3 * rng.standard_normal(time.size)
    beside = 0.01 * np.cumsum(beside) if lasting else beside
    acted = rwn.Recording(name="acted", time=time, signals={"torque": torque + beside})
    made = rwn.simulate(AXIS, acted).signals
    noise = {"speed": 0.1, "position": 1e-5}
    seen = {s: made[s] + n * rng.standard_normal(time.size) for s, n in noise.items()}
    problem = prepare([replace(acted, name="run", signals={"torque": torque, **seen})], AXIS)
    problem = with_noise_of(problem, fit_nominal(problem))
    assert ("position" in structured(problem, fit_nominal(problem))) == lasting
