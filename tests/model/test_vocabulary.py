"""The table of effects that the core describes."""

from __future__ import annotations

import re

import pytest

from rwn.model.vocabulary import Effect, table


@pytest.mark.parametrize("effect", table().values(), ids=lambda e: e.name)
def test_every_parameter_is_found_in_the_equation(effect: Effect) -> None:
    for p in effect.parameters:
        if p.symbol:
            assert re.search(rf"(?<!\w){re.escape(p.symbol)}(?!\w)", effect.equation), (p.name, p.symbol)
        else:
            assert p.idealised  # what stands for rigid or abrupt: the equation does without it
