"""A plainer effect in the place of one of several."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from rwn.model.vocabulary import table
from rwn.name import replacement

Asked = list[tuple[tuple[str, ...], list[str]]]

WANTED = ["input-delay", "quadratic-drag", "load-disturbance", "backlash", "shaft-compliance"]


def _fit(*added: str, cost: float) -> Any:
    return SimpleNamespace(
        added=added, cost=cost, unknowns_seen=sum(len(table()[name].parameters) for name in added),
        hypothesis=SimpleNamespace(table=table()),
    )  # fmt: skip


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> Asked:
    """What is tried, beside which effects; a delay is found to do as well."""
    seen: Asked = []

    def screen(_problem: Any, base: Any, names: list[str], *, keep: int, best: float) -> list[Any]:
        assert (keep, best) == (1, 100.0)
        seen.append((base.added, names))
        return [_fit(*base.added, name, cost=99.0) for name in names if name == "input-delay"]

    monkeypatch.setattr(replacement, "screen", screen)
    monkeypatch.setattr(replacement, "affordable", lambda _problem, _base, names, _known: names[:-1])
    monkeypatch.setattr(replacement, "affords_more", lambda _work: True)
    monkeypatch.setattr(replacement, "one_stage", lambda _work: 1.0)
    monkeypatch.setattr(replacement, "renew", lambda work, begun: seen.append(((work,), [str(begun)])))
    return seen


def test_those_of_fewer_parameters_are_tried_in_the_place_of_each(asked: Asked) -> None:
    problem: Any = SimpleNamespace(samples=1000, work="the meter")
    fits = [
        _fit("coulomb-friction", "shaft-compliance", cost=100.0), _fit("coulomb-friction", cost=500.0),
        _fit("shaft-compliance", cost=400.0), _fit("backlash", "load-disturbance", "input-delay", cost=98.0),
    ]  # fmt: skip
    found = replacement.with_plainer_instead(problem, fits, WANTED, begun=7)
    # friction has one parameter: nothing is plainer; a gap idealises its contact, whose parameters do not count, but is
    # the last of them and not paid for
    plainer = ["input-delay", "quadratic-drag", "load-disturbance"]
    assert asked == [(("the meter",), ["7"]), (("coulomb-friction",), plainer)]
    assert ("coulomb-friction", "input-delay") in {f.added for f in found}
    assert {f.added for f in fits} < {f.added for f in found}


@pytest.mark.parametrize("fits", [[], [_fit("shaft-compliance", cost=1.0)]], ids=["nothing", "one"])
def test_one_effect_has_been_tried_against_all_others(fits: list[Any], asked: Asked) -> None:
    problem: Any = SimpleNamespace(samples=1000, work=None)
    assert replacement.with_plainer_instead(problem, fits, WANTED, begun=7) == fits
    assert not asked
