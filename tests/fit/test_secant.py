"""Fits where a contact makes the error rough."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from rwn.correct.corrected_model import IDEALISED, estimates
from rwn.fit.fit import Fitted
from rwn.fit.hypothesis import Candidate, candidate, fit
from rwn.fit.preparation import prepare
from rwn.fit.problem import OutputError
from rwn.fit.secant import rough, settled
from rwn.model.model import Model
from rwn.name.screening import Search

MOTOR = {"resistance": 1.1, "inductance": 4e-4, "torque_constant": 0.037, "back_emf_constant": 0.037,
         "inertia": 2.8e-5, "viscous_friction": 4e-6}  # fmt: skip
PLAY = {"gap": 0.02, "load_inertia": 1e-5, "contact_rate": 950.0, "contact_damping_ratio": 0.25}


@pytest.fixture(scope="module")
def search() -> Search:
    rng = np.random.default_rng(11)
    time = 5e-4 * np.arange(3000)
    true = Model(kind="dc", parameters=MOTOR, effects={"backlash": PLAY})
    voltage = 4.0 * np.repeat(rng.uniform(-1.0, 1.0, 60), 50)
    seen = rwn.simulate(true, rwn.Recording(name="play.csv", time=time, signals={"voltage": voltage})).signals
    noisy = {s: seen[s] + 0.01 * np.std(seen[s]) * rng.standard_normal(time.size) for s in ("current", "speed")}
    recording = rwn.Recording(name="play.csv", time=time, signals={"voltage": voltage, **noisy})
    return Search.of(prepare([recording], Model(kind="dc", parameters=MOTOR)))


def _start(search: Search, name: str, values: dict[str, float]) -> tuple[OutputError, Candidate]:
    return search.problem, candidate(search.nominal, (name,), search.scales, {name: values})


def test_turns_without_derivatives_reach_what_derivatives_do_not(search: Search) -> None:
    problem, this = _start(search, "backlash", {**PLAY, "gap": 0.15, "contact_rate": 3000.0})
    stopped = fit(problem, this)
    found = settled(problem, this, stopped, turns=3)
    k = [u.name for u in this.unknowns].index("backlash.gap")
    assert stopped.values[k] != pytest.approx(PLAY["gap"], rel=0.05)
    assert found.values[k] == pytest.approx(PLAY["gap"], rel=0.01)
    assert found.cost < stopped.cost


def test_derivatives_find_a_gap_from_three_times_its_size(search: Search) -> None:
    problem, this = _start(search, "backlash", {**PLAY, "gap": 0.06, "contact_rate": 1500.0})
    found = this.with_values(fit(problem, this).values)
    for unknown in this.unknowns:
        if unknown.name.startswith("backlash."):
            assert found[unknown.index] == pytest.approx(PLAY[unknown.name.removeprefix("backlash.")], rel=0.01)


def test_a_smooth_error_is_left_to_derivatives(search: Search) -> None:
    problem, this = _start(search, "coulomb-friction", {"coulomb_torque": 1e-3})
    assert rough(this) == []
    stopped = fit(problem, this)
    assert settled(problem, this, stopped, turns=3) is stopped


def test_a_turn_never_loses(search: Search) -> None:
    problem, this = _start(search, "backlash", PLAY)
    best = fit(problem, this, max_iterations=0)
    assert settled(problem, this, best, turns=1).cost <= best.cost


def test_no_interval_of_a_contact_is_narrower_than_the_contact_is_exact(search: Search) -> None:
    problem, this = _start(search, "backlash", PLAY)
    fitted = Fitted(added=("backlash",), candidate=this, minimum=fit(problem, this))
    found = estimates(fitted, 1.0, 1.0)
    gap = found["backlash.gap"]
    assert gap.interval is not None
    assert gap.interval[0] < PLAY["gap"] < gap.interval[1]
    assert np.log(gap.interval[1] / gap.interval[0]) > 2 * 1.96 * IDEALISED
