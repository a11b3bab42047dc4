"""What is stated of an account."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any, cast

import pytest

from rwn.decide import decision
from rwn.decide.account import Account, ActingEffect
from rwn.decide.calibration import ACTS
from rwn.fit.intervals import Estimate
from rwn.model.vocabulary import table


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
    monkeypatch.setattr(decision, "_maybe_absent", lambda *_: [])
    leading: Any = None
    ranking, found, chosen = decision._stated(_Ranking(), Account(effects=tuple(rows), leading=leading))  # type: ignore[arg-type]
    assert tuple(e.name for e in found.stated) == stated
    assert chosen.fit.added == tuple(sorted(stated))
    assert [f.added for f in ranking.at_a_limit] == bent


INTERVALS = {
    # strengths that two loads leave each other, and what each has alone
    ("constant-load", "load-disturbance"): {
        "constant-load.torque": (-1.0, 2.0),
        "load-disturbance.torque": (-2.0, 1.0),
    },
    ("constant-load",): {"constant-load.torque": (0.5, 1.0)},
    ("asymmetric-friction",): {
        "asymmetric-friction.coulomb_torque_plus": (0.0, 1.0),
        "asymmetric-friction.coulomb_torque_minus": (0.3, 0.8),
    },
    ("stribeck-friction",): {"stribeck-friction.static_torque": (0.0, 1.0)},
    ("backlash",): {"backlash.gap": (0.0, 1.0)},
    ("quadratic-drag",): {"quadratic-drag.drag_coefficient": (0.0, 1.0)},
    ("constant-load", "quadratic-drag"): {
        "quadratic-drag.drag_coefficient": (0.3, 0.7),
        "constant-load.torque": (-1.0, 1.0),
    },
}


@pytest.mark.parametrize(
    ("named", "stated"),
    [
        (("constant-load", "load-disturbance"), ("constant-load",)),  # the one that removes less goes first
        (("asymmetric-friction",), ("asymmetric-friction",)),  # one of its strengths is there
        (("stribeck-friction",), ()),
        (("backlash",), ("backlash",)),  # a gap is no strength: it has a limit above zero
        (("quadratic-drag",), ("quadratic-drag",)),  # with a load that is not stated it is there
    ],
)
def test_what_may_as_well_be_absent_is_not_stated(
    monkeypatch: pytest.MonkeyPatch, named: tuple[str, ...], stated: tuple[str, ...]
) -> None:
    def fitted(_ranking: Any, _leading: Any, names: set[str]) -> Any:
        this = SimpleNamespace(added=tuple(sorted(names)), limits_met=(), hypothesis=SimpleNamespace(table=table()))
        return SimpleNamespace(fit=this, final=this)

    def estimated(this: Any, _counted: Any, *, samples: float) -> dict[str, Estimate]:
        assert samples == pytest.approx(900.0 / 1.7**2), "by noise, however little the misfit counts for"
        known = INTERVALS.get(this.added, {})
        return {name: Estimate(value=0.5, unit="1", interval=interval) for name, interval in known.items()}

    monkeypatch.setattr(decision, "together", fitted)
    monkeypatch.setattr(decision, "estimates", estimated)
    left = SimpleNamespace(effective=900.0, effective_with_misfit=50.0)
    monkeypatch.setattr(decision, "_free_of_drift", lambda _ranking, _found, this: (this.final, left))
    rows: Any = tuple(
        ActingEffect(name=name, probability=0.6, together=0.9, share=0.5, evidence=SimpleNamespace())  # type: ignore[arg-type]
        for name in named
    )
    ranking: Any = SimpleNamespace(counted=None)
    leading = fitted(None, None, {*named, "constant-load"} if named == ("quadratic-drag",) else set(named))
    _, found, chosen = decision._stated(ranking, Account(effects=rows, leading=leading, birge=1.7))
    assert tuple(e.name for e in found.stated) == chosen.fit.added == stated
    assert {e.name for e in found.effects} == set(named)  # it stays in the account
    for e in found.effects:
        kept = 1.0 if e.name in stated else ACTS / 0.9
        assert (e.together, e.probability) == (pytest.approx(0.9 * kept), pytest.approx(0.6 * kept))


def test_intervals_go_by_what_the_stated_effects_leave(monkeypatch: pytest.MonkeyPatch) -> None:
    """The leading explanation may hold effects that are not stated, and leaves less."""
    chosen: Any = SimpleNamespace(fit=None, final="with the stated effects alone")
    ranking: Any = SimpleNamespace(problem=SimpleNamespace(whole=None), weighted="recordings", counted="of all of them")
    fakes: dict[str, Any] = {
        "account": lambda *_: None, "_stated": lambda ranking, found: (ranking, found, chosen), "moves": lambda _: True,
        "proved": lambda *_, **__: (), "remainder": lambda *_: SimpleNamespace(signals=()),
        "verdict_of": lambda *_: "missing-physics",
        "statistics": lambda problem, this: SimpleNamespace(of=(problem, this), misfit=0.0),
    }  # fmt: skip
    for name, fake in fakes.items():
        monkeypatch.setattr(decision, name, fake)
    found = decision.decide(ranking, (), None, seed=0)  # type: ignore[arg-type]
    assert cast(Any, found.left).of == ("recordings", "with the stated effects alone")
    stand_in: Any = SimpleNamespace(final="with what stands in for them")
    assert cast(Any, replace(found, chosen=stand_in).left).of == ("recordings", "with what stands in for them")
