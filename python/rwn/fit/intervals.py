"""Values of a fit with their 95 % intervals."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.residuals import Statistics
from rwn.fit.unknown import Unknown
from rwn.model.vocabulary import Effect, Parameter

Array = NDArray[np.float64]

HALF_WIDTH = 1.96  # of a 95 % interval, in standard deviations
AGREEMENT = 1e-3  # relative standard deviation that stays when the noise is averaged out
IDEALISED = 4e-3  # relative standard deviation that stays for effects whose law idealises a contact


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """A number with its unit and 95 % interval (`None`: not estimated, e.g. fixed by the user)."""

    value: float
    unit: str
    interval: tuple[float, float] | None = None


def deviations(this: Fit, left: Statistics, *, samples: float | None = None) -> Array:
    """Standard deviations (p,) of the unknowns in SI; see `covariance`."""
    result: Array = np.sqrt(np.maximum(np.diag(covariance(this, left, samples=samples)), 0.0))
    return result


def covariance(this: Fit, left: Statistics, *, samples: float | None = None) -> Array:
    """Covariance (p, p) of the unknowns by errors of the size of what is `left`, and by what was declared of them.

    `samples`: for how many independent ones the recordings count (default: all that such noise is worth).
    """
    minimum = this.minimum
    counted = left.effective if samples is None else samples
    information = minimum.data_information * counted / (max(left.count, 1) * max(left.variance, 1.0))
    information = information + (minimum.information - minimum.data_information)
    scale = np.sqrt(np.maximum(np.diag(information), 1e-300))
    scaled = np.linalg.pinv(information / np.outer(scale, scale), rcond=1e-13, hermitian=True)
    result: Array = scaled / np.outer(scale, scale)
    return result


def estimates(this: Fit, left: Statistics, *, samples: float | None = None) -> dict[str, Estimate]:
    """Value and 95 % interval of every unknown on which something depends, cut at its bounds; phases within a turn.

    `samples`: see `covariance`. What was declared of an unknown holds however few the recordings count for.
    """
    seen = np.diag(this.minimum.information) > 0.0
    spread = np.hypot(deviations(this, left, samples=samples), _systematic(this))
    found = {}
    for k, (u, fitted) in enumerate(zip(this.hypothesis.unknowns, this.minimum.values, strict=True)):
        if u.nuisance or not seen[k]:
            continue
        value = u.within_a_turn(float(fitted))
        found[u.name] = Estimate(value=value, unit=u.unit, interval=_interval(u, value, float(spread[k])))
    return found


def _interval(u: Unknown, value: float, std: float) -> tuple[float, float]:
    """The 95 % interval about a value, within the unknown's bounds; a phase has none, and is within half a turn."""
    if u.cyclic:
        half = min(HALF_WIDTH * std, math.pi)
        return value - half, value + half
    if u.logarithmic and value > 0.0:
        factor = float(np.exp(min(HALF_WIDTH * std / value, 50.0)))
        return max(value / factor, u.lower), min(value * factor, u.upper)
    return max(value - HALF_WIDTH * std, u.lower), min(value + HALF_WIDTH * std, u.upper)


def _least(effect: Effect, p: Parameter, value: float) -> float:
    """What the deviation of a parameter of an effect never falls below, for what noise does not show.

    A part of its value, of an angle in radians.
    """
    idealises = any(other.idealised for other in effect.parameters) and p.lower > 0.0
    return (IDEALISED if idealises else AGREEMENT) * (1.0 if p.cyclic else abs(value))


def _systematic(this: Fit) -> Array:
    """What the deviations (p,) of the unknowns never fall below; see `_least`."""
    known = this.hypothesis.table
    effects = [known[name] for name in this.hypothesis.effects]
    of_effects = {f"{e.name}.{p.name}": (e, p) for e in effects for p in e.every}
    return np.array(
        [
            _least(*of_effects[u.name], value) if u.name in of_effects else AGREEMENT * abs(value)
            for u, value in zip(this.hypothesis.unknowns, this.minimum.values, strict=True)
        ]
    )
