"""What a residual may be: noise, something slow, or something that swings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

import rwn
from ranked import ranked
from rwn.fit.preparation import prepare
from rwn.fit.residuals import Statistics, statistics_of, structured_of
from rwn.model.model import Model

Array = NDArray[np.float64]
SAMPLES = 4000


def _noise() -> Array:
    return np.random.default_rng(5).standard_normal(SAMPLES)


def _statistics(joined: Mapping[str, Array], *, over: int = 0) -> Statistics:
    return statistics_of(joined, structured=structured_of(joined, differences={"speed": over} if over else {}))


def _rounding() -> Array:
    """What is rounded off the position of a motor whose speed goes up and down, in counts."""
    position = 30.0 * np.cumsum(1.0 + np.sin(np.arange(SAMPLES) / 300.0))
    off: Array = np.round(position) - position
    return off


def _swing(periods: float) -> Array:
    """A decaying swing, struck anew every 50 samples."""
    since = np.arange(SAMPLES) % 50
    swing: Array = np.exp(-since / 12.0) * np.sin(2.0 * np.pi * since / periods)
    return swing


def test_noise_is_at_the_floor_however_loud() -> None:
    for loud in (1.0, 5.0):
        assert _statistics({"speed": loud * _noise()}).at_the_floor


@pytest.mark.parametrize("away", [1e60, 1e101])
def test_what_ran_away_is_one_observation_of_something_that_is_no_noise(away: float) -> None:
    joined = {"speed": np.concatenate([_noise(), [away]]), "current": _noise()}
    left = _statistics(joined)
    assert left.effective == pytest.approx(1.0, rel=1e-3)
    assert left.variance == np.inf
    assert not left.at_the_floor
    assert structured_of(joined) == ("speed",)


def test_samples_count_as_evidence_by_what_they_are_samples_of() -> None:
    """Noise for 1000 at most, misfit for 50: what is half of each for the one over the mean of their inverses."""
    left = Statistics(count=40_000, variance=1.0, correlation_time=2.0)
    assert left.independent == 1000.0
    half = replace(left, variance=2.0, structured=("speed",))
    assert half.independent == pytest.approx(2.0 / (1.0 / 1000.0 + 1.0 / 50.0))
    assert replace(half, correlation_time=4000.0).independent == 10.0


def test_samples_tell_values_by_all_that_noise_is_worth_and_by_little_of_misfit() -> None:
    left = Statistics(count=40_000, variance=1.0, correlation_time=2.0)
    assert left.effective_with_misfit == left.effective == 20_000.0
    half = replace(left, variance=2.0, structured=("speed",))
    assert half.effective_with_misfit == pytest.approx(2.0 / (1.0 / 20_000.0 + 1.0 / 50.0))
    few = replace(half, correlation_time=4000.0)
    assert few.effective_with_misfit == few.effective == 10.0
    assert Statistics(count=0, variance=2.0, correlation_time=1.0).effective_with_misfit == 0.0


def test_differences_of_counts_are_noise() -> None:
    for over in (1, 2, 5):
        error = _rounding()[over:] - _rounding()[:-over]
        assert _statistics({"speed": 5.0 * error}, over=over).at_the_floor


def test_of_differences_of_counts_only_slow_errors_are_structure() -> None:
    irregular = {"speed": np.diff(_rounding() + 0.3 * _noise())}  # the lines of an encoder are off their places
    assert structured_of(irregular) == ("speed",)
    assert structured_of(irregular, differences={"speed": 1}) == ()
    slow = {"speed": irregular["speed"] + 0.3 * np.sin(np.arange(SAMPLES - 1) / 40.0)}
    assert structured_of(slow, differences={"speed": 1}) == ("speed",)


@pytest.mark.parametrize("periods", [4.0, 5.3, 7.3])
def test_what_swings_is_more_than_noise(periods: float) -> None:
    loud, quiet = ({"speed": size * _swing(periods) + _noise()} for size in (5.0, 0.3))
    assert not _statistics(loud).at_the_floor
    assert _statistics(quiet).at_the_floor  # there is no more of it than the noise may be wrong by


@pytest.mark.slow
@pytest.mark.parametrize(("stiffness", "noise"), [(4.0, 0.2), (20.0, 0.05)], ids=["7 samples", "3 samples"])
def test_a_shaft_is_seen_beside_a_drag(stiffness: float, noise: float) -> None:
    """However few samples it swings within: a backlash that is never left is no shaft."""
    motor = {
        "resistance": 2.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05,
        "inertia": 2e-5, "viscous_friction": 2e-6,
    }  # fmt: skip
    missing = {
        "quadratic-drag": {"drag_coefficient": 1e-6},
        "shaft-compliance": {"stiffness": stiffness, "damping": 1e-3, "load_inertia": 8e-6, "load_viscous_share": 0.0},
    }
    draw = np.random.default_rng(8)
    time = np.arange(3000) / 1000.0
    voltage = np.repeat(draw.uniform(2.0, 12.0, 60), 50)
    seen = rwn.Recording(name="shaft.csv", time=time, signals={"voltage": voltage})
    done = rwn.simulate(Model(kind="dc", parameters=motor, effects=missing), seen)
    signals = {"voltage": voltage, "speed": done.signals["speed"] + noise * draw.standard_normal(time.size)}
    model = Model(kind="dc", parameters=motor, uncertainty=dict.fromkeys(motor, 0.05))
    problem = prepare([rwn.Recording(name="shaft.csv", time=time, signals=signals)], model)
    ranking = ranked(problem, [*sorted(missing), "backlash"], at_once=2)
    assert set(ranking.fits[0].added) == set(missing)
