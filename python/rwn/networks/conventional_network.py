"""Conventional (static) wavelet network with several inputs and outputs (thesis section 2.2.1)."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import Array, as_float_array, as_pairs, as_patterns, read_only
from rwn.networks.wavelets import Wavelet


@dataclass(frozen=True, eq=False, kw_only=True)
class ConventionalNetwork:
    """yhat_k = b_k + sum_j w_kj Phi_j + sum_i a_ki x_i with Phi_j = prod_i phi((x_i - m_ji) / d_ji)
    (2.4-2.5).

    `wavelet`: the mother wavelet phi.
    Arrays: `b` (outputs,), `a` (outputs, inputs), `w` (outputs, wavelets), translations `m` and dilations `d`
    (wavelets, inputs); read-only. Raises ValueError if their shapes disagree or a dilation is zero.
    """

    wavelet: Wavelet
    b: Array
    a: Array
    w: Array
    m: Array
    d: Array

    def __post_init__(self) -> None:
        for name, ndim in (("b", 1), ("a", 2), ("w", 2), ("m", 2), ("d", 2)):
            array = as_float_array(name, getattr(self, name), ndim).copy()
            object.__setattr__(self, name, read_only(array))
        outputs, inputs, wavelets = self.outputs, self.inputs, self.wavelets
        for name, shape in (
            ("a", (outputs, inputs)),
            ("w", (outputs, wavelets)),
            ("m", (wavelets, inputs)),
            ("d", (wavelets, inputs)),
        ):
            got = getattr(self, name).shape
            if got != shape:
                raise ValueError(
                    f"{name} must have shape {shape} to go with b {self.b.shape}, a and w; got {got}"
                )
        if (self.d == 0).any():
            raise ValueError("dilations d must not be zero")

    @property
    def inputs(self) -> int:
        """Number of inputs."""
        return int(self.a.shape[1])

    @property
    def wavelets(self) -> int:
        """Number of wavelets."""
        return int(self.w.shape[1])

    @property
    def outputs(self) -> int:
        """Number of outputs."""
        return int(self.b.shape[0])

    @property
    def parameters(self) -> Array:
        """All parameters (n_parameters,): b, a, w, m, d, each row by row."""
        return np.concatenate([getattr(self, f.name).ravel() for f in fields(self)[1:]])

    def with_parameters(self, parameters: ArrayLike) -> ConventionalNetwork:
        """The network of the same shape with these parameters, in the order of `parameters`.

        Raises ValueError for a wrong number.
        """
        flat = as_float_array("parameters", parameters, 1)
        parts = [getattr(self, f.name) for f in fields(self)[1:]]
        if flat.size != sum(p.size for p in parts):
            raise ValueError(f"this network has {sum(p.size for p in parts)} parameters, got {flat.size}")
        b, a, w, m, d = (
            part.reshape(like.shape)
            for part, like in zip(np.split(flat, np.cumsum([p.size for p in parts])[:-1]), parts, strict=True)
        )
        return ConventionalNetwork(wavelet=self.wavelet, b=b, a=a, w=w, m=m, d=d)

    @property
    def core(self) -> _core.ConventionalNetwork:
        """The same network in the C++ core."""
        return _core.ConventionalNetwork(
            self.wavelet.core, self.inputs, self.wavelets, self.outputs, self.parameters
        )

    def output(self, x: ArrayLike) -> Array:
        """Outputs (patterns, outputs) for inputs x (patterns, inputs)."""
        return self.core.output(as_patterns("x", x))

    def mse(self, x: ArrayLike, y: ArrayLike) -> float:
        """Mean squared error (2.21) over patterns x (patterns, inputs) and wanted outputs y (patterns, outputs).

        Raises InputError for arrays of other shapes.
        """
        xs, ys = as_pairs(x, y)
        return float(np.mean((self.output(xs) - ys) ** 2))

    def gradient(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Gradient of 1/2 sum of squared errors (2.12) for x (patterns, inputs) and y (patterns, outputs), in
        the order of `parameters`; 2.13-2.19, with m and d summed over outputs, which the thesis omits.
        Raises InputError for arrays of other shapes."""
        return self.core.gradient(*as_pairs(x, y))

    def jacobian(self, x: ArrayLike) -> Array:
        """dyhat/dtheta (2.23): (patterns, outputs, parameters), for inputs x (patterns, inputs)."""
        xs = as_patterns("x", x)
        return self.core.jacobian(xs).reshape(self.outputs, len(xs), -1).transpose(1, 0, 2)
