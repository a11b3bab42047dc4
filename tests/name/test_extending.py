"""What is built upon: the best explanations, and what every drive has and a data sheet leaves out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from rwn.fit.fit import Fit, fit_nominal
from rwn.fit.problem import Problem
from rwn.name.extending import beside, left_out
from rwn.name.ranking import NO_EXTENSIONS

FitWith = Callable[[str], Fit]
WANTED = ["coulomb-friction", "asymmetric-friction", "quadratic-drag", "input-delay"]


def test_dry_friction_is_built_upon_where_the_sheet_has_none(problem: Problem, fit_with: FitWith) -> None:
    """However little it explains alone; its elaborations, and what the sheet has, only where they explain much."""
    nominal, bases = fit_nominal(problem), [fit_with("quadratic-drag")]
    assert not problem.prior.motor.get("coulomb_friction")
    found = left_out(problem, nominal, bases, WANTED)
    assert [f.added for f in found] == [("coulomb-friction",)]
    assert left_out(problem, nominal, [*found, *bases], WANTED) == []
    assert left_out(problem, nominal, bases, WANTED[1:]) == []
    known = replace(problem, prior=replace(problem.prior, motor={**problem.prior.motor, "coulomb_friction": 1e-3}))
    assert left_out(known, nominal, bases, WANTED) == []


@pytest.mark.parametrize("thorough", [1, 2])
def test_any_effect_is_tried_beside_the_first_ones(
    problem: Problem, fit_with: FitWith, monkeypatch: pytest.MonkeyPatch, thorough: int
) -> None:
    bases = [fit_with(name) for name in ("coulomb-friction", "quadratic-drag", "asymmetric-friction")]
    tried: dict[str, list[str]] = {}

    def nothing(_: Problem, base: Fit, wanted: list[str], **__: float) -> list[Fit]:
        tried[base.added[0]] = list(wanted)
        return []

    monkeypatch.setattr("rwn.name.extending.screen", nothing)
    beside(problem, bases, WANTED, bases, NO_EXTENSIONS, thorough=thorough)
    met = [name for name in WANTED if name != "input-delay"]
    assert list(tried.values()) == [WANTED, WANTED if thorough == 2 else met, met]
