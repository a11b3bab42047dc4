from __future__ import annotations

import numpy as np
import pytest
from test_structured_trainers import CASES, linear_case, worst

import rwn
from motor_networks import MOTOR, SAMPLE_TIME, drive, structured
from rwn.networks.rates import ImpulseResponse, Normalised, Thesis
from rwn.networks.trainers import GuardedDescent


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize(
    "trainer",
    [GuardedDescent(cycles=20), GuardedDescent(cycles=20, rates=Normalised(), follow_state=True)],
    ids=["impulse-response", "normalised"],
)
def test_every_start_of_tables_17_and_18_comes_within_one_percent(name: str, trainer: GuardedDescent) -> None:
    start, true, u, y = linear_case(name)
    learn = CASES[name][2]
    fit = trainer.train(start, u, y, learn=learn)
    assert (np.diff(fit.mse) <= 0).all()
    assert worst(fit.network, true, learn) < 0.01
    assert fit.mse[-1] == pytest.approx(fit.network.mse(u, y), rel=1e-12)


def test_the_same_rule_without_the_guard_diverges() -> None:
    start, true, u, y = linear_case("Table 18 case 3")
    run = rwn.train_structured(start, u, y, learn=("v1", "v2"), rates=ImpulseResponse(), cycles=20)
    assert run.status == "diverged"
    guarded = GuardedDescent(cycles=20).train(start, u, y, learn=("v1", "v2"))
    assert worst(guarded.network, true, ("v1", "v2")) < 0.01
    assert not all(guarded.kept)


@pytest.mark.parametrize("fraction", [1e-3, 1.0, 1e3])
def test_the_error_never_rises_whatever_the_fraction(fraction: float) -> None:
    network = structured(7, 3)
    u, y = drive(4000)
    rule = Thesis(fraction=fraction, maxima="pre-pass", shared=False)
    fit = GuardedDescent(rates=rule, cycles=12).train(network, u, y, learn=("v1", "v2", "w", "m", "d"))
    assert (np.diff(fit.mse) <= 0).all()
    assert fit.mse[-1] < fit.mse[0]
    assert len(fit.fraction) == len(fit.kept) == len(fit.linear) - 1


def test_at_the_minimum_it_says_converged_and_stays() -> None:
    _, true, u, y = linear_case("Table 18 case 1")
    fit = GuardedDescent().train(true, u, y, learn=("v1", "v2"))
    assert fit.status == "converged"
    np.testing.assert_array_equal(fit.network.v, true.v)


def test_bad_options_are_named() -> None:
    with pytest.raises(ValueError, match="grow >= 1"):
        GuardedDescent(cut=1.0)
    unstable = rwn.StructuredNetwork.from_motor(MOTOR, sample_time=SAMPLE_TIME)
    u, y = drive(300)
    with pytest.raises(ValueError, match="start from a stable one"):
        GuardedDescent().train(
            rwn.StructuredNetwork(v=[-0.02, *unstable.v[1:]], w=[], m=[], d=[], c=[]), u, y, learn=("v2",)
        )
