"""Which explanation is named, and what refuses a name."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.decide import verdict
from rwn.fit.fit import Fit
from rwn.fit.noise import CLOCK, noise_of
from rwn.fit.preparation import prepare
from rwn.name.forward import rank
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.prove.heldout import HeldoutRow
from rwn.prove.proof import LEFT_OUT
from rwn.recording.speed_measurement import CENTRAL
from rwn.simulate.run import Run

DEMO = Path(rwn.__file__).parent / "demo"


@pytest.fixture(scope="module")
def ranking() -> Ranking:
    model = rwn.read_model(DEMO / "model.toml")
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    return rank(
        prepare([recording], model), progress=lambda *_: None, names=["coulomb-friction", "asymmetric-friction"]
    )


def _of(ranking: Ranking, name: str) -> RankedFit:
    return next(h for h in ranking.fits if h.added == (name,))


@pytest.mark.parametrize(("worse", "named"), [(1e-3, "coulomb-friction"), (1e-2, "asymmetric-friction")])
def test_plain_friction_unless_its_elaboration_fits_better_than_the_simulation_is_exact(
    ranking: Ranking, worse: float, named: str
) -> None:
    elaborate, plain = _of(ranking, "asymmetric-friction"), _of(ranking, "coulomb-friction")
    minimum = replace(plain.fit.minimum, chi2=(1.0 + worse) * elaborate.fit.minimum.chi2)
    plain = replace(plain, fit=replace(plain.fit, minimum=minimum), probability=0.01)
    pair = (replace(elaborate, probability=0.99), plain, ranking.nothing_missing)
    assert verdict.choose(replace(ranking, fits=pair)).added == (named,)


def test_plain_friction_where_its_elaboration_is_finer_than_the_simulation(ranking: Ranking) -> None:
    """A precise position: a difference of a third of the noise is a millionth of what both explain."""
    elaborate, plain = _of(ranking, "asymmetric-friction"), _of(ranking, "coulomb-friction")
    left = elaborate.fit.minimum.chi2
    pair = (
        replace(elaborate, probability=0.99),
        replace(plain, fit=_with_error(plain, 1.3 * left), probability=0.01),
    )
    for missing, named in ((1e3 * left, "asymmetric-friction"), (1e6 * left, "coulomb-friction")):
        nothing = replace(ranking.nothing_missing, fit=_with_error(ranking.nothing_missing, missing))
        assert verdict.choose(replace(ranking, fits=(*pair, nothing))).added == (named,)


def test_what_is_gained_below_the_noise_is_no_gain(ranking: Ranking, monkeypatch: pytest.MonkeyPatch) -> None:
    errors = {(): {"speed": 1.04, "position": 0.9}, ("coulomb-friction",): {"speed": 1.04, "position": 0.3}}
    monkeypatch.setattr(verdict, "_variances", lambda _, h: errors.get(h.added, errors[()]))
    monkeypatch.setattr(Fit, "farthest_move", property(lambda _: 1.0))
    assert verdict.choose(ranking).added == ()
    errors[()]["speed"] = 1.5
    assert verdict.choose(ranking).added == ("coulomb-friction",)


def test_most_of_a_coarse_speed_s_error_is_a_gain_beneath_its_steps(
    ranking: Ranking, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What the steps do on average is known: a backlash of 0.9 of their size was passed over (10034, trial 24)."""
    errors = {(): {"speed": 0.9}, ("coulomb-friction",): {"speed": 0.1}}
    monkeypatch.setattr(verdict, "_variances", lambda _, h: errors.get(h.added, errors[()]))
    monkeypatch.setattr(Fit, "farthest_move", property(lambda _: 1.0))
    coarse = replace(ranking, speed_steps=(1.0,))
    assert verdict.choose(ranking).added == ()
    assert verdict.choose(coarse).added == ("coulomb-friction",)
    errors["coulomb-friction",]["speed"] = 0.6
    assert verdict.choose(coarse).added == ()


