"""What a name leaves is looked at once more: a curve there says that the law is another one."""

from __future__ import annotations

import pytest

import rwn
from made_up_motor import MOTOR, recorded
from rwn.decide import verdict
from rwn.decide.other_law import other_law
from rwn.fit.preparation import prepare
from rwn.model.model import Model
from rwn.name.forward import rank
from rwn.name.ranking import Ranking

NOMINAL = Model(
    kind="dc",
    parameters={**MOTOR, "inertia": 3.2e-4, "resistance": 0.78},
    uncertainty={"resistance": 0.05, "inertia": 0.1, "viscous_friction": 0.3, "torque_constant": 0.03},
)


def drag(power: int) -> Ranking:
    """A motor whose drag grows with a power of its speed, explained with quadratic drag at hand."""
    runs = [recorded(seed, lambda w, _: -0.03 * w * abs(w / 90.0) ** (power - 1) / 90.0) for seed in range(2)]
    return rank(prepare(runs, NOMINAL), progress=lambda *_: None, names=["quadratic-drag"])


@pytest.mark.slow
@pytest.mark.parametrize(("power", "seen"), [(2, ""), (3, "a torque over speed")])
def test_a_cubic_drag_is_not_sure_to_be_a_quadratic_one(power: int, seen: str) -> None:
    ranking = drag(power)
    chosen = ranking.fits[0]
    assert chosen.added == ("quadratic-drag",)
    place = other_law(ranking, chosen, NOMINAL)
    assert (place.words if place else "") == seen


def test_a_name_that_leaves_another_law_is_not_given_as_sure() -> None:
    ranking = drag(2)
    assert verdict.whole(ranking, ranking.fits[0]) == 1.0
    assert verdict.whole(ranking, ranking.fits[0], another=True) == verdict.ANOTHER < 0.5


@pytest.mark.slow
def test_the_report_says_that_a_name_may_only_be_the_nearest() -> None:
    runs = [recorded(seed, lambda w, _: -0.03 * (w / 90.0) ** 3) for seed in range(3)]
    said = rwn.diagnose(runs[:2], NOMINAL, heldout=runs[2:], jobs=1)
    assert [(e.name, e.probability <= verdict.ANOTHER) for e in said.effects] == [("quadratic-drag", True)]
    assert any("a torque over speed explains most of what is left" in text for text in said.warnings)
    assert any("viscous_friction went to zero" in text for text in said.warnings)
