"""An input of stairs that switches where no row shows it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.sparse import csr_array

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.fit.fit import fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.preparation import prepare
from rwn.measurement.likeliest_law import likeliest, stating
from rwn.measurement.likelihood import log_likelihood
from rwn.measurement.switched_input import is_of_stairs, switched
from rwn.measurement.unrecorded_input import with_unrecorded_input
from rwn.model.model import Model
from rwn.recording.intersample import INTERSAMPLE, PiecewiseInput

Array = NDArray[np.float64]

MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "viscous_friction": 0.1})
STEP = 1e-3
POLE = 0.6


def _two_levels(rng: np.random.Generator, size: int, shortest: int) -> Array:
    """A voltage that goes to and fro between two levels, at any tick."""
    ends = np.cumsum(rng.integers(shortest, 6 * shortest, size))
    return 6.0 * (np.searchsorted(ends, np.arange(size), side="right") % 2) - 2.0


def _thinned(voltage: Array, every: int, law: str) -> PiecewiseInput:
    time = STEP * np.arange(voltage.size)[::every]
    given = INTERSAMPLE[law].applied(time, voltage[::every])
    assert given is not None
    return given


def _of_first_order(given: PiecewiseInput, truth: Array, every: int, noise: float) -> tuple[csr_array, Array]:
    """Responses (n, m) to the unknown values, and errors (n,) under the given ones."""
    rng, ticks = np.random.default_rng(1), np.arange(truth.size)
    lag = ticks[:, None] - ticks[None, :]
    of_tick = np.where(lag > 0, (1.0 - POLE) * POLE ** np.maximum(lag - 1.0, 0.0), 0.0)[::every]
    known = np.rint(given.instants / STEP).astype(int)
    errors = of_tick[:, known] @ (truth[known] - given.values) + noise * rng.standard_normal(of_tick.shape[0])
    return csr_array(of_tick[:, known[given.spread > 0.0]] / noise), errors / noise


@pytest.mark.parametrize(("every", "law"), [(2, "halves"), (3, "thirds")])
def test_the_switches_are_found_at_their_ticks(every: int, law: str) -> None:
    truth = _two_levels(np.random.default_rng(2), 600, 2 * every)
    given = _thinned(truth, every, law)
    assert is_of_stairs(given)
    response, errors = _of_first_order(given, truth, every, 0.02)
    found = switched(given, {"speed": response}, {"speed": errors})
    assert np.array_equal(found.values, truth[np.rint(given.instants / STEP).astype(int)])
    gaps = np.count_nonzero(np.diff(truth[::every]))
    assert found.log_ways == pytest.approx(gaps * np.log(every))


def test_an_input_that_moves_at_most_rows_is_none_of_stairs() -> None:
    swept = np.sin(0.02 * np.arange(600.0))
    assert not is_of_stairs(_thinned(swept, 2, "halves"))
    held_for_longer = np.concatenate([swept, np.zeros(1000), swept])
    assert not is_of_stairs(_thinned(held_for_longer, 2, "halves"))


def test_an_input_may_have_moved_on_a_line() -> None:
    given = _thinned(_two_levels(np.random.default_rng(3), 600, 4), 2, "line")
    size = int(np.count_nonzero(given.spread))
    still = csr_array(np.eye(size)), np.zeros(size)
    assert np.array_equal(switched(given, {"speed": still[0]}, {"speed": still[1]}).values, given.values)


def test_a_gap_that_was_told_a_switch_may_go_back_to_the_line() -> None:
    given = _thinned(_two_levels(np.random.default_rng(3), 600, 4), 2, "line")
    unknown = np.flatnonzero(given.spread)
    response = {"speed": csr_array(np.eye(unknown.size))}
    once = switched(given, response, {"speed": np.full(unknown.size, 10.0)})  # all lie above the line
    assert not np.array_equal(once.values, given.values)
    back = switched(once, response, {"speed": given.values[unknown] - once.values[unknown]})
    assert np.array_equal(back.values, given.values)
    assert back.log_ways == once.log_ways


def _recorded(every: int, effects: dict[str, dict[str, float]]) -> tuple[Array, rwn.Recording]:
    rng, time = np.random.default_rng(5), STEP * np.arange(4500)
    voltage = _two_levels(rng, time.size, 15)
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(Model(kind="dc", parameters=MOTOR, effects=effects), bare).signals["speed"]
    speed = speed + 0.05 * rng.standard_normal(time.size)
    kept = replace(bare, time=time[::every], signals={"voltage": voltage[::every], "speed": speed[::every]})
    return voltage, kept


@pytest.mark.parametrize(("every", "law"), [(2, "halves"), (3, "thirds")])
def test_the_motion_tells_each_switch_of_a_thinned_recording(every: int, law: str) -> None:
    voltage, kept = _recorded(every, {"coulomb-friction": {"coulomb_torque": 5e-3}})
    (found,) = with_unrecorded_input([kept], stating(MODEL, law))
    assert found.applied_input is not None
    true = voltage[np.rint(found.applied_input.instants / STEP).astype(int)]
    unknown = np.count_nonzero(found.applied_input.spread)
    assert np.count_nonzero(found.applied_input.values != true) < 0.1 * unknown
    problem = prepare([kept], stating(MODEL, "held"))
    assert likeliest(problem, fit(problem, hypothesis(problem.prior, (), problem.scales))) == law


def test_choosing_among_switches_makes_nothing_likelier_by_itself() -> None:
    _, kept = _recorded(2, {})
    (told,) = with_unrecorded_input([kept], stating(MODEL, "halves"))
    problem = prepare([told], stating(MODEL, "halves"))
    this = fit(problem, hypothesis(problem.prior, (), problem.scales))
    assert told.applied_input is not None
    free = replace(problem, runs=(replace(problem.runs[0], applied_input=replace(told.applied_input, log_ways=0.0)),))
    gained = log_likelihood(free, this) - log_likelihood(problem, this)
    assert gained == pytest.approx(told.applied_input.log_ways)
    assert gained > 10.0
