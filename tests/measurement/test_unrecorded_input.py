"""The input where no row shows it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.fit.driving_force import of_driving_force
from rwn.fit.fit import fit, fit_nominal
from rwn.fit.hypothesis import hypothesis
from rwn.fit.nominal import nominal_of
from rwn.fit.preparation import prepare
from rwn.measurement.likeliest_law import stating
from rwn.measurement.unrecorded_input import (
    _farthest,
    recording_with_inferred_input,
    with_inferred_input,
    with_unrecorded_input,
)
from rwn.model.model import Model
from rwn.recording.intersample import INTERSAMPLE, PiecewiseInput

MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "viscous_friction": 0.1})


STEP = 1e-3


def _every_second_row(effects: dict[str, dict[str, float]]) -> tuple[np.ndarray, rwn.Recording]:
    """A voltage that steps now and then, at any of the rows, and every second row of what it moves."""
    rng, time = np.random.default_rng(4), STEP * np.arange(6000)
    ends = np.cumsum(rng.integers(40, 60, 160))
    voltage = rng.uniform(-3.0, 3.0, 160)[np.searchsorted(ends, np.arange(6000), side="right")]
    truth = Model(kind="dc", parameters=MOTOR, effects=effects)
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(truth, bare).signals["speed"] + 0.05 * rng.standard_normal(time.size)
    return voltage, replace(bare, time=time[::2], signals={"voltage": voltage[::2], "speed": speed[::2]})


def _missed(voltage: np.ndarray, kept: rwn.Recording, found: rwn.Recording) -> float:
    """Deviation of the voltage found where a step is not shown, in units of that of the middle of it."""
    assert found.applied_input is not None
    unknown = found.applied_input.spread > 0.3
    true = voltage[np.rint(found.applied_input.instants[unknown] / STEP).astype(int)]
    between = np.interp(found.applied_input.instants[unknown], kept.time, voltage[::2])
    return float(np.std(found.applied_input.values[unknown] - true) / np.std(between - true))


@pytest.mark.parametrize("friction", [0.0, 5e-3])
def test_the_motion_tells_when_a_voltage_stepped_between_two_rows(friction: float) -> None:
    voltage, kept = _every_second_row({"coulomb-friction": {"coulomb_torque": friction}})
    (found,) = with_unrecorded_input([kept], stating(MODEL, "halves"))
    assert _missed(voltage, kept, found) < 0.3


@pytest.mark.parametrize("rows", [1.4, 4.6])
def test_an_input_that_acts_late_is_told_by_an_explanation_with_the_delay(rows: float) -> None:
    """A model without it takes the steps of the voltage for later ones."""
    late = {"input-delay": {"delay": rows * STEP}}
    voltage, kept = _every_second_row(late)
    model = stating(MODEL, "halves")
    problem, _ = nominal_of([kept], model)
    explanation = fit(problem, hypothesis(problem.prior, ("input-delay",), problem.scales, late))
    (bent,), (told,) = (with_unrecorded_input([kept], model, known) for known in (None, explanation))
    assert _missed(voltage, kept, told) < 0.3 < _missed(voltage, kept, bent)


def test_a_held_input_is_known_from_its_rows() -> None:
    signals = {"voltage": np.ones(100), "speed": np.ones(100)}
    run = rwn.Recording(name="run", time=1e-3 * np.arange(100.0), signals=signals)
    assert with_unrecorded_input([run], stating(MODEL, "held")) == [run]


@pytest.mark.parametrize("rough", [0.0, 0.5])
def test_as_many_unknown_values_as_samples_do_not_pass_for_less_noise(rough: float) -> None:
    """Every second row of a swept voltage, which a controller makes rough, with the current that it drives."""
    rng, time = np.random.default_rng(2), STEP * np.arange(6000)
    voltage = 4.0 * np.sin(2.0 * np.pi * (1.0 + 4.0 * time) * time) + rough * rng.standard_normal(time.size)
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    moved = rwn.simulate(Model(kind="dc", parameters=MOTOR), bare).signals
    level = {"current": 0.02, "speed": 0.5}
    shown = {s: (moved[s] + deviation * rng.standard_normal(time.size))[::2] for s, deviation in level.items()}
    kept = rwn.Recording(name="run", time=time[::2], signals={"voltage": voltage[::2], **shown})
    model = stating(MODEL, "halves")
    problem, _ = nominal_of(with_unrecorded_input([kept], model), model)
    found = {s: problem.noise[s].deviation for s in level}
    assert all(found[s] > 0.75 * level[s] for s in level)
    if not rough:  # else most of what the current shows may be either
        assert found == pytest.approx(level, rel=0.25)


def test_neighbours_of_different_gaps_are_told_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the sample before a step a row was lost, and the one after it may be shown by a row or not."""
    rng, time, step = np.random.default_rng(5), STEP * np.arange(400), 201
    voltage = np.where(np.arange(400) < step, -0.5, 2.5)
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(Model(kind="dc", parameters=MOTOR), bare).signals["speed"] + 0.05 * rng.standard_normal(400)
    values, spread = voltage.copy(), np.zeros(400)
    values[step], spread[step - 1 : step + 1] = -0.2, (0.005, 0.6)
    given = PiecewiseInput(instants=time, values=values, spread=spread, gaps=np.arange(400))
    law = replace(INTERSAMPLE["bridged"], applied=lambda _time, _values: given)
    monkeypatch.setitem(INTERSAMPLE, "bridged", law)
    run = replace(bare, signals={"voltage": voltage, "speed": speed})
    (found,) = with_unrecorded_input([run], stating(MODEL, "bridged"))
    assert found.applied_input is not None
    assert found.applied_input.values[step - 1] == pytest.approx(-0.5, abs=0.02)
    assert found.applied_input.values[step] == pytest.approx(2.5, abs=0.6)  # the prior holds it back


