from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from motor_networks import drive, relative_error, structured
from rwn.networks.rates import Fixed
from rwn.reference import side_by_side as reference

RATES = {"v1": 1e-6, "v2": 1e-6, "v3": 1e-7, "w": 1e-6, "m": 1e-5, "d": 1e-5, "c": 1e-5}


def scaled(factor: float) -> Fixed:
    return Fixed({group: factor * rate for group, rate in RATES.items()})


def test_runs_side_by_side_equal_runs_alone() -> None:
    u, y = drive(800, frequency=10)
    networks = [structured(15, seed) for seed in range(11)]
    rules = [scaled(factor) for factor in np.linspace(0.5, 1, 11)]
    got = rwn.train_side_by_side(networks, u, y, rates=rules, cycles=2)
    for k, (network, rule) in enumerate(zip(networks, rules, strict=True)):
        alone = rwn.train_structured(network, u, y, learn=network.groups, rates=rule, cycles=2)
        assert relative_error(got.networks[k].theta, alone.network.theta) < 1e-12
        assert got.mse_learning[k] == pytest.approx(alone.mse_learning[-1], rel=1e-12)
        assert got.mse_frozen[k] == pytest.approx(alone.mse_frozen[-1], rel=1e-11)
        assert (got.status[k], got.advice[k]) == (alone.status, alone.advice)
    assert got.best.mse(u, y) == pytest.approx(got.mse_frozen.min(), rel=1e-12)


@pytest.mark.parametrize("name", ["gaussian-derivative", "mexican-hat", "morlet"])
def test_runs_side_by_side_agree_with_the_reference(name: str) -> None:
    u, y = drive(1000, frequency=20)
    networks = [structured(7, seed, name=name) for seed in range(3)]
    rates = {**RATES, "v4": 1e-8, "v5": 1e-8}
    got = rwn.train_side_by_side(networks, u, y, rates=Fixed(rates))
    values = np.tile([rates[group] for group in networks[0].groups], (3, 1))
    wanted = reference.train(networks, u, y, rates=values, cycles=1)
    for one, other, start in zip(got.networks, wanted, networks, strict=True):
        assert relative_error(one.theta, other.theta) < 1e-12
        assert relative_error(one.theta, start.theta) > 1e-6


def test_a_run_that_diverges_says_so_and_leaves_its_neighbours_alone() -> None:
    u, y = drive(800, frequency=10)
    networks = [structured(15, seed) for seed in range(3)]
    got = rwn.train_side_by_side(networks, u, y, rates=[scaled(1), scaled(1e9), scaled(1)], cycles=3)
    calm = rwn.train_side_by_side(networks[::2], u, y, rates=scaled(1), cycles=3)
    assert got.status == ("completed", "diverged", "completed")
    assert "lower the fraction" in got.advice[1]
    np.testing.assert_array_equal(got.networks[1].theta, networks[1].theta)  # before the cycle that diverged
    assert got.mse_learning[1] == np.inf
    assert np.isfinite(got.mse_frozen).all()
    for one, other in zip(got.networks[::2], calm.networks, strict=True):
        np.testing.assert_array_equal(one.theta, other.theta)


def test_what_it_refuses() -> None:
    u, y = drive(100)
    one = structured(5, 0)
    for networks, rates, cycles, message in (
        ([], scaled(1), 1, "at least one"),
        ([one, structured(6, 0)], scaled(1), 1, r"networks\[1\] has 6 wavelets"),
        ([one, replace(one, wavelet=rwn.Wavelet("morlet"))], scaled(1), 1, "of one shape"),
        ([one, one], [scaled(1)], 1, "one for each of 2 networks, got 1"),
        ([one], Fixed({"b": 1.0}), 1, "unknown group 'b'"),
        ([one], scaled(1), 0, "cycles >= 1"),
    ):
        with pytest.raises(ValueError, match=message):
            rwn.train_side_by_side(networks, u, y, rates=rates, cycles=cycles)
