"""Mother wavelets (thesis section 2.1)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import Array

WAVELETS: tuple[str, ...] = tuple(_core.wavelet_names())


@dataclass(frozen=True)
class Wavelet:
    """A mother wavelet by its name: one of `WAVELETS`.

    `gaussian-derivative` is -z exp(-z^2/2) (2.2), `mexican-hat` (1 - z^2) exp(-z^2/2), `morlet` exp(-z^2/2)
    cos(omega0 z) (2.3). `omega0` [rad] is used by Morlet only; its mean is nearly zero (9e-6) at 5 and 0.54
    at 1.75. `core`: the same in C++.

    Raises ValueError for an unknown name or omega0 <= 0.
    """

    name: str = "gaussian-derivative"
    omega0: float = 5.0
    core: _core.Wavelet = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "core", _core.Wavelet(self.name, self.omega0))

    def value(self, z: ArrayLike) -> Array:
        """phi(z), elementwise. Raises InputError for what is no array of numbers."""
        return self.core.value(_floats(z))

    def derivative(self, z: ArrayLike) -> Array:
        """phi'(z), elementwise. Raises InputError for what is no array of numbers."""
        return self.core.derivative(_floats(z))

    def second_derivative(self, z: ArrayLike) -> Array:
        """phi''(z), elementwise. Raises InputError for what is no array of numbers."""
        return self.core.second_derivative(_floats(z))

    @property
    def max_value(self) -> float:
        """max |phi|, rounded up."""
        return self.core.max_value

    @property
    def max_derivative(self) -> float:
        """max |phi'|, rounded up; 1 only for the Gaussian derivative, where the thesis (3.52) takes 1 for
        all."""
        return self.core.max_derivative

    @property
    def max_scaled_derivative(self) -> float:
        """max |z phi'(z)|, rounded up: bounds the dilation's sensitivity without the input's range."""
        return self.core.max_scaled_derivative


def _floats(z: ArrayLike) -> Array:
    array = np.asarray(z)
    if array.dtype.kind not in "fiub":
        raise ValueError(f"z must hold real numbers, got {array.dtype}")
    return np.ascontiguousarray(array, dtype=np.float64)


def dyadic_places(count: int) -> tuple[tuple[float, float], ...]:
    """(centre, dilation) of the first `count` wavelets of a dyadic grid over [0, 1] (2.10-2.11)."""
    places = [((k + 0.5) / 2**level, 0.7 / 2**level) for level in range(5) for k in range(2**level)]
    return tuple(places[:count])
