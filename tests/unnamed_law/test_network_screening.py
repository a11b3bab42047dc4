"""Which curve promises most is seen without a simulation."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from made_up_motor import MOTOR, recorded
from rwn.fit.fit import fit_nominal
from rwn.fit.preparation import prepare
from rwn.model.model import Model
from rwn.unnamed_law.network_formula import basis_at, parts_of
from rwn.unnamed_law.place_screening import most_promising
from rwn.unnamed_law.places import all_places, states_of

SHEET = Model(kind="dc", parameters=MOTOR, uncertainty={"viscous_friction": 0.3, "inertia": 0.1})
LAWS: dict[str, Callable[[float, float], float]] = {
    "a torque over position": lambda _, angle: -2e-3 * angle,
    "a torque over angle": lambda _, angle: 0.02 * np.cos(2.0 * angle),
    "a viscous friction over angle": lambda w, angle: -2e-4 * w * np.cos(angle),
    "a torque over speed": lambda w, _: -0.03 * (w / 90.0) ** 3,
    "a dry friction over angle": lambda w, angle: -0.02 * (1.0 + 0.5 * np.cos(angle)) * float(np.sign(w)),
}


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.slow
def test_the_place_of_the_law_is_among_the_first(law: str) -> None:
    problem = prepare([recorded(3, LAWS[law])], SHEET)
    first = most_promising(problem, fit_nominal(problem), all_places(problem, SHEET), 7)
    assert law in {place.words for place in first}


def test_the_numbers_are_those_of_the_formulas() -> None:
    problem = prepare([recorded(3, LAWS["a torque over speed"])], SHEET)
    for place in all_places(problem, SHEET):
        if place.factor or place.term != "torque":
            continue
        x = states_of(problem, place)
        (part,), (shapes,) = parts_of(problem, SHEET, place, 7), basis_at(place, [x], 7)
        for k in range(7):
            values = {f"w{j}": float(j == k) for j in range(7)} | {place.state: x}
            values |= {p.name: p.start for p in part.parameters if p.fixed}
            np.testing.assert_allclose(np.broadcast_to(part.formula.evaluate(values), x.shape), shapes[:, k], atol=1e-3)
