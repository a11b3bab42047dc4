"""Reference for the mother wavelets: value, first and second derivative as written in the thesis, section 2.1."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rwn.networks.arrays import Array


class Derivatives(NamedTuple):
    """phi, phi' and phi'' at z."""

    value: Array
    first: Array
    second: Array


def gaussian_derivative(z: Array, omega0: float) -> Derivatives:  # noqa: ARG001
    """-z exp(-z^2/2) (2.2)."""
    g = np.exp(-(z**2) / 2)
    return Derivatives(-z * g, (z**2 - 1) * g, (3 * z - z**3) * g)


def mexican_hat(z: Array, omega0: float) -> Derivatives:  # noqa: ARG001
    """(1 - z^2) exp(-z^2/2)."""
    g = np.exp(-(z**2) / 2)
    return Derivatives((1 - z**2) * g, (z**3 - 3 * z) * g, (-(z**4) + 6 * z**2 - 3) * g)


def morlet(z: Array, omega0: float) -> Derivatives:
    """exp(-z^2/2) cos(omega0 z) (2.3)."""
    g = np.exp(-(z**2) / 2)
    c, s = np.cos(omega0 * z), np.sin(omega0 * z)
    return Derivatives(
        g * c, g * (-z * c - omega0 * s), g * ((z**2 - 1 - omega0**2) * c + 2 * omega0 * z * s)
    )


WAVELETS = {"gaussian-derivative": gaussian_derivative, "mexican-hat": mexican_hat, "morlet": morlet}
