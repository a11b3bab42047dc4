"""Friction that differs from recording to recording."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_files import files_of
from rwn import _core
from rwn.fit.fit import fit_nominal
from rwn.fit.hypothesis import hypothesis
from rwn.fit.nominal import weighted_by_nominal
from rwn.fit.preparation import prepare
from rwn.measurement.levels import SPREAD, can_differ, friction, level_beside, uneven, with_levels
from rwn.model.model import Model
from rwn.name.uneven import uneven_beside
from rwn.simulate.recorded_run import judging_run

MOTOR = {
    "resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 2e-5,
    "viscous_friction": 4e-5, "coulomb_friction": 4e-3,
}  # fmt: skip
FRICTION = ("viscous_friction", "coulomb_friction")
MODEL = Model(
    kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "resistance": 0.1, **dict.fromkeys(FRICTION, 0.3)}
)
FACTORS = (0.92, 1.02, 1.09)


def _recordings(factors: tuple[float, ...]) -> list[rwn.Recording]:
    return files_of(MODEL, FRICTION, factors)


def _uneven(found: rwn.Diagnosis) -> dict[str, float]:
    """By how many per cent the friction of a recording is said to be off, by its name."""
    said = {f.recording: f.words for f in found.findings if f.kind == "uneven-friction"}
    return {name: float(words.removeprefix("its friction is ").split(" %")[0]) for name, words in said.items()}


@pytest.mark.slow
def test_files_of_different_friction_are_said_and_nothing_is_missing() -> None:
    found = rwn.diagnose(_recordings(FACTORS), MODEL, jobs=1)
    assert found.verdict == "adequate"
    said = _uneven(found)
    assert set(said) >= {"run_0", "run_2"}
    mean = float(np.exp(np.mean(np.log(FACTORS))))
    assert said["run_0"] == pytest.approx(100.0 * (FACTORS[0] / mean - 1.0), abs=1.0)
    assert said["run_2"] == pytest.approx(100.0 * (FACTORS[2] / mean - 1.0), abs=1.0)


def test_files_of_one_friction_are_not_told_apart() -> None:
    problem, nominal = weighted_by_nominal(prepare(_recordings((1.0, 1.0, 1.0)), MODEL))
    assert not uneven_beside(problem, nominal, friction(problem)).is_decisive


def test_levels_are_found_to_their_deviation() -> None:
    problem, nominal = weighted_by_nominal(prepare(_recordings(FACTORS), MODEL))
    on = with_levels(problem, friction(problem))
    levels = np.array(list(fit_nominal(on).levels.values()))
    expected = np.log(FACTORS)
    assert levels - levels.mean() == pytest.approx(expected - expected.mean(), abs=0.01)
    assert not nominal.levels
    assert not can_differ(on, friction(on))


@pytest.mark.slow
def test_levels_that_differ_by_less_than_a_simulation_is_exact_to_are_not_said() -> None:
    """By 0.2 % each way, of 24000 rows that show it to 0.04 %: an interval is never narrower than that."""
    problem, _ = weighted_by_nominal(prepare(files_of(MODEL, FRICTION, (0.998, 1.002), 24000), MODEL))
    on = with_levels(problem, friction(problem))
    assert uneven(on, fit_nominal(on), friction(on)) == {}


def test_derivatives_by_a_level_are_those_of_the_simulation() -> None:
    problem = prepare(_recordings(FACTORS), MODEL)
    problem = with_levels(problem, friction(problem))
    this = hypothesis(problem.prior, (), problem.scales)
    values = this.start.copy()
    places = [k for k, u in enumerate(this.unknowns) if u.level]
    values[places] = [0.2, -0.1, 0.3]

    def squares(values: np.ndarray) -> float:
        return problem.error(this.with_values(values), this.active)

    gradient = problem.normal(this.with_values(values), this.active, this.by).gradient
    for k, unknown in enumerate(this.unknowns):
        step = 1e-4 * max(abs(values[k]), 1e-9)
        ahead, behind = values.copy(), values.copy()
        ahead[k] += step
        behind[k] -= step
        slope = (squares(ahead) - squares(behind)) / (2.0 * step)
        assert abs(2.0 * gradient[k]) == pytest.approx(abs(slope), rel=2e-3), unknown.name


def test_a_level_is_behind_all_parameters_and_unknown_of_one_recording_alone() -> None:
    problem = prepare(_recordings(FACTORS[:2]), MODEL)
    problem = with_levels(problem, friction(problem))
    places = [_core.parameter_count(), _core.parameter_count() + 1]
    assert [[level.place for level in run.levels] for run in problem.runs] == [places, places]
    assert all(own.spread == SPREAD for own in problem.prior.of_runs if own.level)
    assert problem.on([problem.whole[0]]).runs[0].levels == problem.whole[0].levels


def test_the_mean_of_all_is_the_parameters_and_no_levels() -> None:
    """Where all friction is 2.4 times the data sheet's, that is said of the friction and not of every file."""
    low = replace(MODEL, parameters={**MOTOR, **{name: MOTOR[name] / 2.4 for name in FRICTION}})
    problem, _ = weighted_by_nominal(prepare(_recordings((0.96, 1.04)), low))
    this = fit_nominal(with_levels(problem, friction(problem)))
    assert sum(this.levels.values()) == pytest.approx(0.0, abs=1e-6)
    for name in FRICTION:
        assert this.motor[name] == pytest.approx(MOTOR[name], rel=0.03)


def test_a_lone_recording_has_no_level() -> None:
    problem = prepare(_recordings((1.0,)), MODEL)
    assert not can_differ(problem, friction(problem))


def test_the_level_of_a_recording_that_was_not_fitted_is_the_one_that_fits_it() -> None:
    """With the exact motor: the friction that the recording was made with, and an error of its noise."""
    *known, unseen = _recordings((0.95, 1.05, 1.4))
    problem, _ = weighted_by_nominal(prepare(known, MODEL))
    on = with_levels(problem, friction(problem))
    this, run = fit_nominal(on), judging_run(unseen, MODEL)
    mean = float(np.sqrt(0.95 * 1.05))
    assert level_beside(on, this, friction(on), run) == pytest.approx(1.4 / mean, rel=0.01)
    (left,) = on.on([run]).residuals(this.vector, this.active)
    (at_the_mean,) = problem.on([run]).residuals(this.vector[: _core.parameter_count()], this.active)
    noise = on.noise["speed"].level
    assert np.std(left["speed"]) < 1.2 * noise
    assert np.std(at_the_mean["speed"]) > 2.0 * noise


def test_a_level_of_a_recording_that_nothing_fits_is_not_pursued() -> None:
    """The likelihood of a recording of no motion depends on no friction: the prior's mean stays."""
    *known, unseen = _recordings((0.95, 1.05, 1.0))
    problem, _ = weighted_by_nominal(prepare(known, MODEL))
    on = with_levels(problem, friction(problem))
    run = judging_run(unseen, MODEL)
    nothing = np.zeros_like(run.input)
    still = replace(run, input=nothing, speed=nothing, current=nothing)
    assert level_beside(on, fit_nominal(on), friction(on), still) == 1.0
