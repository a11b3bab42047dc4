"""The account of what acts in a recording that was diagnosed, and of what remains."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import rwn
from made_up import acting
from ranked import ranked_from
from rwn.decide.account import Account, account, remainder
from rwn.decide.evidence import CrossValidation
from rwn.decide.other_law import curve_instead
from rwn.fit.fit import fit
from rwn.fit.hypothesis import hypothesis
from rwn.name.ranking import Ranking

pytestmark = pytest.mark.slow
DEMO = Path(rwn.__file__).parent / "demo"
MODEL = rwn.read_model(DEMO / "model.toml")


@pytest.fixture(scope="module")
def ranking() -> Ranking:
    """Of the demo, which lacks Coulomb friction."""
    recording = rwn.read_recording(DEMO / "train.csv", layout=MODEL.recording)
    names = ["coulomb-friction", "asymmetric-friction", "quadratic-drag"]
    return ranked_from([recording], MODEL, names)


def test_what_acts_is_stated_and_its_elaboration_is_not(ranking: Ranking) -> None:
    found = account(ranking, [], MODEL)
    assert [e.name for e in found.stated] == ["coulomb-friction"]
    (acting,) = found.stated
    assert acting.probability > 0.9
    assert acting.share > 0.9


def test_the_remainder_is_that_of_the_nominal_model_or_noise(ranking: Ranking) -> None:
    nothing = remainder(ranking, ranking.nothing_missing.final)
    assert nothing.share == pytest.approx(1.0)
    assert nothing.signals
    named = remainder(ranking, account(ranking, [], MODEL).leading.final)
    assert named.share < 0.01


def test_a_curve_in_the_place_of_a_law_says_no_more_of_its_state(ranking: Ranking) -> None:
    friction = next(r for r in ranking.fits if r.added == ("coulomb-friction",)).fit
    problem = ranking.problem
    mimic = fit(problem, hypothesis(problem.prior, ("quadratic-drag",), problem.scales))
    nominal = ranking.nominal_fit
    assert curve_instead(ranking.problem, friction, nominal, MODEL) > 0.99
    assert curve_instead(ranking.problem, mimic, nominal, MODEL) < 0.5


@pytest.fixture(scope="module")
def on_a_tie() -> tuple[rwn.Model, Ranking]:
    """Friction of two levels, which the declared friction with a steady load explains as well."""
    declared = replace(
        MODEL, parameters={**MODEL.parameters, "coulomb_friction": 0.012},
        uncertainty={**MODEL.uncertainty, "coulomb_friction": 0.5},
    )  # fmt: skip
    truth = replace(
        MODEL, effects={"asymmetric-friction": {"coulomb_torque_plus": 0.016, "coulomb_torque_minus": 0.008}}
    )
    given = rwn.read_recording(DEMO / "train.csv", layout=MODEL.recording)
    noise = np.random.default_rng(4)
    found = rwn.simulate(truth, given).signals
    measured = {s: found[s] + noise.normal(0.0, 0.01 * np.std(found[s]), given.time.size) for s in ("current", "speed")}
    recording = rwn.Recording(
        name="two levels", time=given.time, signals={"voltage": given.signals["voltage"], **measured}
    )
    names = ["coulomb-friction", "asymmetric-friction", "constant-load"]
    return declared, ranked_from([recording], declared, names)


def test_an_elaboration_is_compared_with_the_plain_law_and_not_with_its_rivals(
    on_a_tie: tuple[rwn.Model, Ranking],
) -> None:
    model, ranking = on_a_tie
    by = {r.added: r for r in ranking.fits}
    elaborate, plain, rival = (by[n,] for n in ("asymmetric-friction", "coulomb-friction", "constant-load"))
    assert elaborate.score == pytest.approx(rival.score, abs=0.1)
    found = CrossValidation(ranking, elaborate, [], model).evidence("asymmetric-friction", (), instead=plain)
    assert 100.0 < found.odds <= elaborate.score - plain.score  # less by what is new in each error
    (acting,) = account(ranking, [], model).stated
    assert {acting.name, *acting.rivals} == {"asymmetric-friction", "constant-load"}


def test_what_need_not_act_has_an_even_chance_with_its_rivals_and_others_keep_theirs() -> None:
    friction = replace(acting("coulomb-friction", 0.6, 0.5), together=0.8)
    drag, ripple = acting("quadratic-drag", 0.9, 0.4), acting("unbalance", 0.3, 0.1)
    found = Account(effects=(drag, friction, ripple), leading=SimpleNamespace())  # type: ignore[arg-type]
    undone = found.undetermined("coulomb-friction").effects
    assert undone[0] is drag
    assert (undone[1].probability, undone[1].together) == pytest.approx((0.6 * 0.5 / 0.8, 0.5))
    assert not undone[1].stated
    assert undone[2] is ripple
    assert found.undetermined("unbalance").effects == found.effects, "it has less than an even chance already"
