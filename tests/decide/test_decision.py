"""What recordings that were kept back refuse, of what an account states."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rwn.decide import decision
from rwn.decide.account import Account, Acting
from rwn.decide.decision import _refused
from rwn.decide.evidence import Evidence

CERTAIN = Evidence(share=0.999, unseen=0.99, part=0.999, odds=5000.0, curve=1.0)


def refused(names: str, costs: dict[str, float], monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What stays of an explanation by `names`, step by step, where its parts have these errors on the recordings."""

    def together(_: Any, found: Account) -> Any:
        added = tuple(e.name for e in found.stated)
        return SimpleNamespace(added=added, final=costs["".join(added)])

    def compared(_: Any, before: float, after: float, *rest: Any, **options: Any) -> float:
        assert rest == (runs,)
        assert options == {"seed": 0}
        return after - before

    monkeypatch.setattr(decision, "_together", together)
    monkeypatch.setattr(decision, "compared", compared)
    monkeypatch.setattr(decision, "hurts", lambda rows: not rows <= 0.0)
    monkeypatch.setattr(decision, "log_change", lambda rows: rows)
    effects = tuple(Acting(name=n, probability=0.9, together=0.9, share=0.5, evidence=CERTAIN) for n in names)
    found: Any = Account(effects=effects, leading=None)  # type: ignore[arg-type]
    runs: Any = ["kept back"]
    chosen, stayed = together(None, found), []
    while step := _refused(None, chosen, found, runs, seed=0):  # type: ignore[arg-type]
        found, chosen = step
        stayed.append("".join(chosen.added))
        assert [e.name for e in found.effects] == list(names), "it is in the account with probability 0"
    return stayed


def test_what_helps_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    assert refused("ab", {"": 9.0, "a": 5.0, "b": 6.0, "ab": 1.0}, monkeypatch) == []


def test_the_part_that_hurts_most_goes_and_then_what_still_does(monkeypatch: pytest.MonkeyPatch) -> None:
    costs = {"": 9.0, "a": 1.0, "b": 8.0, "c": 8.0, "ab": 2.0, "ac": 3.0, "bc": 7.0, "abc": 4.0}
    assert refused("abc", costs, monkeypatch) == ["a"]
    assert refused("abc", costs | {"a": 3.5}, monkeypatch) == ["ab"]


def test_two_that_hurt_together_alone_go_together(monkeypatch: pytest.MonkeyPatch) -> None:
    assert refused("ab", {"": 1.0, "a": 5.0, "b": 6.0, "ab": 2.0}, monkeypatch) == [""]


def test_of_what_runs_away_only_what_does_it_goes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the first of two effects the motion still runs away: that says nothing against the first."""
    costs = {"": 9.0, "a": 5.0, "b": np.inf, "ab": np.inf}
    assert refused("ab", costs, monkeypatch) == ["a"]


def test_nothing_is_refused_where_nothing_was_kept_back() -> None:
    this: Any = SimpleNamespace(added=("a",))
    assert _refused(this, this, this, [], seed=0) is None
