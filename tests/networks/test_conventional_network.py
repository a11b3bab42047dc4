from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from networks import random_network, relative, wavelets
from rwn import ConventionalNetwork, Wavelet

shapes = st.fixed_dictionaries(
    {"inputs": st.integers(1, 4), "wavelets": st.integers(1, 20), "outputs": st.integers(1, 3)}
)


@settings(deadline=None, max_examples=60)
@given(wavelets, shapes, st.integers(0, 2**32))
def test_parity_with_the_reference(wavelet: Wavelet, shape: dict[str, int], seed: int) -> None:
    network, plain, rng = random_network(wavelet, **shape, seed=seed)
    x = rng.normal(size=(1000, shape["inputs"]))
    y = rng.normal(size=(1000, shape["outputs"]))
    assert relative(network.output(x), plain.output(x)) < 1e-12
    assert relative(network.jacobian(x), plain.jacobian(x)) < 1e-12
    assert relative(network.gradient(x, y), plain.gradient(x, y)) < 1e-12
    assert network.mse(x, y) == pytest.approx(np.mean((y - plain.output(x)) ** 2), rel=1e-12)


@settings(deadline=None, max_examples=20)
@given(wavelets, shapes, st.integers(0, 2**32))
def test_gradient_agrees_with_central_differences(
    wavelet: Wavelet, shape: dict[str, int], seed: int
) -> None:
    network, _, rng = random_network(wavelet, **shape, seed=seed)
    x = rng.normal(size=(20, shape["inputs"]))
    y = rng.normal(size=(20, shape["outputs"]))
    theta, h = network.parameters, 1e-5
    differences = np.empty_like(theta)
    for n, unit in enumerate(np.eye(theta.size)):
        up, down = (network.with_parameters(theta + s * h * unit).mse(x, y) for s in (1, -1))
        differences[n] = (up - down) / (2 * h) * y.size / 2
    assert relative(network.gradient(x, y), differences) < 1e-6


def test_one_dimensional_input_is_one_column() -> None:
    network, _, rng = random_network(Wavelet(), inputs=1, wavelets=3, outputs=1, seed=0)
    x = rng.normal(size=9)
    np.testing.assert_array_equal(network.output(x), network.output(x[:, None]))


def test_parameters_round_trip_and_are_read_only() -> None:
    network, _, _ = random_network(Wavelet(), inputs=2, wavelets=3, outputs=2, seed=0)
    again = network.with_parameters(network.parameters)
    np.testing.assert_array_equal(again.parameters, network.parameters)
    with pytest.raises(ValueError, match="read-only"):
        network.w[0, 0] = 1.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"w": np.zeros((2, 3))}, r"w must have shape \(1, 3\)"),
        ({"d": np.zeros((3, 2))}, "dilations d must not be zero"),
        ({"b": [np.nan]}, r"b must be finite, got nan at \[0\]"),
        ({"m": np.zeros(3)}, "m must have 2 dimension"),
        ({"a": np.ones((1, 2)) * 1j}, "a must hold real numbers"),
    ],
)
def test_bad_parameters_are_refused(change: dict[str, np.ndarray], message: str) -> None:
    good = {
        "b": np.zeros(1),
        "a": np.zeros((1, 2)),
        "w": np.zeros((1, 3)),
        "m": np.zeros((3, 2)),
        "d": np.ones((3, 2)),
    }
    with pytest.raises(ValueError, match=message):
        ConventionalNetwork(wavelet=Wavelet(), **(good | change))


def test_bad_data_are_refused() -> None:
    network, _, _ = random_network(Wavelet(), inputs=2, wavelets=3, outputs=1, seed=0)
    with pytest.raises(ValueError, match="2 inputs, the patterns 3"):
        network.output(np.zeros((4, 3)))
    with pytest.raises(ValueError, match="same number of patterns"):
        network.gradient(np.zeros((4, 2)), np.zeros(3))
    with pytest.raises(ValueError, match=r"this network has 18 parameters, got 2"):
        network.with_parameters(np.zeros(2))
