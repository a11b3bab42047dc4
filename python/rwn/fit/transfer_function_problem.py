"""The problem of a transfer function: its initial state is eliminated, coefficients may have no first values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from rwn.fit.problem import Problem
from rwn.model.vocabulary import motor_index, state_indices
from rwn.simulate.coefficient_state import nearest_state
from rwn.simulate.run import Run
from rwn.simulate.simulator import NormalEquations
from rwn.simulate.transfer_function import state_space, states

Array = NDArray[np.float64]

STARTS_OF_STATE = 16  # most starts of the search for an initial state
TIME_CONSTANTS = (3.0, 10.0, 30.0, 100.0)  # first guesses of the slowest pole, in samples
FASTER = (1.0, 4.0)  # first guesses of the other poles against it
DAMPING_RATIO = 0.3  # damping ratio of the first guesses of pairs of poles


@dataclass(frozen=True, kw_only=True)
class TransferFunctionProblem(Problem):
    """As Problem; where `at_rest` is false the initial state of each run is eliminated from its fit.

    On a run whose first samples are not judged the state is estimated from these alone, with the spread of the states
    along the fitted runs as prior: a few samples say little of a state of high order.
    """

    at_rest: bool = True

    @property
    def order(self) -> int:
        """Of the transfer function."""
        return self.simulator.order

    def started(self, run: Run, vector: Array, active: Sequence[int]) -> Array:
        """The parameter vector (all,) with the initial state of this run filled in."""
        if self.at_rest:
            return vector
        starts, prior = None, None
        if run.judged_from:
            run, starts, prior = self._first_samples(run, vector)
        return nearest_state(
            self.simulator, run, vector, active, noise=self.noise, starts=starts, prior=prior
        )

    def normal_of(self, run: Run, vector: Array, active: Sequence[int], by: Sequence[int]) -> NormalEquations:
        """Normal equations (p, p), (p,) of one run, its initial state eliminated (Schur complement at its optimum)."""
        if self.at_rest:
            return self.normal_at(run, vector, active, by)
        own = self.started(run, vector, active)
        p = len(by)
        joint = self.normal_at(run, own, active, [*by, *state_indices(self.order)])
        if not joint.finite or not np.isfinite(joint.curvature).all():
            return replace(joint, gradient=joint.gradient[:p], curvature=joint.curvature[:p, :p], finite=False)
        inner = joint.curvature[p:, p:]
        scale = 1.0 / np.sqrt(np.maximum(np.diag(inner), 1e-300))
        cross = joint.curvature[:p, p:] * scale
        damped = inner * np.outer(scale, scale) + 1e-9 * np.eye(self.order)
        weights = np.linalg.solve(damped, cross.T).T
        return replace(
            joint,
            gradient=joint.gradient[:p] - weights @ (joint.gradient[p:] * scale),
            curvature=joint.curvature[:p, :p] - weights @ cross.T,
        )

    def _first_samples(self, run: Run, vector: Array) -> tuple[Run, list[Array], Array]:
        """The samples that the state is estimated from, starts of that estimate, and the weight of its prior."""
        k = max(run.judged_from, 2)
        first = run.until(k)
        a, b = state_space(*self._coefficients(vector))
        seen = np.concatenate([states(a, b, r.time, r.input) for r in self.runs])
        spread = np.cov(seen.T).reshape(self.order, self.order)
        values, axes = np.linalg.eigh(spread)
        root = axes * np.sqrt(np.maximum(values, 0.0))  # columns: one standard deviation along each axis
        signs = np.array(list(product((1.0, -1.0), repeat=min(self.order, 4))))[:STARTS_OF_STATE]
        leading = root[:, -signs.shape[1] :]
        starts = [np.zeros(self.order), *(leading @ s for s in signs)]
        return first, starts, np.linalg.pinv(spread, rcond=1e-9, hermitian=True)

    def _coefficients(self, vector: Array) -> tuple[Array, Array]:
        """Numerator b_0.. and denominator a_0.. (order,) of a parameter vector."""
        b, a = (motor_index(f"{letter}0") for letter in "ba")
        return vector[b : b + self.order], vector[a : a + self.order]


def first_guesses(runs: Sequence[Run], order: int) -> list[Mapping[str, float]]:
    """Coefficients b0.., a0.. of several guesses, the one that explains the recorded speed best first.

    The magnitude of the speed is compared: which way a sensor counts is not known yet.
    """
    step = float(np.median(np.concatenate([np.diff(r.time) for r in runs])))
    found = []
    for slow in TIME_CONSTANTS:
        for faster in FASTER:
            denominator = _denominator(order, 1.0 / (slow * step), faster)
            numerator = np.zeros(order)
            numerator[0] = denominator[0]
            outputs = [states(*state_space(numerator, denominator), r.time, r.input)[:, 0] for r in runs]
            shown = np.abs(np.concatenate(outputs))
            seen = np.abs(np.concatenate([r.speed for r in runs]))
            gain = float(shown @ seen / max(float(shown @ shown), 1e-300))
            error = float(np.sum((seen - gain * shown) ** 2))
            values = {f"b{k}": gain * b for k, b in enumerate(numerator)}
            found.append((error, values | {f"a{k}": a for k, a in enumerate(denominator)}))
    return [{k: float(v) for k, v in guess.items()} for _, guess in sorted(found, key=lambda pair: pair[0])]


def _denominator(order: int, rate: float, faster: float) -> Array:
    """a_0.. (order,) of a real pole at `rate` and damped pairs at `faster` and multiples of it."""
    poles = [complex(-rate)] if order % 2 else []
    for k in range(1, order // 2 + 1):
        pole = faster * k * rate * complex(-DAMPING_RATIO, np.sqrt(1.0 - DAMPING_RATIO**2))
        poles += [pole, pole.conjugate()]
    coefficients: Array = np.real(np.poly(poles))
    return coefficients[1:][::-1]
