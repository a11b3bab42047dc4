"""Recurrent wavelet network: wavelets with self-feedback, one output (thesis chapter 3)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import Array, as_float_array, as_patterns, read_only
from rwn.networks.wavelets import Wavelet


@dataclass(frozen=True, eq=False, kw_only=True)
class RecurrentNetwork:
    """yhat(n) = b + sum_j w_j Phi_j(n) + sum_i a_i x_i(n), Phi_j = prod_i phi(z_ji) (3.1-3.2),
    z_ji(n) = (x_i(n) + c_ji phi(z_ji(n-1)) - m_ji) / d_ji (3.3).

    `b` a number, `a` (inputs,), `w` (wavelets,), `m`, `d`, `c` (wavelets, inputs); read-only. `wavelet`: phi.
    Raises ValueError if shapes disagree or a dilation is 0.
    """

    groups: ClassVar[tuple[str, ...]] = ("b", "a", "w", "m", "d", "c")
    b: float
    a: Array
    w: Array
    m: Array
    d: Array
    c: Array
    wavelet: Wavelet = field(default_factory=Wavelet)

    def __post_init__(self) -> None:
        object.__setattr__(self, "b", float(self.b))
        for name, ndim in (("a", 1), ("w", 1), ("m", 2), ("d", 2), ("c", 2)):
            object.__setattr__(self, name, read_only(as_float_array(name, getattr(self, name), ndim).copy()))
        if len(self.a) < 1:
            raise ValueError("a must have one entry per input, at least 1")
        shape = (self.wavelets, self.inputs)
        for name in ("m", "d", "c"):
            if getattr(self, name).shape != shape:
                raise ValueError(
                    f"{name} must be (wavelets, inputs) = {shape}, got {getattr(self, name).shape}"
                )
        if (self.d == 0).any():
            raise ValueError("a dilation d is 0; give every wavelet a width")

    @property
    def inputs(self) -> int:
        """Number of inputs."""
        return len(self.a)

    @property
    def wavelets(self) -> int:
        """Number of wavelets."""
        return len(self.w)

    @property
    def theta(self) -> Array:
        """All parameters (n_parameters,): [b, a, w, m, d, c], matrices row by row."""
        return np.concatenate([[self.b], self.a, self.w, self.m.ravel(), self.d.ravel(), self.c.ravel()])

    def with_theta(self, theta: ArrayLike) -> RecurrentNetwork:
        """The same network with other parameters theta (n_parameters,): [b, a, w, m, d, c].

        Raises ValueError for a wrong number.
        """
        values = as_float_array("theta", theta, 1)
        if len(values) != len(self.theta):
            raise ValueError(
                f"theta must have {len(self.theta)} entries [b, a, w, m, d, c], got {len(values)}"
            )
        a, w, rest = np.split(values[1:], [self.inputs, self.inputs + self.wavelets])
        m, d, c = rest.reshape(3, self.wavelets, self.inputs)
        return replace(self, b=float(values[0]), a=a, w=w, m=m, d=d, c=c)

    @property
    def core(self) -> _core.RecurrentNetwork:
        """The same network in the C++ core."""
        return _core.RecurrentNetwork(self.theta, self.inputs, self.wavelet.core)

    def simulate(self, x: ArrayLike) -> Array:
        """Output (n,) for the inputs x (n, inputs); one dimension is read as one input."""
        return self.core.simulate(self.as_inputs(x))

    def sensitivities(self, x: ArrayLike) -> tuple[Array, Array]:
        """Output (n,) for inputs x (n, inputs), its derivative by every entry of `theta` (n, parameters) (3.7-3.18)."""
        return self.core.sensitivities(self.as_inputs(x))

    def mse(self, x: ArrayLike, y: ArrayLike) -> float:
        """Mean squared error for inputs x (n, inputs) and wanted output y (n,), parameters frozen.

        Raises InputError for arrays of other shapes.
        """
        return float(np.mean((as_float_array("y", y, 1) - self.simulate(x)) ** 2))

    def as_inputs(self, x: ArrayLike) -> Array:
        """x as inputs (n, inputs). Raises ValueError where it is not."""
        inputs = as_patterns("x", x)
        if inputs.shape[1] != self.inputs:
            raise ValueError(f"x must have {self.inputs} column(s), one per input, got {inputs.shape[1]}")
        return inputs
