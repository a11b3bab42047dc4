"""The stated explanation, weighed beside its alternatives."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from rwn.report import assemble
from rwn.report.diagnosis_data import Alternative

BOTH = SimpleNamespace(added=("coulomb-friction", "unbalance"), probability=0.8)
ONE = SimpleNamespace(added=("coulomb-friction",), probability=0.1)


def _decision(verdict: str, chosen: Any) -> Any:
    return SimpleNamespace(verdict=verdict, chosen=chosen)


@pytest.mark.parametrize("chosen", [BOTH, ONE])
def test_what_is_stated_has_the_probability_that_it_is_ranked_by(chosen: Any) -> None:
    stated = assemble._explanation(_decision("missing-physics", chosen))
    assert stated == Alternative(effects=chosen.added, probability=chosen.probability)


def test_where_nothing_is_stated_there_is_none() -> None:
    assert assemble._explanation(_decision("unexplained", ONE)) is None
