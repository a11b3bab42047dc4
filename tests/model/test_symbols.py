"""The symbols of parameters are those of the equations."""

from __future__ import annotations

import re

import pytest

from rwn.model.symbols import symbol_of
from rwn.model.vocabulary import Effect, table

WITHOUT = {("backlash", "contact_rate"), ("backlash", "contact_damping_ratio")}  # these make its stiffness and damping


@pytest.mark.parametrize("effect", table().values(), ids=lambda e: e.name)
def test_every_parameter_is_found_in_the_equation(effect: Effect) -> None:
    for p in effect.parameters:
        symbol = symbol_of(effect.name, p.name)
        if (effect.name, p.name) in WITHOUT:
            assert not symbol
        else:
            assert re.search(rf"(?<![\w]){re.escape(symbol)}(?!\w)", effect.equation), (p.name, symbol)
            assert symbol
