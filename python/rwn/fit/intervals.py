"""Values of a fit with their 95 % intervals."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.residuals import Statistics
from rwn.fit.unknown import Unknown, prior_weight
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


def deviations(this: Fit, left: Statistics) -> Array:
    """Standard deviations (p,) of the unknowns in SI; see `covariance`."""
    result: Array = np.sqrt(np.maximum(np.diag(covariance(this, left)), 0.0))
    return result


def covariance(this: Fit, left: Statistics) -> Array:
    """Covariance (p, p) of the unknowns: that of white noise, widened by the residual's size and colour."""
    minimum = this.minimum
    information = minimum.data_information / (max(left.variance, 1.0) * left.correlation_time)
    information = information + (minimum.information - minimum.data_information)
    scale = np.sqrt(np.maximum(np.diag(information), 1e-300))
    scaled = np.linalg.pinv(information / np.outer(scale, scale), rcond=1e-13, hermitian=True)
    result: Array = scaled / np.outer(scale, scale)
    return result


class Left(Protocol):
    """What a fit leaves, as far as intervals go by it."""

    @property
    def misfit(self) -> float:
        """Share of its square that is no noise."""


@dataclass(frozen=True, kw_only=True)
class Widening:
    """What makes the values of a fit less sure than its noise."""

    birge: float = 1.0  # how much farther apart than their deviations values lie that were fitted to parts
    misfit_factor: float = 0.0  # how many times as far as noise of its size what the fit does not explain moves them

    def factor(self, left: Left) -> float:
        """Of the deviations of a fit that leaves so much."""
        return self.birge * math.hypot(1.0, self.misfit_factor * math.sqrt(left.misfit))


NO_WIDENING = Widening()


def estimates(this: Fit, left: Statistics, *, widening: Widening = NO_WIDENING) -> dict[str, Estimate]:
    """Value and 95 % interval of every unknown on which something depends, cut at its bounds; phases within a turn.

    No interval is widened beyond what was declared of the unknown: that holds whatever the fit does not explain.
    """
    seen = np.diag(this.minimum.information) > 0.0
    noise = deviations(this, left)
    sure = np.hypot(noise, _systematic(this))
    doubted = np.hypot(widening.factor(left) * noise, _systematic(this))
    found = {}
    for k, (u, fitted) in enumerate(zip(this.hypothesis.unknowns, this.minimum.values, strict=True)):
        if u.nuisance or not seen[k]:
            continue
        value = u.within_a_turn(float(fitted))
        low, high = _interval(u, value, float(doubted[k]))
        if u.prior is not None and (weight := prior_weight(u)):
            declared = weight**-0.5 * (u.prior if u.logarithmic else 1.0)
            ends = [_interval(u, value, float(sure[k])), _interval(u, u.prior, declared)]
            low, high = max(low, min(e[0] for e in ends)), min(high, max(e[1] for e in ends))
        found[u.name] = Estimate(value=value, unit=u.unit, interval=(low, high))
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


def least_deviation(effect: Effect, p: Parameter, value: float) -> float:
    """What the deviation of a parameter of an effect never falls below, for what noise does not show.

    A part of its value, of an angle in radians.
    """
    idealises = any(other.idealised for other in effect.parameters) and p.lower > 0.0
    return (IDEALISED if idealises else AGREEMENT) * (1.0 if p.cyclic else abs(value))


def _systematic(this: Fit) -> Array:
    """What the deviations (p,) of the unknowns never fall below; see `least_deviation`."""
    known = this.hypothesis.table
    effects = [known[name] for name in this.hypothesis.effects]
    of_effects = {f"{e.name}.{p.name}": (e, p) for e in effects for p in e.every}
    return np.array(
        [
            least_deviation(*of_effects[u.name], value) if u.name in of_effects else AGREEMENT * abs(value)
            for u, value in zip(this.hypothesis.unknowns, this.minimum.values, strict=True)
        ]
    )
