"""Simpler explanations: which law stands for which."""

from __future__ import annotations

from rwn.name.backward import elaborations, family, plainer


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
