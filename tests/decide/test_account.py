"""The account of what acts, and the verdict that follows from it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.decide.account import Account, Acting, Remainder, account, remainder
from rwn.decide.calibration import calibration, features
from rwn.decide.evidence import Evidence
from rwn.decide.other_law import curve_instead
from rwn.decide.verdict import verdict_of
from rwn.fit.fit import fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.preparation import prepare
from rwn.name.forward import rank
from rwn.name.ranking import Ranking

DEMO = Path(rwn.__file__).parent / "demo"
MODEL = rwn.read_model(DEMO / "model.toml")
CERTAIN = Evidence(share=0.999, unseen=0.99, part=0.999, odds=5000.0, curve=1.0)
MIMIC = Evidence(share=0.03, unseen=0.01, part=0.2, odds=0.5, curve=0.6)


@pytest.fixture(scope="module")
def ranking() -> Ranking:
    """Of the demo, which lacks Coulomb friction."""
    recording = rwn.read_recording(DEMO / "train.csv", layout=MODEL.recording)
    names = ["coulomb-friction", "asymmetric-friction", "quadratic-drag"]
    return rank(prepare([recording], MODEL), progress=lambda *_: None, names=names)


def test_what_acts_is_stated_and_its_elaboration_is_not(ranking: Ranking) -> None:
    found = account(ranking, [], MODEL)
    assert [e.name for e in found.stated] == ["coulomb-friction"]
    (acting,) = found.stated
    assert acting.probability > 0.9
    assert acting.share > 0.9


def test_what_was_kept_back_may_withdraw_a_name(ranking: Ranking) -> None:
    found = account(ranking, [], MODEL)
    refused = found.withdrawn(["coulomb-friction"])
    assert refused.stated == ()
    assert len(refused.effects) == len(found.effects)
    assert found.withdrawn(["quadratic-drag"]) == found, "a name that is not in it"


def test_the_remainder_is_that_of_the_nominal_model_or_noise(ranking: Ranking) -> None:
    nothing = remainder(ranking, ranking.nothing_missing.final)
    assert nothing.share == pytest.approx(1.0)
    assert nothing.signals
    named = remainder(ranking, account(ranking, [], MODEL).leading.final)
    assert named.share < 0.01


def test_the_verdict_follows_from_what_is_stated_and_what_is_left(ranking: Ranking) -> None:
    leading = account(ranking, [], MODEL).leading

    def of(probability: float, left: Remainder) -> str:
        acting = Acting(
            name="coulomb-friction", probability=probability, together=probability, share=0.5, evidence=CERTAIN
        )
        return verdict_of(ranking, Account(effects=(acting,), leading=leading), left)

    noise, structure = Remainder(), Remainder(share=1.0, error=4.0, signals=("speed",))
    assert of(0.9, structure) == "missing-physics", "what remains takes no name away"
    assert of(0.2, structure) == "unexplained"
    assert of(0.2, noise) == "adequate"
    assert of(0.2, replace(structure, error=1.001)) == "adequate", "structure of no size"


def test_names_not_told_apart_are_stated_together() -> None:
    one = Acting(name="a", probability=0.4, together=0.8, share=0.5, evidence=CERTAIN, rivals=("b",))
    assert one.stated
    assert not replace(one, rivals=(), together=0.4).stated


def test_the_calibration_tells_what_acts_from_a_mimic() -> None:
    assert calibration().probability(CERTAIN) > 0.95
    assert calibration().probability(MIMIC) < 0.5, "it is not stated"
    assert calibration().fitted_on


def test_no_evidence_is_out_of_scale() -> None:
    wild = Evidence(share=-np.inf, unseen=np.inf, part=0.0, odds=-np.inf, curve=0.0)
    assert np.isfinite(features(wild)).all()


def test_a_curve_in_the_place_of_a_law_says_no_more_of_its_state(ranking: Ranking) -> None:
    friction = next(r for r in ranking.fits if r.added == ("coulomb-friction",)).fit
    problem = ranking.problem
    mimic = fit(problem, hypothesis(problem.prior, ("quadratic-drag",), problem.scales))
    nominal = ranking.nominal
    assert curve_instead(ranking.problem, friction, nominal, MODEL) > 0.99
    assert curve_instead(ranking.problem, mimic, nominal, MODEL) < 0.5
