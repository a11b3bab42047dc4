"""From evidence to a probability: the logistic formula, its scales, and how rivals share it."""

from __future__ import annotations

from dataclasses import asdict, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rwn.decide.account import LARGEST_SET, RIVAL, _acting, _rivals
from rwn.decide.calibration import ACTS, FEATURES, Calibration, calibration, features
from rwn.decide.evidence import Evidence

EVEN = Evidence(share=0.5, unseen=0.5, part=0.5, odds=0.0, curve=0.0)
MADE = Calibration(intercept=0.5, weights=(1.0, 2.0, 3.0, 4.0, 5.0), means=(0.0, 1.0, 0.0, 0.0, 0.0),
                   deviations=(1.0, 2.0, 1.0, 1.0, 1.0))  # fmt: skip


def test_the_formula_is_that_of_a_logistic_regression() -> None:
    """All features of EVEN are 0: z = 0.5 + 2 (0 - 1) / 2 = -0.5."""
    assert MADE.probability(EVEN) == pytest.approx(1.0 / (1.0 + np.exp(0.5)))
    assert MADE.probability(replace(EVEN, curve=0.2)) == pytest.approx(1.0 / (1.0 + np.exp(-0.5)))
    assert MADE.probability(replace(EVEN, share=np.e / (1.0 + np.e))) == pytest.approx(1.0 / (1.0 + np.exp(-0.5)))


def test_shares_count_by_their_odds_and_log_likelihoods_are_bent() -> None:
    assert features(EVEN).tolist() == [0.0] * 5
    assert features(replace(EVEN, share=0.9))[0] == pytest.approx(np.log(9.0))
    assert features(replace(EVEN, part=1.0))[2] == pytest.approx(np.log(199.0)), "as known to half a per cent"
    assert features(replace(EVEN, unseen=-3.0))[1] == pytest.approx(-np.log(199.0))
    assert features(replace(EVEN, odds=np.sinh(2.0)))[3] == pytest.approx(2.0)
    for wild, kept in ((1e9, 1e4), (-1e9, -100.0)):
        assert features(replace(EVEN, odds=wild))[3] == pytest.approx(np.arcsinh(kept))


def test_nothing_is_stated_against_the_evidence() -> None:
    strong = replace(EVEN, share=0.99, unseen=0.99, part=0.99, curve=1.0)
    assert MADE.probability(replace(strong, odds=0.1)) > 0.99
    assert MADE.probability(replace(strong, odds=-0.1)) == ACTS  # stated is what is above
    assert MADE.probability(replace(EVEN, odds=-3.0)) < ACTS


def test_what_is_not_known_counts_as_usual() -> None:
    assert MADE.probability_by() == pytest.approx(1.0 / (1.0 + np.exp(-0.5)))
    known = Evidence(share=0.8, unseen=0.6, part=0.99, odds=30.0, curve=0.9)
    assert MADE.probability_by(**asdict(known)) == pytest.approx(MADE.probability(known))
    without = {name: value for name, value in asdict(known).items() if name != "unseen"}
    usual = replace(known, unseen=np.e / (1.0 + np.e))  # of log-odds 1, the mean of MADE
    assert MADE.probability_by(**without) == pytest.approx(MADE.probability(usual))


def test_each_feature_counts_by_its_weight_from_its_mean_in_deviations() -> None:
    """Of log-odds 1 each, and odds and curve of 1: 0.3 + sum of weight (1 - mean) / deviation."""
    made = Calibration(intercept=0.3, weights=(0.1, -0.2, 0.3, 0.4, -0.5), means=(0.2, 0.5, 2.0, -1.0, 3.0),
                       deviations=(2.0, 0.5, 4.0, 1.5, 2.5))  # fmt: skip
    one = np.e / (1.0 + np.e)
    found = Evidence(share=one, unseen=one, part=one, odds=float(np.sinh(1.0)), curve=1.0)
    terms = {"share": 0.04, "unseen": -0.2, "part": -0.075, "odds": 0.8 / 1.5, "curve": 0.4}

    def logistic(z: float) -> float:
        return float(1.0 / (1.0 + np.exp(-z)))

    assert made.probability(found) == pytest.approx(logistic(0.3 + sum(terms.values())))
    for name, term in terms.items():
        assert made.probability_by(**{name: getattr(found, name)}) == pytest.approx(logistic(0.3 + term))


