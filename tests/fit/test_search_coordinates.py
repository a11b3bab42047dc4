"""Amplitude and phase of an oscillation are searched as its two parts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from rwn.fit.levenberg_marquardt import FitStatus, minimise
from rwn.fit.search_coordinates import FAINT, SearchCoordinates
from rwn.fit.unknown import Unknown
from rwn.simulate.simulator import NormalEquations

Array = NDArray[np.float64]

TRUTH = np.array([0.4, 2.0, 1.5])  # amplitude, phase, offset
ANGLE = np.linspace(0.0, 20.0, 500)
UNKNOWNS = (
    Unknown(name="wave.amplitude", unit="N m", index=0, lower=0.0, upper=1.0),
    Unknown(name="wave.phase", unit="rad", index=1, lower=-6.4, upper=6.4, amplitude="wave.amplitude"),
    Unknown(name="offset", unit="N m", index=2, lower=1e-3, upper=10.0, logarithmic=True),
)


def wave(values: Array) -> Array:
    amplitude, phase, offset = values
    return offset + amplitude * np.cos(ANGLE + phase)


def normal(values: Array) -> NormalEquations:
    amplitude, phase, _ = values
    cos, sin = np.cos(ANGLE + phase), np.sin(ANGLE + phase)
    jacobian = np.stack([cos, -amplitude * sin, np.ones_like(cos)], axis=1)
    residual = wave(TRUTH) - wave(values)
    chi2 = float(residual @ residual)
    return NormalEquations(chi2=chi2, gradient=jacobian.T @ residual, curvature=jacobian.T @ jacobian)


@pytest.mark.parametrize("start", [(0.3, 2.0 - np.pi), (0.3, 2.0 + 0.5 * np.pi), (0.0, 5.0), (1.0, -4.0)])
def test_an_oscillation_is_found_from_any_phase_and_from_none(start: tuple[float, float]) -> None:
    """By amplitude and phase it ends at no amplitude from an opposite phase, where no phase leads anywhere."""
    end = minimise(normal, np.array([*start, 1.0]), UNKNOWNS, tolerance=1e-9)
    assert end.status is FitStatus.CONVERGED
    assert end.iterations <= 8
    np.testing.assert_allclose(end.values, TRUTH, rtol=1e-4)
    np.testing.assert_allclose(end.data_information, normal(end.values).curvature)


def test_slopes_are_those_of_the_cost() -> None:
    search = SearchCoordinates(normal, None, UNKNOWNS, 1.0)
    z = search.begun(np.array([0.7, -1.0, 2.0]))
    np.testing.assert_allclose(search.values(z), [0.7, -1.0, 2.0])
    gradient, _ = search.slopes(z, search.at(z)[1])
    moves = 1e-6 * np.eye(3)
    slopes = [(search.at(z + move)[0] - search.at(z - move)[0]) / 2e-6 for move in moves]
    np.testing.assert_allclose(gradient, -0.5 * np.array(slopes), rtol=1e-6)


def test_an_amplitude_stays_within_its_range() -> None:
    search = SearchCoordinates(normal, None, UNKNOWNS, 1.0)
    assert search.values(np.array([0.9, 0.9, 0.0]))[0] == 1.0
    assert search.values(np.zeros(3))[0] == FAINT


def test_a_phase_that_is_known_beforehand_is_searched_itself() -> None:
    known = replace(UNKNOWNS[1], prior=1.0, prior_std=0.1)
    search = SearchCoordinates(normal, None, (UNKNOWNS[0], known, UNKNOWNS[2]), 1.0)
    values = np.array([0.3, 1.2, 1.0])
    np.testing.assert_allclose(search.begun(values), [0.3, 1.2, 0.0])
