"""The transfer function of cpp/include/rwn/simulate/transfer_function.hpp in NumPy, as plain as can be."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def state_space(numerator: Array, denominator: Array) -> tuple[Array, Array]:
    """A (n, n), b (n,) of the observer form of b_0.. (n,) over a_0.. (n,), 1; the output is the first state."""
    n = denominator.size
    a = np.diag(np.ones(n - 1), 1)
    a[:, 0] = -denominator[::-1]
    return a, np.array(numerator[::-1])


def states(a: Array, b: Array, time: Array, held: Array, start: Array | None = None) -> Array:
    """States (n_t, n) at the instants `time` under an input held from each to the next."""
    from scipy.linalg import expm  # late: scipy takes half a second to load

    n = b.size
    block = np.zeros((n + 1, n + 1))
    block[:n, :n], block[:n, n] = a, b
    x = np.zeros((time.size, n))
    x[0] = 0.0 if start is None else start
    step, last = np.eye(n + 1), -1.0
    for k, h in enumerate(np.diff(time)):
        if abs(h - last) > 1e-9 * h:
            step, last = expm(block * h), h
        x[k + 1] = step[:n, :n] @ x[k] + step[:n, n] * held[k]
    return x
