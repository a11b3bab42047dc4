"""What a name leaves is looked at once more: a curve there says that the law is another one."""

from __future__ import annotations

import pytest

import rwn
from made_up_motor import MOTOR, recorded
from ranked import ranked_from
from rwn.decide.other_law import curve_beside
from rwn.model.model import Model
from rwn.name.ranking import Ranking

NOMINAL = Model(
    kind="dc",
    parameters={**MOTOR, "inertia": 3.2e-4, "resistance": 0.78},
    uncertainty={"resistance": 0.05, "inertia": 0.1, "viscous_friction": 0.3, "torque_constant": 0.03},
)


def drag(power: int) -> Ranking:
    """A motor whose drag grows with a power of its speed, explained with quadratic drag at hand."""
    runs = [
        recorded(seed, lambda w, _: -0.03 * w * abs(w / 90.0) ** (power - 1) / 90.0, samples=1200) for seed in range(2)
    ]
    return ranked_from(runs, NOMINAL, ["quadratic-drag"])


@pytest.mark.slow
@pytest.mark.parametrize(("power", "seen"), [(2, ""), (3, "a torque over speed")])
def test_a_cubic_drag_is_not_sure_to_be_a_quadratic_one(power: int, seen: str) -> None:
    ranking = drag(power)
    chosen = ranking.fits[0]
    assert chosen.added == ("quadratic-drag",)
    curve = curve_beside(ranking.problem, chosen.fit, NOMINAL)
    assert curve is not None
    assert (curve.place.words if curve.is_a_law else "") == seen


@pytest.mark.slow
def test_a_cubic_drag_is_named_by_its_power() -> None:
    runs = [recorded(seed, lambda w, _: -0.03 * (w / 90.0) ** 3) for seed in range(3)]
    said = rwn.diagnose(runs[:2], NOMINAL, heldout=runs[2:], jobs=1)
    assert [e.name for e in said.effects] == ["power-law-drag"]
    low, high = said.effects[0].parameters["exponent"].interval or (0.0, 0.0)
    assert low < 3.0 < high < low + 0.1
    assert not any("has no name" in warning for warning in said.warnings)
