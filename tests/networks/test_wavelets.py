from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from networks import wavelets
from rwn import Wavelet
from rwn.networks.wavelets import WAVELETS
from rwn.reference import wavelets as reference


@given(wavelets, st.integers(0, 2**32))
def test_parity_with_the_reference(wavelet: Wavelet, seed: int) -> None:
    z = np.random.default_rng(seed).normal(scale=3.0, size=1000)
    want = reference.WAVELETS[wavelet.name](z, wavelet.omega0)
    for got, wanted in zip(
        (wavelet.value(z), wavelet.derivative(z), wavelet.second_derivative(z)), want, strict=True
    ):
        np.testing.assert_allclose(got, wanted, rtol=1e-12, atol=1e-12 * np.abs(wanted).max())


def test_every_wavelet_has_a_reference() -> None:
    assert set(reference.WAVELETS) == set(WAVELETS)


@pytest.mark.parametrize("name", WAVELETS)
@pytest.mark.parametrize("omega0", [0.5, 1.75, 5.0, 12.0])
def test_bounds_hold_and_are_tight(name: str, omega0: float) -> None:
    wavelet = Wavelet(name, omega0)
    z = np.linspace(-10, 10, 400_001)
    for bound, values in (
        (wavelet.max_value, wavelet.value(z)),
        (wavelet.max_derivative, wavelet.derivative(z)),
        (wavelet.max_scaled_derivative, z * wavelet.derivative(z)),
    ):
        actual = np.abs(values).max()
        assert actual <= bound <= actual * (1 + 1e-6)


@pytest.mark.parametrize(("omega0", "mean"), [(1.75, 0.542), (5.0, 9.3e-6)])
def test_morlet_is_admissible_only_for_a_large_omega0(omega0: float, mean: float) -> None:
    z = np.linspace(-12, 12, 24_001)
    assert np.trapezoid(Wavelet("morlet", omega0).value(z), z) == pytest.approx(mean, rel=0.01)


def test_any_shape_is_kept() -> None:
    assert Wavelet().value(np.zeros((2, 3, 4))).shape == (2, 3, 4)
    assert Wavelet().value(0.5) == pytest.approx(-0.5 * np.exp(-0.125))


def test_an_unknown_name_lists_the_known_ones() -> None:
    with pytest.raises(ValueError, match=r"unknown wavelet 'haar'; known: gaussian-derivative, mexican-hat"):
        Wavelet("haar")


def test_bad_arguments() -> None:
    with pytest.raises(ValueError, match="omega0"):
        Wavelet("morlet", -1.0)
    with pytest.raises(ValueError, match="real numbers"):
        Wavelet().value(np.array([1j]))
