"""What is stated of an account."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import pytest

from rwn.decide import decision
from rwn.decide.account import Account, ActingEffect


@dataclass(frozen=True)
class _Ranking:
    at_a_limit: tuple[Any, ...] = ()


def _fit(names: set[str]) -> Any:
    """A gain curve whose exponent is within its limits beside cogging alone."""
    bent = "amplifier-gain-curve" in names and "cogging-torque" not in names
    met = ("amplifier-gain-curve.exponent",) if bent else ()
    return SimpleNamespace(fit=SimpleNamespace(added=tuple(sorted(names)), limits_met=met))


ALL = ("amplifier-gain-curve", "coulomb-friction", "cogging-torque")
BENT = [("amplifier-gain-curve", "coulomb-friction")]


@pytest.mark.parametrize(("cogging", "stated", "bent"), [(0.4, ("coulomb-friction",), BENT), (0.8, ALL, [])])
def test_a_law_that_runs_into_a_limit_without_the_rest_is_not_stated(
    monkeypatch: pytest.MonkeyPatch, cogging: float, stated: tuple[str, ...], bent: list[tuple[str, ...]]
) -> None:
    probability = {"amplifier-gain-curve": 0.76, "coulomb-friction": 0.9, "cogging-torque": cogging}
    rows: Any = [
        ActingEffect(name=name, probability=p, together=p, share=0.5, evidence=SimpleNamespace())  # type: ignore[arg-type]
        for name, p in probability.items()
    ]
    monkeypatch.setattr(decision, "together", lambda _ranking, _leading, names: _fit(names))
    leading: Any = None
    ranking, found, chosen = decision._stated(_Ranking(), Account(effects=tuple(rows), leading=leading))  # type: ignore[arg-type]
    assert tuple(e.name for e in found.stated) == stated
    assert chosen.fit.added == tuple(sorted(stated))
    assert [f.added for f in ranking.at_a_limit] == bent
