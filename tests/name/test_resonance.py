"""A second mass is read off what the speed of one mass leaves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

import rwn
from made_up_motor import MOTOR
from rwn.fit.fit import fit_nominal
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.model.vocabulary import table
from rwn.name.initial_guesses.resonance import Resonance, read, resonances
from rwn.name.screening import screen
from rwn.simulate.windows import windowed

Array = NDArray[np.float64]

STEP = 1e-3


def _seen(shaft: Resonance | None, *, without: tuple[str, ...] = ()) -> Problem:
    """A motor that is driven by steps at random, with a load on a shaft; recorded with noise, but for some signals."""
    rng = np.random.default_rng(8)
    time = STEP * np.arange(4000)
    voltage = np.repeat(rng.uniform(-6.0, 6.0, 100), 40)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    names = ("stiffness", "damping", "load_inertia")
    share = {"load_viscous_share": 0.0}
    effects = {"shaft-compliance": dict(zip(names, shaft.of(MOTOR["inertia"]), strict=True)) | share} if shaft else {}
    seen = rwn.simulate(Model(kind="dc", parameters=MOTOR, effects=effects), run).signals
    kept = [s for s in ("current", "speed", "position") if s not in without]
    noisy = {s: seen[s] + 0.01 * np.std(seen[s]) * rng.standard_normal(time.size) for s in kept}
    recording = replace(run, signals={"voltage": voltage, **noisy})
    return prepare([recording], Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "resistance": 0.1}))


def _found(problem: Problem) -> list[Resonance]:
    nominal = fit_nominal(problem)
    return resonances(problem, nominal.vector, problem.residuals(nominal.vector, nominal.active))


@pytest.mark.parametrize("rate", [40.0, 200.0, 1000.0])
@pytest.mark.parametrize("behind", [0.25, 0.5])
@pytest.mark.parametrize("without", [(), ("current", "position")])
def test_a_shaft_shows_where_it_rings(rate: float, behind: float, without: tuple[str, ...]) -> None:
    first = _found(_seen(Resonance(rate, 0.05, behind), without=without))[0]
    assert first.rate == pytest.approx(rate, rel=0.1)
    assert first.behind == pytest.approx(behind, abs=0.2)  # a refitted motor has taken a part of it


def test_the_parameters_of_another_effect_are_told_by_their_units() -> None:
    problem, known = _seen(Resonance(200.0, 0.05, 0.4)), table()["shaft-compliance"]
    other = replace(known, parameters=tuple(replace(p, name=f"its_{p.name}") for p in reversed(known.parameters)))
    as_known, as_other = (read(problem, fit_nominal(problem), effect, 1) for effect in (known, other))
    assert as_known
    assert as_other == [{f"its_{name}": value for name, value in guess.items()} for guess in as_known]


def test_a_shaft_of_such_numbers_rings_so() -> None:
    stiffness, damping, load = Resonance(300.0, 0.1, 0.2).of(5e-5)
    reduced = load * (5e-5 - load) / 5e-5
    assert load == pytest.approx(1e-5)
    assert np.sqrt(stiffness / reduced) == pytest.approx(300.0)
    assert damping / (2.0 * reduced * 300.0) == pytest.approx(0.1)


def test_without_a_free_run_of_a_recorded_speed_there_is_none_to_read_off() -> None:
    shaft = Resonance(200.0, 0.05, 0.4)
    assert _found(_seen(shaft, without=("speed",))) == []
    problem = _seen(shaft)
    assert _found(replace(problem, runs=tuple(map(windowed, problem.runs)))) == []


def test_a_shaft_that_rings_long_is_found_from_its_resonance() -> None:
    """Its minimum is narrow: from half the rate or twice it a fit ends in another minimum."""
    shaft = Resonance(200.0, 0.01, 0.35)
    problem = _seen(shaft)
    found = screen(problem, fit_nominal(problem), ["shaft-compliance"])[0]
    stiffness, _, load = shaft.of(MOTOR["inertia"])
    assert found.value("shaft-compliance.stiffness") == pytest.approx(stiffness, rel=0.01)
    assert found.value("shaft-compliance.load_inertia") == pytest.approx(load, rel=0.01)
