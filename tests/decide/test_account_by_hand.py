"""The account of a mismatch and what remains, from fits and evidence that are written down."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rwn.decide import account as module
from rwn.decide.account import Account, ActingEffect, Remainder, account, remainder
from rwn.decide.calibration import ACTS, calibration
from rwn.decide.evidence import Evidence, _predicted
from rwn.fit.residuals import MISSPECIFIED
from rwn.simulate.run import Run
from rwn.simulate.simulator import RAN_AWAY

CERTAIN = Evidence(share=0.999, unseen=0.99, part=0.999, odds=5000.0, curve=1.0)
MODEL: Any = "the model"
HELDOUT: Any = ["a run that was kept back"]
WHITE = np.random.default_rng(3).standard_normal(400)
SLOW = np.sin(0.02 * np.arange(400))


def _ranked(*added: str, score: float = 0.0) -> Any:
    return SimpleNamespace(added=added, score=score, final=f"fit of {added}")


def _account(
    monkeypatch: pytest.MonkeyPatch, fits: list[Any], found: dict[str, Evidence], against: dict[str, str] | None = None
) -> tuple[Account, Any]:
    """The account, and what the evidence was asked for; `against`: what a half contradicts."""
    asked: dict[str, Any] = {"rivals": {}}

    class CrossValidation:
        birge = 1.7

        def __init__(self, _ranking: Any, leading: Any, heldout: Any, model: Any) -> None:
            asked.update(leading=leading, heldout=heldout, model=model)

        def evidence(self, name: str, rivals: Any) -> Evidence:
            asked["rivals"][name] = rivals
            return found[name]

    def contradicted(*of: Any) -> dict[str, str]:
        assert of == (asked["leading"].final, "the problem", MODEL)
        return against or {}

    monkeypatch.setattr(module, "CrossValidation", CrossValidation)
    monkeypatch.setattr(module, "contradicted", contradicted)
    nothing = next(f for f in fits if not f.added)
    ranking: Any = SimpleNamespace(fits=fits, nothing_missing=nothing, problem="the problem")
    return account(ranking, HELDOUT, MODEL), asked


def test_the_account_is_of_the_best_explanation_that_has_effects(monkeypatch: pytest.MonkeyPatch) -> None:
    fits = [_ranked(score=5.0), _ranked("a", "b", score=4.0), _ranked("a", "c", score=3.0), _ranked("d", score=2.0)]
    shares = {"a": replace(CERTAIN, share=0.2), "b": replace(CERTAIN, share=0.7)}
    found, asked = _account(monkeypatch, fits, shares)
    assert found.leading is fits[1]
    assert asked["leading"] is fits[1]
    assert (asked["heldout"], asked["model"]) == (HELDOUT, MODEL)
    assert asked["rivals"] == {"a": set(), "b": {"c"}}
    assert [(e.name, e.share, e.rivals) for e in found.effects] == [("b", 0.7, ("c",)), ("a", 0.2, ())]
    assert [e.evidence for e in found.effects] == [shares["b"], shares["a"]]
    assert found.effects[1].probability == calibration().probability(shares["a"])
    assert found.birge == 1.7


def test_what_the_shaft_alone_contradicts_is_not_stated_and_the_others_are(monkeypatch: pytest.MonkeyPatch) -> None:
    fits = [_ranked("a", "b", score=4.0), _ranked(score=0.0)]
    found, _ = _account(monkeypatch, fits, {"a": CERTAIN, "b": CERTAIN}, against={"b": "shaft"})
    assert {e.name: e.against for e in found.effects} == {"a": "", "b": "shaft"}
    assert [e.name for e in found.stated] == ["a"]


def test_a_law_that_elaborates_an_effect_is_no_evidence_against_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """A drag by any power of the speed that explains less by far is no rival, and says no less that a drag acts."""
    fits = [_ranked("quadratic-drag", score=9.0), _ranked("power-law-drag", score=1.0), _ranked(score=0.0)]
    found, asked = _account(monkeypatch, fits, {"quadratic-drag": CERTAIN})
    assert asked["rivals"] == {"quadratic-drag": {"power-law-drag"}}
    assert found.effects[0].rivals == ()


def test_where_no_effect_was_found_the_account_is_empty(monkeypatch: pytest.MonkeyPatch) -> None:
    found, asked = _account(monkeypatch, [_ranked()], {})
    assert found.effects == found.stated == ()
    assert not found.leading.added
    assert asked["rivals"] == {}


def _acting(name: str, together: float) -> ActingEffect:
    return ActingEffect(
        name=name, probability=0.5 * together, together=together, share=0.5, evidence=CERTAIN, rivals=("z",)
    )


def test_names_not_told_apart_are_stated_together() -> None:
    """More likely than not, it or one of these; by itself none need be."""
    assert _acting("a", 0.8).stated
    assert not _acting("a", 0.4).stated
    assert not _acting("a", ACTS).stated
    assert not ActingEffect(name="a", probability=0.4, together=0.4, share=1.0, evidence=CERTAIN).rivals


def test_what_is_stated_acts_more_likely_than_not() -> None:
    leading: Any = _ranked("a", "b")
    found = Account(effects=(_acting("a", 0.9), _acting("b", 0.3)), leading=leading)
    assert [e.name for e in found.stated] == ["a"]
    assert found.birge == 1.0


@dataclass
class _Problem:
    """One run of one signal, where a fit is the residual that it leaves, in units of the noise."""

    noise: dict[str, Any]
    runs: tuple[Run, ...] = (Run(name="x", time=1e-3 * np.arange(400.0), input=np.zeros(400), speed=np.zeros(400)),)

    def residuals(self, vector: np.ndarray, _active: Any) -> list[dict[str, np.ndarray]]:
        return [{"speed": vector}]


def _remainder(left: np.ndarray, nothing: np.ndarray) -> Remainder:
    def fit(residual: np.ndarray) -> Any:
        return SimpleNamespace(vector=residual, active=[])

    none = SimpleNamespace(final=fit(nothing))
    ranking: Any = SimpleNamespace(weighted=_Problem(noise={}), nothing_missing=none)
    return remainder(ranking, fit(left))


def _of(error: float, shape: np.ndarray = WHITE) -> np.ndarray:
    return shape * np.sqrt(error / np.mean(shape**2))


@pytest.mark.parametrize(
    ("left", "nothing", "share"),
    [
        (3.0, 9.0, 0.25),  # 2 of 8 above the noise
        (9.0, 9.0, 1.0),
        (12.0, 9.0, 1.0),  # worse than nothing: all of it
        (0.9, 9.0, 0.0),  # less than the noise: nothing
        (0.9, 0.8, 0.0),
        (1.5, 0.5, 1.0),
    ],
)
def test_what_remains_is_counted_from_the_noise_up(left: float, nothing: float, share: float) -> None:
    found = _remainder(_of(left), _of(nothing))
    assert found.share == pytest.approx(share)
    assert found.error == pytest.approx(left)


def test_structure_in_what_remains_is_said_with_its_signal() -> None:
    assert _remainder(_of(3.0, SLOW), _of(9.0)).signals == ("speed",)
    assert _remainder(_of(3.0), _of(9.0, SLOW)).signals == ()


def test_without_a_word_the_remainder_is_noise() -> None:
    assert Remainder() == Remainder(share=0.0, error=1.0, signals=())


def _predicts(this: np.ndarray, without: np.ndarray) -> float:
    judge: Any = _Problem(noise={})
    fits: Any = [SimpleNamespace(vector=residual, active=[]) for residual in (this, without)]
    return _predicted(judge, *fits)


def test_recordings_kept_back_speak_for_what_predicts_them_better_as_loud_as_its_errors_are_many() -> None:
    """Half the logarithm of the ratio of variances, for each independent sample of the better one's errors."""
    white = _predicts(_of(1.0), _of(np.e))
    assert white == pytest.approx(0.5 * 400.0, rel=0.3)
    assert _predicts(_of(np.e), _of(1.0)) == pytest.approx(-white)
    assert 0.0 < _predicts(_of(1.0, SLOW), _of(np.e, SLOW)) < 0.5 * MISSPECIFIED
    assert _predicts(_of(0.5), _of(0.9)) == 0.0, "both leave less than the noise"


def test_what_has_run_away_on_recordings_kept_back_counts_as_far_off_and_no_more() -> None:
    away = np.where(np.arange(400) < 9, 0.0, np.inf)
    assert _predicts(away, _of(1.0)) == pytest.approx(_predicts(_of(RAN_AWAY), _of(1.0)))
    assert _predicts(away, away) == 0.0