@pytest.mark.parametrize("name", FEATURES)
def test_more_evidence_of_any_kind_does_not_make_an_effect_less_likely(name: str) -> None:
    """Of the calibration that comes with rwn."""
    less, more = {"odds": (-5.0, 500.0)}.get(name, (0.1, 0.9))
    low, high = (calibration().probability(replace(EVEN, **{name: value})) for value in (less, more))
    assert low < high


def test_the_calibration_tells_what_acts_from_a_mimic() -> None:
    certain = Evidence(share=0.999, unseen=0.99, part=0.999, odds=5000.0, curve=1.0)
    mimic = Evidence(share=0.03, unseen=0.01, part=0.2, odds=0.5, curve=0.6)
    assert calibration().probability(certain) > 0.95
    assert calibration().probability(mimic) < 0.5, "it is not stated"
    assert calibration().fitted_on


def test_no_evidence_is_out_of_scale() -> None:
    wild = Evidence(share=-np.inf, unseen=np.inf, part=0.0, odds=-np.inf, curve=0.0)
    assert np.isfinite(features(wild)).all()


def ranked(*fits: tuple[tuple[str, ...], float]) -> Any:
    return SimpleNamespace(fits=[SimpleNamespace(added=added, score=score) for added, score in fits])


def test_rivals_take_the_place_of_one_effect_beside_the_same_others() -> None:
    more = [(("a", "b", "e"), 9.9), (("a", "e", "f"), 9.8), (("b", "f", "g"), 9.8)]
    ranking = ranked((("a", "b"), 10.0), (("a", "c"), 9.0), (("c", "b"), 8.5), (("d",), 9.9), *more)
    leading = ranking.fits[0]
    assert _rivals(ranking, leading, "b", {}) == {"c": pytest.approx(np.exp(-1.0))}
    assert _rivals(ranking, leading, "a", {}) == {"c": pytest.approx(np.exp(-1.5))}


def test_few_rivals_are_an_answer_and_faint_ones_are_none() -> None:
    near = [((name,), 10.0 - 0.1 * k) for k, name in enumerate("abcde")]
    ranking = ranked(*near)
    assert list(_rivals(ranking, ranking.fits[0], "a", {})) == ["b", "c"]
    assert LARGEST_SET == 3
    edge = -np.log(RIVAL)
    for off, found in ((edge - 0.01, ["b"]), (edge + 0.01, [])):
        ranking = ranked((("a",), 10.0), (("b",), 10.0 - off))
        assert list(_rivals(ranking, ranking.fits[0], "a", {})) == found


def test_what_is_known_of_a_rival_stands_for_the_evidence_between_explanations() -> None:
    ranking = ranked((("a",), 10.0), (("b",), 12.0))
    assert _rivals(ranking, ranking.fits[0], "a", {("a", "b"): 0.25}) == {"b": 0.25}
    assert _rivals(ranking, ranking.fits[0], "a", {("a", "b"): 0.5 * RIVAL}) == {}


def test_rivals_share_the_probability_by_the_evidence_for_each() -> None:
    found = Evidence(share=1.5, unseen=0.99, part=0.999, odds=5000.0, curve=1.0)
    alone, beside = _acting("a", found, {}), _acting("a", found, {"b": 0.5, "c": 0.25})
    assert alone.together == beside.together == alone.probability == calibration().probability(found)
    assert beside.probability == pytest.approx(alone.probability / 1.75)
    assert beside.rivals == ("b", "c")
    assert alone.share == 1.0, "at most the whole"
    assert _acting("a", replace(found, share=-0.2), {}).share == 0.0
