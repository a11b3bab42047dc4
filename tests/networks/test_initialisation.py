from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from networks import relative, wavelets
from rwn import Wavelet, _core
from rwn.networks.initialisation import INITIALISERS, DyadicGrid, Heuristic, LeastSquares, Selection, SmallRandom
from rwn.reference import initialisation as reference

seeds = st.integers(0, 2**32)


@settings(deadline=None)
@given(st.integers(1, 3), st.integers(1, 3), seeds)
def test_least_squares_and_heuristic_parity(inputs: int, outputs: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    x, y = rng.normal(size=(1000, inputs)), rng.normal(size=(1000, outputs))
    assert relative(_core.least_squares(x, y), reference.least_squares(x, y)) < 1e-11
    for got, want in zip(_core.heuristic(x, 5), reference.heuristic(x, 5), strict=True):
        assert relative(got, want) < 1e-15


@settings(deadline=None)
@given(st.integers(1, 3), st.integers(1, 40), seeds)
def test_dyadic_grid_parity(inputs: int, count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    x = rng.normal(size=(1000, inputs))
    nodes, taken = _core.finest_scale(count)
    finest = rng.permutation(nodes)[:taken].tolist()
    got, want = _core.dyadic_grid(x, count, finest), reference.dyadic_grid(x, count, finest)
    assert relative(got[0], want[0]) < 1e-12
    assert relative(got[1], want[1]) < 1e-12


@settings(deadline=None, max_examples=10)
@given(wavelets, st.integers(1, 2), seeds)
def test_selection_parity(wavelet: Wavelet, outputs: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(-1, 1, (60, 1)), rng.normal(size=(60, outputs))
    m, d = _core.wavelet_library(x, 3, 0.5)
    got = _core.select_wavelets(wavelet.core, m, d, x, y, 5)
    assert got == reference.select_wavelets(wavelet.name, wavelet.omega0, m, d, x, y, 5)


@pytest.mark.parametrize("way", INITIALISERS.values(), ids=INITIALISERS)
@pytest.mark.parametrize("inputs", [1, 2])
def test_every_initialiser_starts_a_network(way: type[Heuristic], inputs: int) -> None:
    x = np.random.default_rng(0).uniform(-1, 1, (80, inputs))
    y = np.sin(3 * x).sum(axis=1)
    network = way().start(Wavelet(), x, y, wavelets=6, seed=3)
    assert network.wavelets == 6
    np.testing.assert_array_equal(
        network.parameters, way().start(Wavelet(), x, y, wavelets=6, seed=3).parameters
    )


def test_selection_beats_the_grid_before_training() -> None:
    x = np.linspace(-10, 10, 201)
    y = np.where(x < 0, np.sin(x), 0.2 * x)
    start = {way: way().start(Wavelet(), x, y, wavelets=15).mse(x, y) for way in (Selection, DyadicGrid)}
    assert start[Selection] < 0.01 * start[DyadicGrid]


def test_the_linear_start_is_an_option() -> None:
    x = np.linspace(0, 1, 50)
    network = Heuristic(linear=SmallRandom(scale=1e-3)).start(Wavelet(), x, 5 + 3 * x, wavelets=4)
    assert np.abs(network.parameters[:6]).max() <= 1e-3
    network = Heuristic(linear=LeastSquares(scale=0.0)).start(Wavelet(), x, 5 + 3 * x, wavelets=4)
    np.testing.assert_allclose([network.b[0], network.a[0, 0]], [5, 3], rtol=1e-12)


def test_bad_data_are_refused() -> None:
    with pytest.raises(ValueError, match="input 0 is constant"):
        DyadicGrid().start(Wavelet(), np.ones(9), np.ones(9), wavelets=3)
    with pytest.raises(ValueError, match="of 12 wavelets are independent on these 5 patterns"):
        Selection().start(Wavelet(), np.arange(5.0), np.arange(5.0) ** 2, wavelets=12)
