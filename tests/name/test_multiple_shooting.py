"""The search in short windows, where a free run is far off."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from ranked import ranked
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.unknown import prior_cost
from rwn.name.multiple_shooting import fitted_in_windows, fitted_to_free_run, has_lost_the_motion, is_far_off
from rwn.name.ranking import Ranking

pytestmark = pytest.mark.slow
STICKING = {"stribeck-friction": {"coulomb_torque": 0.045, "static_torque": 0.77, "stribeck_speed": 6.5}}
COGGING = {"cogging-torque": {"amplitude": 0.117, "periods_per_rev": 5.0, "phase": 0.5}}
NAMES = ["stribeck-friction", "cogging-torque", "coulomb-friction", "constant-load", "unbalance", "load-spring",
         "resistance-heating", "magnetic-saturation"]  # fmt: skip
MODEL = rwn.Model(
    kind="dc",
    parameters={
        "resistance": 0.83, "inductance": 1.6e-3, "torque_constant": 0.125, "back_emf_constant": 0.125,
        "inertia": 4.6e-4, "viscous_friction": 1e-4, "coulomb_friction": 0.045,
    },
    uncertainty={
        "resistance": 0.1, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 0.1, "viscous_friction": 0.7,
        "coulomb_friction": 0.3,
    },
)  # fmt: skip
TRUE = {"resistance": 0.77, "inertia": 5e-4, "coulomb_friction": 0.0}


@pytest.fixture(scope="module")
def problem() -> Problem:
    """Of a shaft that sticks, slips and cogs: where it comes to rest depends on little."""
    t, rng = 1e-3 * np.arange(2000), np.random.default_rng(4)
    tones = zip((4.0, 3.0, 2.0), rng.uniform(0.4, 6.0, 3), rng.uniform(0.0, 6.0, 3), strict=True)
    voltage = np.clip(sum(a * np.sin(2 * np.pi * f * t + p) for a, f, p in tones), -5.4, 5.4)
    truth = rwn.Model(kind="dc", parameters={**MODEL.parameters, **TRUE}, effects={**STICKING, **COGGING})
    found = rwn.simulate(truth, rwn.Recording(name="given", time=t, signals={"voltage": voltage})).signals
    noisy = {s: found[s] + rng.normal(0.0, 2e-3 * np.std(found[s]), t.size) for s in ("current", "speed", "position")}
    return prepare([rwn.Recording(name="sticking", time=t, signals={"voltage": voltage, **noisy})], MODEL)


@pytest.fixture(scope="module")
def ranking(problem: Problem) -> Ranking:
    return ranked(problem, NAMES)


def test_effects_are_found_though_the_free_run_of_each_has_lost_the_motion(ranking: Ranking) -> None:
    assert set(ranking.fits[0].added) == {*STICKING, *COGGING}
    assert ranking.left.at_the_floor
    assert not is_far_off(ranking.problem, ranking.fits[0].fit)
    alone = min(ranking.alone.fits, key=lambda f: f.cost)
    assert has_lost_the_motion(ranking.alone.problem, alone)
    assert {f.added for f in ranking.alone.windowed} >= {("stribeck-friction",), ("cogging-torque",)}


def test_what_is_known_of_windows_is_not_fitted_there_again(ranking: Ranking) -> None:
    problem, nominal = ranking.alone.problem, ranking.alone.nominal_fit
    singles = fitted_in_windows(problem, nominal, ["stribeck-friction", "constant-load"], 1)
    pairs = fitted_in_windows(problem, nominal, ["cogging-torque"], 2, singles)
    assert {f.added for f in singles} == {("stribeck-friction",), ("constant-load",)}
    assert [f.added for f in pairs] == [("stribeck-friction", "cogging-torque")]
    assert fitted_in_windows(problem, nominal, NAMES, 2, [*singles, *pairs]) == []


def test_each_number_of_effects_has_its_best_fitted_to_the_free_run(ranking: Ranking) -> None:
    problem, singles = ranking.alone.problem, ranking.alone.windowed
    pairs = fitted_in_windows(problem, ranking.alone.nominal_fit, ["cogging-torque"], 2, singles)
    again = fitted_to_free_run([*singles, *pairs], problem)
    assert {len(f.added) for f in again} == {1, 2}
    for this in again:
        free, sheet = problem.error(this.vector, this.active), prior_cost(this.hypothesis.unknowns, this.minimum.values)
        assert this.cost == pytest.approx(free + problem.inflation * sheet)


def test_windows_are_not_judged_by_whether_they_lose_the_motion(problem: Problem, ranking: Ranking) -> None:
    assert is_far_off(problem, ranking.nominal_fit)
    assert not is_far_off(problem.in_windows(), ranking.nominal_fit)