def test_a_value_that_leans_to_one_neighbour_may_yet_be_the_other() -> None:
    """As of a tick that its row shows by a chance of one in six."""
    given = PiecewiseInput(
        instants=STEP * np.arange(4.0), values=np.array([6.0, -1.0, -2.0, -2.0]), spread=np.array([0.0, 2.0, 0.0, 0.0])
    )
    low, high = _farthest(given, np.array([1]))
    assert low == pytest.approx(-2.0 * np.sqrt(3.0))
    assert high == pytest.approx(7.0)


def test_a_model_as_it_stands_tells_the_input_of_a_recording_that_it_was_not_fitted_to() -> None:
    """Steps in the middle of what their rows show would bend the model first, and the input after it."""
    voltage, kept = _every_second_row({})
    wrong = kept.signals["speed"].copy()
    wrong[500] += 1000.0  # a spike
    run = replace(kept, signals={**kept.signals, "speed": wrong})
    truth = stating(replace(MODEL, uncertainty={"inertia": 0.1}), "halves")
    told = recording_with_inferred_input(run, truth)
    assert _missed(voltage, kept, told) < 0.3
    off = replace(truth, parameters={**MOTOR, "inertia": 1.5 * MOTOR["inertia"]})
    by_another = recording_with_inferred_input(run, off)  # which is not refitted
    assert _missed(voltage, kept, by_another) > 1.2 * _missed(voltage, kept, told)


def test_a_recording_that_was_not_fitted_is_simulated_with_the_input_that_its_motion_tells() -> None:
    _, kept = _every_second_row({})
    half = kept.time.size // 2
    fitted, unseen = (
        rwn.Recording(name=name, time=kept.time[rows], signals={s: x[rows] for s, x in kept.signals.items()})
        for name, rows in (("fitted", slice(None, half)), ("unseen", slice(half, None)))
    )
    found = rwn.diagnose([fitted], stating(MODEL, "halves"), heldout=[unseen], jobs=1, effort=0.1)
    (row,) = (r for r in found.heldout if r.region == "all" and r.signal == "speed")
    assert row.refitted < 1.2 * row.noise_floor
    (said,) = (f for f in found.findings if f.kind == "intersample" and f.recording == "unseen")
    assert said.count > 0


def test_the_driving_force_of_an_axis_tells_nothing_of_what_drove_it() -> None:
    """The force that its motion took is compared with what the rows show of it."""
    time = STEP * np.arange(2000)
    torque = 0.1 * np.sign(np.sin(2.0 * np.pi * 1.3 * time))
    axis = Model(kind="axis", parameters={"inertia": 1e-3, "viscous_friction": 2e-2}, uncertainty={"inertia": 0.1})
    bare = rwn.Recording(name="run", time=time, signals={"torque": torque})
    position = rwn.simulate(axis, bare).signals["position"]
    run = rwn.Recording(name="run", time=time[::2], signals={"torque": torque[::2], "position": position[::2]})
    problem = of_driving_force(prepare([run], axis))
    between = INTERSAMPLE["halves"].applied
    halves = replace(problem, runs=tuple(replace(r, applied_input=between(r.time, r.input)) for r in problem.runs))
    (told,), (given,) = with_inferred_input(halves, fit_nominal(halves)).runs, halves.runs
    assert given.applied_input is not None
    assert given.applied_input.spread.any()
    assert told.applied_input is not None
    np.testing.assert_array_equal(told.applied_input.values, given.applied_input.values)
