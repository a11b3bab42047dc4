"""A data sheet that is wrong in one value, beneath missing physics and without."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from ranked import ranked_from
from rwn.faults.data_sheet import confirmed, contradicted, without_declared
from rwn.model.model import Model
from rwn.name.ranking import Ranking
from rwn.search.search import search

MOTOR = {"resistance": 2.0, "inductance": 1.5e-3, "torque_constant": 0.05, "back_emf_constant": 0.05,
         "inertia": 3e-5, "viscous_friction": 3e-5}  # fmt: skip
DECLARED = {"inertia": 0.1, "resistance": 0.05, "torque_constant": 0.05, "back_emf_constant": 0.05,
            "viscous_friction": 0.5}  # fmt: skip


def _runs(seed: int, effects: dict[str, dict[str, float]]) -> list[rwn.Recording]:
    """Voltage and speed under random steps and under a sweep."""
    rng, time = np.random.default_rng(seed), 1e-3 * np.arange(1000)
    truth, made = Model(kind="dc", parameters=MOTOR, effects=effects), []
    voltages = (np.repeat(rng.uniform(-10.0, 10.0, 10), 100), 8.0 * np.sin(2 * np.pi * (time + 1.2 * time**2)))
    for name, voltage in zip(("steps", "sweep"), voltages, strict=True):
        bare = rwn.Recording(name=name, time=time, signals={"voltage": voltage})
        speed = rwn.simulate(truth, bare).signals["speed"]
        noisy = speed + 2e-3 * np.std(speed) * rng.standard_normal(time.size)
        made.append(rwn.Recording(name=name, time=time, signals={"voltage": voltage, "speed": noisy}))
    return made


def _sheet(**off: float) -> Model:
    return Model(kind="dc", parameters={n: v * off.get(n, 1.0) for n, v in MOTOR.items()}, uncertainty=DECLARED)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("off", "effects", "named", "effort"),  # one with all that a search tries, the others with single effects
    [
        ({"inertia": 5.0}, {"coulomb-friction": {"coulomb_torque": 6e-3}}, "coulomb-friction", 1.0),
        ({"inertia": 0.3}, {"quadratic-drag": {"drag_coefficient": 1.5e-6}}, "quadratic-drag", 0.3),
        ({"resistance": 0.4}, {"coulomb-friction": {"coulomb_torque": 6e-3}}, "coulomb-friction", 0.3),
    ],
    ids=["5 times the inertia", "0.3 times the inertia", "0.4 times the resistance"],
)
def test_a_wrong_data_sheet_is_said_first_and_bends_no_parameter(
    off: dict[str, float], effects: dict[str, dict[str, float]], named: str, effort: float
) -> None:
    found = rwn.diagnose(_runs(101, effects), _sheet(**off), jobs=1, effort=effort)
    ((name, factor),) = off.items()
    assert [e.name for e in found.effects] == [named]
    assert str(found).startswith(f"Data sheet and recordings contradict each other in {name}")
    assert found.corrected.parameters[name] == pytest.approx(MOTOR[name], rel=0.03)
    assert found.warnings[0].startswith(f"data sheet and recordings contradict each other in {name}")
    assert found.corrected.uncertainty[name] == DECLARED[name]
    assert found.nominal_fit.parameters[name].nominal == pytest.approx(factor * MOTOR[name])


def test_a_sound_data_sheet_is_not_contradicted_by_what_physics_explains() -> None:
    names = ["coulomb-friction", "actuator-deadzone"]
    runs = _runs(102, {"coulomb-friction": {"coulomb_torque": 6e-3}})
    ranking = ranked_from(runs, _sheet(), names)
    assert ranking.nominal_fit.farthest_move > 0.0
    assert contradicted(ranking) == []


def test_a_value_that_comes_back_once_it_is_free_was_right() -> None:
    """As where another effect had pulled it away."""
    runs, names = _runs(103, {}), ["coulomb-friction"]

    def ranked(model: Model) -> Ranking:
        return ranked_from(runs, model, names)

    sound, wrong = _sheet(), _sheet(inertia=3.0)
    free = without_declared(sound, {"inertia"})
    assert np.isinf(free.uncertainty["inertia"])
    assert not confirmed(ranked(free), ranked(sound), sound, {"inertia"})
    assert confirmed(ranked(without_declared(wrong, {"inertia"})), ranked(wrong), wrong, {"inertia"})


def test_both_constants_of_a_motor_are_doubted_together() -> None:
    ranking = ranked_from(_runs(104, {}), _sheet(torque_constant=2.0, back_emf_constant=2.0), ["coulomb-friction"])
    assert contradicted(ranking)[0] == {"torque_constant", "back_emf_constant"}


def test_a_sound_sheet_is_searched_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rwn.search.search.confirmed", lambda *_: pytest.fail("nothing was doubted"))
    found = search(_runs(105, {}), _sheet(), late=(), say=lambda *_: None, effort=0.1)
    assert not found.ranking.fits[0].added
