"""First guesses of a transfer function of given order: poles on a grid of time constants, gain by least squares."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.fit.problem import Target
from rwn.simulate.transfer_function import state_space, states

Array = NDArray[np.float64]
TIME_CONSTANTS = (3.0, 10.0, 30.0, 100.0)  # of the slowest pole, in samples
FASTER = (1.0, 4.0)  # the other poles against it
DAMPING = 0.3


def first_guesses(targets: Sequence[Target], order: int) -> list[dict[str, float]]:
    """Coefficients b0.., a0.. of several guesses, the one that explains the recorded speed best first.

    The magnitude of the speed is compared: which way a sensor counts is not known yet.
    """
    step = float(np.median(np.concatenate([np.diff(t.time) for t in targets])))
    found = []
    for slow in TIME_CONSTANTS:
        for faster in FASTER:
            denominator = _denominator(order, 1.0 / (slow * step), faster)
            numerator = np.zeros(order)
            numerator[0] = denominator[0]
            runs = [states(*state_space(numerator, denominator), t.time, t.input)[:, 0] for t in targets]
            shown = np.abs(np.concatenate(runs))
            seen = np.abs(np.concatenate([t.speed for t in targets]))
            gain = float(shown @ seen / max(float(shown @ shown), 1e-300))
            error = float(np.sum((seen - gain * shown) ** 2))
            values = {f"b{k}": gain * b for k, b in enumerate(numerator)}
            found.append((error, values | {f"a{k}": a for k, a in enumerate(denominator)}))
    return [{k: float(v) for k, v in guess.items()} for _, guess in sorted(found, key=lambda pair: pair[0])]


def _denominator(order: int, rate: float, faster: float) -> Array:
    """a_0.. (order,) of a real pole at `rate` and damped pairs at `faster` and multiples of it."""
    poles = [complex(-rate)] if order % 2 else []
    for k in range(1, order // 2 + 1):
        pole = faster * k * rate * complex(-DAMPING, np.sqrt(1.0 - DAMPING**2))
        poles += [pole, pole.conjugate()]
    coefficients: Array = np.real(np.poly(poles))
    return coefficients[1:][::-1]
