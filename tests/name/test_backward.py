"""Simpler explanations: which law stands for which."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.fit.fit import Fit, fit_nominal
from rwn.fit.preparation import prepare
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
