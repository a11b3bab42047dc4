"""The table of effects that the core describes."""

from __future__ import annotations

import math
import re

import pytest

from rwn.model.vocabulary import Effect, analog_filters, table


@pytest.mark.parametrize("effect", table().values(), ids=lambda e: e.name)
def test_every_parameter_is_found_in_the_equation(effect: Effect) -> None:
    for p in effect.parameters:
        if p.symbol:
            assert re.search(rf"(?<!\w){re.escape(p.symbol)}(?!\w)", effect.equation), (p.name, p.symbol)
        else:
            assert p.idealised  # what stands for rigid or abrupt: the equation does without it


@pytest.mark.parametrize("effect", table().values(), ids=lambda e: e.name)
def test_a_special_case_starts_from_the_general_law(effect: Effect) -> None:
    values = {p.name: p.start for p in effect.parameters}
    if not effect.special_case:
        with pytest.raises(ValueError, match=f"no special case of {effect.name}"):
            effect.as_special_case(values)
        return
    special = table()[effect.special_case]
    found = effect.as_special_case(values)
    assert list(found) == [p.name for p in special.parameters]
    assert all(math.isfinite(value) for value in found.values())


def test_the_table_says_what_the_stages_treat_by_itself() -> None:
    """By a trait: no stage knows an effect by name (tests/test_walls.py)."""
    effects = table()
    having = {
        "steady": {"constant-load"},
        "holds": {"coulomb-friction", "stribeck-friction", "actuator-deadzone"},
        "rectifies": {"sensor-rectification"},
        "delays": {"input-delay"},
        "jumps": {"sensor-quantization"},
    }
    for trait, known in having.items():
        found = {name for name, effect in effects.items() if getattr(effect, trait)}
        assert known <= found < set(effects), trait
    lags = {signal: effect.name for signal, effect in analog_filters(effects).items()}
    assert {"speed": "speed-sensor-lag", "current": "current-sensor-lag"}.items() <= lags.items()
    beside = [(e.name, p.beside) for e in effects.values() for p in e.parameters if p.beside]
    assert ("viscous-friction", "viscous_friction") in beside


def test_a_drag_of_the_second_power_is_quadratic() -> None:
    law = table()["power-law-drag"]
    assert law.special_case == "quadratic-drag"
    found = law.as_special_case({"drag_torque": 0.02, "exponent": 2.0, "reference_speed": 50.0})
    assert found == {"drag_coefficient": pytest.approx(0.02 / 50.0**2, rel=1e-15)}
