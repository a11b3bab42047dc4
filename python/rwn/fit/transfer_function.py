"""The output error of a transfer function, whose initial state is estimated recording by recording."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from rwn.fit.problem import CountedNormal, OutputError, Target
from rwn.model.vocabulary import state_indices
from rwn.simulate.transfer_function import state_space, states

Array = NDArray[np.float64]
STARTS_OF_STATE = 16  # most starts of the search for an initial state


@dataclass(frozen=True, kw_only=True)
class TransferError(OutputError):
    """As OutputError; where `at_rest` is false the initial state of each recording is eliminated from its fit.

    On a recording whose first samples are not judged the state is estimated from these alone, with the spread of the
    states along the fitted recordings as prior: a few samples say little of a state of high order.
    """

    at_rest: bool = True

    def parameters_for(self, target: Target, vector: Array, active: Sequence[int]) -> Array:
        """The parameter vector with the initial state of this recording filled in."""
        if self.at_rest:
            return vector
        if target.judged_from:
            return self._from_first_samples(target, vector, active)
        return self._best_state(target, vector, active, [np.zeros(self.order)], None)

    def normal_of(
        self, target: Target, vector: Array, active: Sequence[int], by: Sequence[int]
    ) -> CountedNormal:
        """Normal equations of one recording, its initial state eliminated (Schur complement at its optimum)."""
        if self.at_rest:
            return self.normal_at(target, vector, active, by)
        own = self.parameters_for(target, vector, active)
        p = len(by)
        joint = self.normal_at(target, own, active, [*by, *state_indices(self.order)])
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

    def _from_first_samples(self, target: Target, vector: Array, active: Sequence[int]) -> Array:
        k = max(target.judged_from, 2)
        first = replace(
            target, time=target.time[:k], input=target.input[:k], speed=target.speed[:k], angle=target.angle[:k]
        )
        a, b = state_space(*self._coefficients(vector))
        seen = np.concatenate([states(a, b, t.time, t.input) for t in self.targets])
        spread = np.cov(seen.T).reshape(self.order, self.order)
        values, axes = np.linalg.eigh(spread)
        root = axes * np.sqrt(np.maximum(values, 0.0))  # columns: one standard deviation along each axis
        signs = np.array(list(product((1.0, -1.0), repeat=min(self.order, 4))))[:STARTS_OF_STATE]
        leading = root[:, -signs.shape[1] :]
        starts = [np.zeros(self.order), *(leading @ s for s in signs)]
        return self._best_state(first, vector, active, starts, np.linalg.pinv(spread, rcond=1e-9, hermitian=True))

    def _coefficients(self, vector: Array) -> tuple[Array, Array]:
        """Numerator b_0.. and denominator a_0.. (order,) of a parameter vector."""
        from rwn.model.vocabulary import motor_index

        b, a = (motor_index(f"{letter}0") for letter in "ba")
        return vector[b : b + self.order], vector[a : a + self.order]

    def _best_state(
        self, target: Target, vector: Array, active: Sequence[int], starts: Sequence[Array], prior: Array | None
    ) -> Array:
        """`vector` with the initial state that fits the recording best, from the best of several starts."""
        found = [self._descend(target, vector, active, start, prior) for start in starts]
        return min(found, key=lambda pair: pair[0])[1]

    def _descend(
        self, target: Target, vector: Array, active: Sequence[int], start: Array, prior: Array | None
    ) -> tuple[float, Array]:
        """Gauss-Newton on the initial state alone: one step where the sensor is linear."""
        index = state_indices(self.order)
        weight = np.zeros((self.order, self.order)) if prior is None else prior
        best, here, at = np.inf, vector.copy(), start
        for _ in range(12):
            trial = vector.copy()
            trial[index] = at
            normal = self.normal_at(target, trial, active, index)
            cost = normal.chi2 + float(at @ weight @ at)
            if not normal.finite or not np.isfinite(cost) or cost >= best - 1e-6 * abs(best):
                break
            best, here = cost, trial
            sizes = np.diag(normal.curvature + weight)
            if not sizes.any() or not np.isfinite(normal.curvature).all():
                break  # the recording does not depend on the state, or the run leaves the finite numbers
            scale = 1.0 / np.sqrt(np.maximum(sizes, 1e-12 * sizes.max()))
            system = (normal.curvature + weight) * np.outer(scale, scale) + 1e-9 * np.eye(self.order)
            at = at + scale * np.linalg.solve(system, scale * (normal.gradient - weight @ at))
        return best, here
