"""A parameter to be found, and what is known of it beforehand."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Unknown:
    """A parameter to be found, as a coordinate of the search."""

    name: str
    unit: str
    index: int  # in the parameter vector
    lower: float
    upper: float
    logarithmic: bool = False  # searched as its logarithm
    prior: float | None = None
    prior_std: float = np.inf  # relative where logarithmic or `prior` is not 0
    tied_to: str = ""  # another logarithmic unknown that has about the same value
    tie_std: float = np.inf  # relative standard deviation of their ratio
    nuisance: bool = False  # of the recording, not of the drive: fitted, not reported
    level: bool = False  # of a quantity in one recording (measurement/levels.py)
    amplitude: str = ""  # the unknown whose oscillation this is the phase of; both are searched as its two parts
    cyclic: bool = False  # a phase: values a turn apart are one

    def coordinate(self, value: float) -> float:
        """Search coordinate of a value."""
        return float(np.log(value)) if self.logarithmic else value

    def value(self, coordinate: float) -> float:
        """Value at a search coordinate."""
        return float(np.exp(coordinate)) if self.logarithmic else coordinate

    def within_a_turn(self, value: float) -> float:
        """A phase at most half a turn from what was declared of it, or from 0; the value of anything else."""
        about = self.prior if self.prior is not None and prior_weight(self) else 0.0
        return value - math.tau * round((value - about) / math.tau) if self.cyclic else value


def ties(unknowns: tuple[Unknown, ...]) -> Array:
    """Curvature (p, p) of the priors on ratios."""
    names = [u.name for u in unknowns]
    tie = np.zeros((len(names), len(names)))
    for i, u in enumerate(unknowns):
        if u.tied_to in names and u.logarithmic:
            j = names.index(u.tied_to)
            tie[np.ix_([i, j], [i, j])] += np.array([[1.0, -1.0], [-1.0, 1.0]]) / u.tie_std**2
    return tie


def prior_weight(u: Unknown) -> float:
    """Curvature of its prior, in its search coordinate; 0: it has none."""
    if u.prior is None or not np.isfinite(u.prior_std):
        return 0.0
    scale = u.prior_std if u.logarithmic or u.prior == 0.0 else u.prior_std * abs(u.prior)
    return 1.0 / max(scale, 1e-12) ** 2


def prior_cost(unknowns: tuple[Unknown, ...], values: Array) -> float:
    """Squared deviations of values (p,) from their priors, and of tied ones from each other."""
    z = np.array([u.coordinate(float(v)) for u, v in zip(unknowns, values, strict=True)])
    off = z - np.array([u.coordinate(u.prior) if u.prior is not None else 0.0 for u in unknowns])
    return float(np.sum(np.array([prior_weight(u) for u in unknowns]) * off**2) + z @ ties(unknowns) @ z)
