"""Steps of a coarse converter beneath noise that came behind it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

import rwn
from rwn.recording.inspection import inspected
from rwn.recording.inspection.converter_steps import without_noise_on_steps
from rwn.recording.noisy_steps import noisy_steps

Array = NDArray[np.float64]

STEP, NOISE = 3.3, 0.1
TIME = np.arange(3000) * 1e-3


def _speed(rng: np.random.Generator) -> Array:
    """A motor's under a voltage that changes at random."""
    pushed = np.repeat(rng.normal(0.0, 60.0, TIME.size // 50), 50)
    speed = np.zeros(TIME.size)
    for k in range(1, TIME.size):
        speed[k] = speed[k - 1] + 0.04 * (pushed[k] - speed[k - 1])
    return speed


def _rounded(speed: Array, rng: np.random.Generator, noise: float = NOISE) -> Array:
    steps: Array = STEP * np.round(speed / STEP) + noise * rng.standard_normal(speed.size)
    return steps


def test_the_step_and_the_noise_are_found() -> None:
    rng = np.random.default_rng(1)
    speed = _speed(rng)
    found = noisy_steps(_rounded(speed, rng) + 0.7)
    assert found is not None
    assert found.step == pytest.approx(STEP, rel=1e-3)
    assert found.noise == pytest.approx(NOISE, rel=0.1)
    assert np.mean(found.holds(_rounded(speed, rng) + 0.7)) > 0.99
    off = (found.nearest(speed + 0.7) - 0.7) / STEP
    assert np.max(np.abs(off - np.round(off))) < 0.02


def test_it_is_the_step_and_no_part_of_it() -> None:
    rng = np.random.default_rng(2)
    found = noisy_steps(_rounded(_speed(rng), rng, noise=1e-3))
    assert found is not None
    assert found.step == pytest.approx(STEP, rel=1e-3)


@pytest.mark.parametrize("noise", [STEP, 0.3 * STEP])
def test_steps_that_the_noise_hides_are_none(noise: float) -> None:
    rng = np.random.default_rng(3)
    assert noisy_steps(_rounded(_speed(rng), rng, noise=noise)) is None


def _plain(rng: np.random.Generator) -> Array:
    return _speed(rng) + NOISE * rng.standard_normal(TIME.size)


def _periodic(rng: np.random.Generator) -> Array:
    return 50.0 * np.sin(rng.uniform(5.0, 50.0) * TIME) + NOISE * rng.standard_normal(TIME.size)


def _stairs(rng: np.random.Generator) -> Array:
    """Levels that lie anywhere, each held for a while and come to at once."""
    return np.repeat(rng.uniform(-100.0, 100.0, 30), TIME.size // 30) + NOISE * rng.standard_normal(TIME.size)


def _levels(rng: np.random.Generator) -> Array:
    """A few levels that come back."""
    return np.asarray(rng.choice([-60.0, -20.0, 20.0, 60.0], TIME.size)) + NOISE * rng.standard_normal(TIME.size)


def _written(rng: np.random.Generator) -> Array:
    """With few digits, as of a clock: no value comes back."""
    return np.round(np.arange(200) * 0.02 + 1e-9 * rng.standard_normal(200), 4)


def _turned(rng: np.random.Generator) -> Array:
    """The position of a shaft at a steady speed, updated every fourth row, which creeps before it."""
    pace = np.append(np.linspace(0.0, 1.0, 40) ** 2, 1.0 + 0.01 * np.sin(0.05 * np.arange(180)))
    return np.repeat(np.cumsum(pace) + 0.05 * rng.standard_normal(pace.size), 4)


def _turned_and_lost(rng: np.random.Generator) -> Array:
    """The same with a tenth of the updates lost."""
    updates = _turned(rng)[::4]
    return np.repeat(updates[rng.random(updates.size) > 0.1], 4)


@pytest.mark.parametrize("signal", [_plain, _periodic, _stairs, _levels, _written, _turned, _turned_and_lost])
def test_a_signal_without_steps_has_none(signal: Callable[[np.random.Generator], Array]) -> None:
    assert not any(noisy_steps(signal(np.random.default_rng(seed))) for seed in range(60))


def test_short_or_flat_signals_have_none() -> None:
    assert noisy_steps(np.zeros(3000)) is None
    assert noisy_steps(np.arange(50.0) % 7.0 + 0.01 * np.random.default_rng(4).standard_normal(50)) is None


def test_a_check_puts_a_signal_on_its_steps() -> None:
    rng = np.random.default_rng(5)
    speed, voltage = _speed(rng), rng.standard_normal(TIME.size)
    shown = _rounded(speed, rng)
    shown[::10] = speed[::10]  # what a logger put between two samples
    given = rwn.Recording(time=TIME, signals={"voltage": voltage, "speed": shown}, name="run.csv")
    taken, (found,) = without_noise_on_steps(given)
    missing = taken.missing["speed"]
    assert 0.06 < np.mean(missing) < 0.1  # of a tenth, but those near a step
    assert np.array_equal(np.unique(np.diff(np.unique(np.round(taken.signals["speed"][~missing] / STEP)))), [1.0])
    assert found.kind == "converter-steps"
    assert "3.3 rad/s" in found.words
    assert "between" in found.words
    assert found.kind in {f.kind for f in inspected([given]).findings}


def test_a_recording_without_steps_stays_as_it_is() -> None:
    rng = np.random.default_rng(6)
    signals = {"voltage": rng.standard_normal(TIME.size), "speed": _plain(rng)}
    given = rwn.Recording(time=TIME, signals=signals, name="run.csv")
    taken, found = without_noise_on_steps(given)
    assert taken is given
    assert not found
