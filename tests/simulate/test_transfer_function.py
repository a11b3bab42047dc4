"""Models of kind `lti`: simulation against NumPy, fits with known answers, what their diagnosis names."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

import rwn
from rwn.model.vocabulary import table
from rwn.recording.layout import Layout
from rwn.simulate.transfer_function import state_space, states

Array = NDArray[np.float64]
STEP, NOISE = 0.02, 0.01
# a slow pole at 2/s beside a resonance at 25 rad/s with damping 0.1, as of two motors on a belt
TRUTH = {"b0": 1500.0, "b1": -20.0, "b2": 0.5, "a0": 1250.0, "a1": 635.0, "a2": 7.0}
BELT = rwn.Model(kind="lti", parameters=TRUTH, order=3)
UNKNOWN = rwn.Model(kind="lti", parameters={}, order=3)


def truth(time: Array, voltage: Array, start: Array | None = None) -> Array:
    b, a = (np.array([TRUTH[f"{letter}{k}"] for k in range(3)]) for letter in "ba")
    return states(*state_space(b, a), time, voltage, start)[:, 0]


def made(
    seed: int, *, see: Callable[[Array], Array] = np.array, act: Callable[[Array], Array] = np.array, samples: int = 800
) -> rwn.Recording:
    """A recording of the belt under steps of random height; `see` and `act` are what its sensor and amplifier do."""
    rng = np.random.default_rng(seed)
    time = STEP * np.arange(samples)
    voltage = np.repeat(rng.uniform(-2.0, 2.0, samples // 10 + 1), 10)[:samples]
    speed = see(truth(time, act(voltage))) + NOISE * rng.standard_normal(samples)
    return rwn.Recording(name=f"made {seed}", time=time, signals={"voltage": voltage, "speed": speed})


@pytest.mark.slow
def test_simulation_agrees_with_numpy_at_irregular_instants() -> None:
    rng = np.random.default_rng(3)
    time = np.cumsum(rng.uniform(0.005, 0.03, 300))
    voltage = rng.standard_normal(300)
    seen = truth(time, voltage)
    run = rwn.simulate(BELT, rwn.Recording(name="x", time=time, signals={"voltage": voltage, "speed": seen}))
    assert run.status == "ok"
    assert list(run.signals) == ["speed"]
    np.testing.assert_allclose(run.signals["speed"], seen, rtol=0, atol=1e-10)


def test_an_initial_state_is_estimated_where_the_model_says_so() -> None:
    time = STEP * np.arange(300)
    voltage = np.sin(time)
    seen = truth(time, voltage, np.array([0.7, -3.0, 40.0]))
    run = rwn.Recording(name="x", time=time, signals={"voltage": voltage, "speed": seen})
    moving = replace(BELT, recording=Layout(initial="estimate"))
    np.testing.assert_allclose(rwn.simulate(moving, run).signals["speed"], seen, rtol=0, atol=1e-6)
    resting = replace(BELT, recording=Layout(initial="rest"))
    assert np.max(np.abs(rwn.simulate(resting, run).signals["speed"] - seen)) > 0.5


@pytest.mark.slow
def test_identify_finds_coefficients_that_nobody_gave() -> None:
    fit = rwn.identify([made(1), made(2)], UNKNOWN)
    assert fit.status == "converged"
    assert fit.residual_over_noise == pytest.approx(1.0, abs=0.05)
    for name in ("b0", "a0", "a1", "a2"):
        assert fit.parameters[name].value == pytest.approx(TRUTH[name], rel=0.02), name
    again = rwn.identify([made(1), made(2)], replace(BELT, uncertainty={"a0": 0.3}, parameters={**TRUTH, "a0": 1500.0}))
    assert list(again.parameters) == ["a0"]
    assert again.model.parameters["a0"] == pytest.approx(1250.0, rel=0.01)


@pytest.mark.slow
def test_intervals_cover() -> None:
    """36 intervals of 95 %: about 34 hold the truth."""
    fits = [rwn.identify([made(10 + k), made(50 + k)], UNKNOWN).parameters for k in range(6)]
    intervals = [(f[name].interval or (0.0, 0.0), TRUTH[name]) for f in fits for name in TRUTH]
    inside = [low < true < high for (low, high), true in intervals]
    assert len(inside) == 36
    assert sum(inside) >= 30


def test_nothing_is_missing_from_a_linear_belt() -> None:
    found = rwn.diagnose([made(1)], UNKNOWN, heldout=[made(2)])
    assert found.verdict == "adequate"
    row = next(r for r in found.heldout if r.region == "all")
    assert row.refitted == pytest.approx(NOISE, rel=0.2)


def dead(voltage: Array) -> Array:
    return np.sign(voltage) * np.maximum(np.abs(voltage) - 0.3, 0.0)


def late(voltage: Array) -> Array:
    return np.concatenate([np.zeros(3), voltage[:-3]])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "how"),
    [
        ("sensor-rectification", {"see": np.abs}),
        ("sensor-bias", {"see": lambda y: y + 0.2}),
        ("actuator-deadzone", {"act": dead}),
        ("voltage-saturation", {"act": lambda v: np.clip(v, -1.2, 1.2)}),
        ("input-delay", {"act": late}),
    ],
)
def test_effects_of_amplifier_and_sensor_are_named(name: str, how: dict[str, Callable[[Array], Array]]) -> None:
    found = rwn.diagnose([made(1, **how)], UNKNOWN, heldout=[made(2, **how)])
    assert found.verdict == "missing-physics"
    assert [e.name for e in found.effects] == [name]
    assert found.equation == table()[name].mismatch
    row = next(r for r in found.heldout if r.region == "all")
    assert row.corrected == pytest.approx(NOISE, rel=0.25)
    corrected = rwn.simulate(found.corrected, made(2, **how))
    error = corrected.signals["speed"] - made(2, **how).signals["speed"]
    assert np.sqrt(np.mean(error**2)) == pytest.approx(NOISE, rel=0.25)


def test_a_signed_speed_is_not_called_rectified() -> None:
    found = rwn.diagnose([made(1, act=dead)], UNKNOWN)
    assert all("sensor-rectification" not in a.effects for a in found.alternatives)
