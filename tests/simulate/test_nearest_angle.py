"""A shaft that turned before its recording began, at an angle that nothing tells."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

import rwn
from ranked import ranked_from
from rwn.fit.fit import fit_nominal
from rwn.fit.hypothesis import hypothesis
from rwn.fit.preparation import prepare
from rwn.model.initial_state import INITIAL_POSITION
from rwn.model.model import Model
from rwn.model.vocabulary import motor_index, table
from rwn.name.initial_guesses.initial_angle import aligned
from rwn.name.initial_guesses.spectra import angle_spectrum
from rwn.simulate.nearest_angle import angles_to_try

STEP = 1e-3
MOTOR = {
    "resistance": 1.0, "inductance": 1e-4, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 5e-5,
    "viscous_friction": 2e-5,
}  # fmt: skip
COGGING = {"cogging-torque": {"amplitude": 2e-3, "periods_per_rev": 5.0, "phase": 0.4}}
SHEET = Model(kind="dc", parameters=MOTOR, uncertainty=dict.fromkeys(("inertia", "viscous_friction"), 0.2))


def seen(effects: Mapping[str, Mapping[str, float]], cut: int, seed: int) -> rwn.Recording:
    """The last samples of a run with varied voltage, as of a logger that was started late and has no position."""
    rng = np.random.default_rng(seed)
    voltage = np.repeat(rng.uniform(1.0, 3.0, 30), 60)
    whole = rwn.Recording(name="x", time=STEP * np.arange(voltage.size), signals={"voltage": voltage})
    speed = rwn.simulate(Model(kind="dc", parameters=MOTOR, effects=effects), whole).signals["speed"]
    speed = speed + 0.02 * rng.standard_normal(speed.size)
    signals = {"voltage": voltage[cut:], "speed": speed[cut:]}
    return rwn.Recording(name=f"run_{seed}.csv", time=STEP * np.arange(voltage.size - cut), signals=signals)


def test_angles_to_try_go_once_round_what_comes_back() -> None:
    known, vector = table(), np.zeros(10_000)
    assert angles_to_try([known["coulomb-friction"]], vector).size == 0
    vector[known["cogging-torque"].at("periods_per_rev")] = 6.0
    one = angles_to_try([known["cogging-torque"]], vector)
    assert one[-1] < 2.0 * np.pi / 6.0 <= one[-1] + one[1]
    both = angles_to_try([known["cogging-torque"], known["unbalance"]], vector)
    assert both[-1] < 2.0 * np.pi <= both[-1] + both[1]
    assert both[1] == pytest.approx(one[1])  # as fine as the fastest of them asks


@pytest.mark.slow
@pytest.mark.parametrize("effects", [COGGING, {"inertia-variation": {"amplitude": 2e-5}}], ids=lambda e: next(iter(e)))
def test_an_effect_is_found_in_recordings_that_begin_at_any_angle(effects: dict[str, dict[str, float]]) -> None:
    found = ranked_from([seen(effects, 433, 1), seen(effects, 571, 2)], SHEET, at_once=1)
    (name,) = effects
    assert found.fits[0].added == (name,)
    assert found.left.variance < 1.5
    first = next(iter(effects[name]))
    assert found.fits[0].fit.value(f"{name}.{first}") == pytest.approx(effects[name][first], rel=0.05)


@pytest.mark.slow
def test_a_recording_from_rest_beside_one_in_motion_has_a_phase_of_its_own() -> None:
    known, unknown = (seen(COGGING, cut, seed) for cut, seed in ((0, 4), (571, 5)))
    for runs in ([known, unknown], [unknown, known]):
        problem = prepare(runs, SHEET)
        nominal = fit_nominal(problem)
        orders = np.arange(1.0, 20.0)
        residuals = problem.residuals(nominal.vector, nominal.active)
        spectrum = angle_spectrum(problem, nominal.vector, residuals, orders)
        assert orders[np.argmax(spectrum)] == 5.0
        each = [angle_spectrum(replace(problem, runs=(r,)), nominal.vector, [left], orders)
                for r, left in zip(problem.runs, residuals, strict=True)]  # fmt: skip
        energy = [float(np.sum((left["speed"] - left["speed"].mean()) ** 2)) for left in residuals]
        np.testing.assert_allclose(spectrum, np.average(each, axis=0, weights=energy), rtol=1e-6)


@pytest.mark.parametrize(("name", "guess"), [
    ("cogging-torque", {"amplitude": 2e-3, "periods_per_rev": 5.0, "phase": -1.0}),
    ("unbalance", {"amplitude": 2e-3, "phase": 2.0}),
])  # fmt: skip
def test_a_start_is_aligned_with_what_the_nominal_model_leaves(name: str, guess: dict[str, float]) -> None:
    truth = {name: guess | {"phase": 0.4}}
    problem = prepare([seen(truth, 433, 1), seen(truth, 571, 2)], SHEET)
    begun = hypothesis(problem.prior, (name,), problem.scales, {name: guess})
    start = aligned(problem, begun, problem.prior.table[name])
    nominal = problem.error(problem.as_given().vector, [])
    assert problem.error(start.vector, start.active) < 0.1 * nominal
    for run in problem.runs:
        place = next(k for k, parameter in run.start_unknowns if parameter == motor_index(INITIAL_POSITION))
        for off in (-0.1, 0.1):  # of a turn of the effect
            moved = start.vector.copy()
            moved[place] += off * 2.0 * np.pi / guess.get("periods_per_rev", 1.0)
            assert problem.error(start.vector, start.active) < problem.error(moved, start.active)


def test_a_simulation_begins_at_the_angle_that_fits_what_was_recorded() -> None:
    truth = Model(kind="dc", parameters=MOTOR, effects=COGGING)
    run = seen(COGGING, 433, 3)
    left = run.signals["speed"] - rwn.simulate(truth, run).signals["speed"]
    bare = run.signals["speed"] - rwn.simulate(SHEET, run).signals["speed"]
    settled = slice(200, None)  # the first sample of the speed is off by its noise
    assert np.std(left[settled]) < 0.03
    assert np.std(bare[settled]) > 2.0 * np.std(left[settled])
