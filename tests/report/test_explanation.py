"""The stated explanation, weighed beside its alternatives."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rwn.report import assemble
from rwn.report.diagnosis_data import Alternative

BOTH = SimpleNamespace(added=("coulomb-friction", "unbalance"), probability=0.8, final=None)
ONE = SimpleNamespace(added=("coulomb-friction",), probability=0.1, final=None)


def _decision(verdict: str, chosen: Any) -> Any:
    ranking = SimpleNamespace(fits=(BOTH, ONE), counted=None)
    return SimpleNamespace(
        verdict=verdict, ranking=ranking, chosen=chosen, account=SimpleNamespace(leading=BOTH)
    )


@pytest.mark.parametrize("chosen", [BOTH, ONE])
def test_what_is_stated_has_the_probability_that_it_is_ranked_by(chosen: Any) -> None:
    stated = assemble._explanation(_decision("missing-physics", chosen))
    assert stated == Alternative(effects=chosen.added, probability=chosen.probability)


def test_what_was_fitted_for_this_alone_is_weighed_against_the_leading_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(assemble, "log_odds", lambda *_: np.log(4.0))
    part = SimpleNamespace(added=("unbalance",), probability=0.8, final=None)  # the leading one's
    stated = assemble._explanation(_decision("missing-physics", part))
    assert stated is not None
    assert stated.probability == pytest.approx(0.2)


def test_where_nothing_is_stated_there_is_none() -> None:
    assert assemble._explanation(_decision("unexplained", ONE)) is None