@pytest.mark.parametrize(
    ("without", "with_it", "named"),
    [(12.0, 1.0, "coulomb-friction"), (3.0, 1.0, None), (12.0, 6.0, None)],
)
def test_a_nominal_model_that_fits_as_well_beyond_belief_is_not_adequate(
    ranking: Ranking, monkeypatch: pytest.MonkeyPatch, without: float, with_it: float, named: str | None
) -> None:
    monkeypatch.setattr(verdict, "_variances", lambda *_: {"speed": 1.0})
    monkeypatch.setattr(Fit, "farthest_move", property(lambda f: with_it if f.added else without))
    chosen = verdict.choose(ranking)
    assert chosen.added == ((named,) if named else ())
    assert verdict.rests_on_what_was_declared(ranking, chosen) == bool(named)


def test_no_position_is_better_known_than_the_clock() -> None:
    time = np.linspace(0.0, 1.0, 500)
    far = Run(name="far", time=time, input=0.0 * time, position=1000.0 * np.sin(1.5 * time))
    error = {"position": 1e-6 * np.random.default_rng(0).standard_normal(500)}
    assert noise_of([far], [error])["position"].level == pytest.approx(CLOCK * 1000.0 * np.sin(1.5))


def test_only_the_speed_is_as_exact_as_encoder_counts() -> None:
    rng, time = np.random.default_rng(1), np.linspace(0.0, 1.0, 2000)
    counts = np.round(300.0 * np.sin(2.0 * time)) * 1e-3
    current = np.round(rng.standard_normal(time.size) / 0.5) * 0.01  # a converter whose step is half of the noise
    run = Run(
        name="coarse", time=time, input=0.0 * time, current=current, speed=counts, position=counts,
        speed_measured=CENTRAL,
    )  # fmt: skip
    levels = noise_of([run], [{"current": current, "speed": current, "position": current}])
    assert levels["current"].level == pytest.approx(0.02, rel=0.3)
    assert levels["speed"].level < 1e-3


def _with_error(h: RankedFit, chi2: float) -> Fit:
    return replace(h.fit, minimum=replace(h.fit.minimum, chi2=chi2))


def test_a_proved_name_that_leaves_more_than_noise_is_no_certainty(
    ranking: Ranking, monkeypatch: pytest.MonkeyPatch
) -> None:
    name = _of(ranking, "coulomb-friction")
    coloured = replace(ranking, left=replace(ranking.left, coloured=100.0, variance=2.0))
    white = replace(ranking, left=replace(ranking.left, coloured=1.0))
    assert verdict.whole(white, name, certain=True) == 1.0, "only noise is left"
    for removed, alone, beside in ((0.98, 0.2, 0.5), (0.999, 0.99, 0.99), (0.75, 0.0, 0.25)):
        monkeypatch.setattr(verdict, "_removed", lambda *_, share=removed: share)
        assert verdict.whole(coloured, name, certain=False) == pytest.approx(alone, abs=0.01)
        assert verdict.whole(coloured, name, certain=True) == pytest.approx(beside, abs=0.01)


def _row(recording: str) -> HeldoutRow:
    return HeldoutRow(
        recording=recording, region="all", signal="speed", unit="rad/s", samples=100, nominal=1.0, refitted=1.0,
        corrected=2.0, noise_floor=0.1, gain=-1.0, gain_interval=(-1.5, -0.5),
    )  # fmt: skip


def test_what_was_kept_back_refuses_a_name_and_a_part_left_out_does_not_where_it_explains_the_whole(
    ranking: Ranking,
) -> None:
    name = _of(ranking, "coulomb-friction")
    assert verdict.refused(ranking, name, [_row("heldout.csv")])
    assert not verdict.refused(ranking, name, [_row(f"train.csv {LEFT_OUT}")])
    explains_little = replace(name, fit=ranking.nothing_missing.fit)
    assert verdict.refused(ranking, explains_little, [_row(f"train.csv {LEFT_OUT}")])
