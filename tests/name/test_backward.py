"""Simpler explanations: which law stands for which."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import rwn
from rwn.fit.fit import Fit, fit_nominal
from rwn.fit.preparation import prepare
from rwn.name import backward
from rwn.name.backward import elaborations, family, plainer
from rwn.name.screening import screen


def test_friction_is_made_plain_and_a_general_law_special() -> None:
    assert plainer(["stribeck-friction", "power-law-drag", "backlash"]) == {
        "coulomb-friction",
        "quadratic-drag",
        "backlash",
    }
    assert {"stribeck-friction", "power-law-drag"} <= set(elaborations())
    assert not {"coulomb-friction", "quadratic-drag", "backlash"} & set(elaborations())


def test_a_family_is_what_is_the_same_made_plain() -> None:
    assert family("quadratic-drag") == family("power-law-drag") == {"quadratic-drag", "power-law-drag"}
    assert {"coulomb-friction", "asymmetric-friction", "stribeck-friction"} <= family("asymmetric-friction")
    assert family("backlash") == {"backlash"}
    assert family("eddy-brake") == {"eddy-brake"}


def test_an_effect_of_a_users_own_stays_what_it_is() -> None:
    assert plainer(["eddy-brake"]) == {"eddy-brake"}


def test_what_begins_without_a_friction_law_begins_with_friction_as_large(fit_with: Callable[[str], Fit]) -> None:
    """Of an uncertain friction of the nominal model; one that the model does not have stays away."""
    folder = Path(rwn.__file__).parent / "demo"
    model = rwn.read_model(folder / "model.toml")
    declared = replace(
        model, parameters={**model.parameters, "coulomb_friction": 0.002},
        uncertainty={**model.uncertainty, "coulomb_friction": 1.0},
    )  # fmt: skip
    problem = prepare([rwn.read_recording(folder / "train.csv", layout=model.recording)], declared)
    two_levels = screen(problem, fit_nominal(problem), ["asymmetric-friction"])[0]
    levels = list(two_levels.values_of("asymmetric-friction").values())
    assert two_levels.motor["coulomb_friction"] == pytest.approx(np.mean(levels))
    assert two_levels.motor["coulomb_friction"] > 2.0 * 0.002
    assert "coulomb_friction" not in fit_with("asymmetric-friction").motor


def test_simpler_ones_of_a_simpler_one_are_tried_where_both_leave_noise(monkeypatch: pytest.MonkeyPatch) -> None:
    """What costs least has most effects then; two of them have to go before the plain one is met."""

    def made(names: str, cost: float) -> Any:
        return SimpleNamespace(added=tuple(names), cost=cost, unknowns_seen=5 + 2 * len(names))

    tried: list[str] = []

    def simpler(_: Any, best: Any) -> list[Any]:
        tried.append("".join(best.added))
        return [made("".join(best.added)[:-1], best.cost + 3.0)]

    monkeypatch.setattr(backward, "_simpler", simpler)
    monkeypatch.setattr(backward, "distinct", list)
    problem: Any = SimpleNamespace(samples=1000)
    nominal, fits = made("", 9000.0), [made("abcd", 1000.0), made("ab", 1006.0)]
    found = backward.with_simpler(problem, nominal, fits)
    assert tried == ["ab", "a"]
    assert "a" in ["".join(f.added) for f in found]
