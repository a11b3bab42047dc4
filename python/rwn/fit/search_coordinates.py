"""The coordinates in which unknowns are searched, and the problem in them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rwn.fit.unknown import Unknown, prior_weight, ties
from rwn.simulate.simulator import NormalEquations

Array = NDArray[np.float64]

FAINT = 1e-12  # least amplitude, of its largest: from 0 no phase leads anywhere; below what counts as none (fit.IDLE)


Evaluate = Callable[[Array], NormalEquations]


class SearchCoordinates:
    """The problem in the coordinates that it is searched in.

    Positive unknowns are searched as their logarithms, an amplitude a and a phase p as a cos p and a sin p: what an
    oscillation does is linear in these, while by a phase no step is short, and at no amplitude none leads anywhere.
    """

    def __init__(
        self, evaluate: Evaluate, probe: Evaluate | None, unknowns: tuple[Unknown, ...], prior_scale: float
    ) -> None:
        self.evaluate, self.probe, self.unknowns = evaluate, probe, unknowns
        self.logarithmic = np.array([u.logarithmic for u in unknowns], dtype=bool)
        self.lower = np.array([u.coordinate(u.lower) for u in unknowns])
        self.upper = np.array([u.coordinate(u.upper) for u in unknowns])
        self.prior = np.array([u.coordinate(u.prior) if u.prior is not None else 0.0 for u in unknowns])
        self.prior_scale = prior_scale
        self.weight = prior_scale * np.array([prior_weight(u) for u in unknowns])
        self.tie = prior_scale * ties(unknowns)
        self.oscillations = _oscillations(unknowns)
        for amplitude, phase in self.oscillations:
            self.lower[[amplitude, phase]] = -self.upper[amplitude]
            self.upper[phase] = self.upper[amplitude]

    def begun(self, values: Array) -> Array:
        """Search coordinates (p,) of values (p,), within the bounds."""
        within = zip(self.unknowns, values, strict=True)
        z = np.array([u.coordinate(float(np.clip(v, u.lower, u.upper))) for u, v in within])
        for amplitude, phase in self.oscillations:
            z[[amplitude, phase]] = z[amplitude] * np.array([np.cos(z[phase]), np.sin(z[phase])])
        clipped: Array = np.clip(z, self.lower, self.upper)
        return clipped

    def values(self, z: Array) -> Array:
        """Values (p,) at search coordinates (p,)."""
        values: Array = np.where(self.logarithmic, np.exp(np.where(self.logarithmic, z, 0.0)), z)
        for amplitude, phase in self.oscillations:
            most = self.upper[amplitude]
            values[amplitude] = np.clip(np.hypot(z[amplitude], z[phase]), FAINT * most, most)
            values[phase] = np.arctan2(z[phase], z[amplitude])
        return values

    def at(self, z: Array, known: NormalEquations | None = None) -> tuple[float, NormalEquations]:
        """Cost at search coordinates (p,), and what it is made of: simulated, where it is not `known`."""
        return self._priced(z, known or self.evaluate(self.values(z)))

    def tried(self, z: Array, bar: float, *, last: bool, doubted: bool) -> tuple[float, NormalEquations]:
        """Cost at `z` (p,) and what it is made of.

        Without derivatives in the last iteration, and where it is in doubt and above `bar`.
        """
        if self.probe is None or not (last or doubted):
            return self.at(z)
        probed = self._priced(z, self.probe(self.values(z)))
        return self.at(z) if probed[0] < bar and not last else probed

    def _priced(self, z: Array, normal: NormalEquations) -> tuple[float, NormalEquations]:
        large = float(np.max(np.abs(normal.curvature), initial=0.0))
        if not normal.finite or not np.isfinite(normal.chi2) or large > 1e150:
            return np.inf, normal
        off = z - self.prior
        return normal.chi2 + float(np.sum(self.weight * off**2) + z @ self.tie @ z), normal

    def slopes(self, z: Array, normal: NormalEquations) -> tuple[Array, Array]:
        """-gradient/2 (p,) and curvature (p, p) of the cost at search coordinates `z` (p,)."""
        values = self.values(z)
        turn = np.diag(np.where(self.logarithmic, values, 1.0))  # (p, p) of values by coordinates
        for amplitude, phase in self.oscillations:
            cos, sin = np.cos(values[phase]), np.sin(values[phase])
            turn[amplitude, [amplitude, phase]] = cos, sin
            turn[phase, [amplitude, phase]] = np.array([-sin, cos]) / values[amplitude]
        gradient = turn.T @ normal.gradient - self.weight * (z - self.prior) - self.tie @ z
        curvature = turn.T @ normal.curvature @ turn + np.diag(self.weight) + self.tie
        return gradient, curvature

    def information(self, z: Array, normal: NormalEquations) -> Array:
        """Curvature of the cost by values, (p, p), with priors as they are for white residuals."""
        slope = np.where(self.logarithmic, self.values(z), 1.0)
        priors = (np.diag(self.weight) + self.tie) / np.outer(slope, slope)  # an oscillation has none
        found: Array = normal.curvature + priors / self.prior_scale
        return found


def _oscillations(unknowns: tuple[Unknown, ...]) -> list[tuple[int, int]]:
    """Places of amplitudes and phases of which nothing is known beforehand."""
    names = [u.name for u in unknowns]
    pairs = [(names.index(u.amplitude), k) for k, u in enumerate(unknowns) if u.amplitude in names]
    return [pair for pair in pairs if not any(prior_weight(unknowns[k]) for k in pair)]
