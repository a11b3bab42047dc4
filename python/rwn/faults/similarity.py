"""How alike a recorded signal is to its simulation: by the energy of each and of their product."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FAR = 1.4  # size of a signal against its simulation from which its scale is doubted
STILL = 1e-30  # energy over that of the other, at which a signal does not move: no unit and no gear comes near
ONE_SIDED = 0.02  # of a signal's largest value: as much of the other sign is noise


@dataclass(frozen=True)
class Similarity:
    """Of a signal and its simulation: the ratio of their sizes, and their correlation, beside a level."""

    ratio: float
    correlation: float
    whole: tuple[float, float]  # the same of the signals as they are, with their level

    @classmethod
    def of(cls, pairs: Sequence[tuple[Array, Array]], *, levelled: bool = False) -> Similarity:
        """From recorded and simulated samples (n,) of every recording; where no direction is shown, of the magnitudes.

        `levelled`: beside a level that dry friction may have taken from the recorded ones.
        """
        recorded = np.concatenate([r for r, _ in pairs])
        simulated = np.concatenate([s for _, s in pairs])
        known = np.isfinite(recorded) & np.isfinite(simulated)
        recorded, simulated = recorded[known], simulated[known]
        if _one_sided(recorded) and not _one_sided(simulated):
            simulated = np.abs(simulated)
        whole = _moments(recorded, simulated)
        return cls(*(_moments(*_without_level(recorded, simulated)) if levelled else whole), whole)

    @property
    def far(self) -> bool:
        """Whether sign or size is so far off that the scale of the signal is doubted."""
        return self.correlation < 0.0 or abs(np.log(self.ratio)) > np.log(FAR)

    def misfit(self, factor: float) -> float:
        """Mean square of what is left with `factor` undone, over the sizes of both; 0 if they are the same."""
        return _misfit(self.ratio, self.correlation, factor)

    def bettered(self, factor: float) -> bool:
        """Whether undoing `factor` brings the signal nearer with its level too: a scale multiplies that as well."""
        return _misfit(*self.whole, factor) < _misfit(*self.whole, 1.0)


def _moments(recorded: Array, simulated: Array) -> tuple[float, float]:
    """Ratio of their sizes, and correlation."""
    yy, xx = float(recorded @ recorded), float(simulated @ simulated)
    if min(xx, yy) <= STILL * max(xx, yy) or xx * yy == 0.0:
        return 1.0, 0.0  # one of them does not move: there is no scale to judge
    return float(np.sqrt(yy / xx)), float(recorded @ simulated) / float(np.sqrt(xx * yy))


def _misfit(ratio: float, correlation: float, factor: float) -> float:
    off = ratio / abs(factor)
    return float(off + 1.0 / off - 2.0 * np.sign(factor) * correlation)


def _without_level(recorded: Array, simulated: Array) -> tuple[Array, Array]:
    """Both without their mean along the simulated direction, where the recorded one lacks some of it.

    Dry friction, a dead zone, a brush drop and a load take the same speed away at every speed; a wrong scale takes a
    share. Nothing gives a level on top: then both are left as they are.
    """
    direction = np.sign(simulated)
    moving = max(float(np.count_nonzero(direction)), 1.0)
    levels = [float(direction @ x) / moving for x in (recorded, simulated)]
    y, x = (values - level * direction for values, level in zip((recorded, simulated), levels, strict=True))
    slope = float(np.sqrt((y @ y) / max(float(x @ x), 1e-200)))
    towards = 1.0 if float(y @ x) >= 0.0 else -1.0
    return (y, x) if slope * levels[1] > towards * levels[0] else (recorded, simulated)


def _one_sided(signal: Array) -> bool:
    least = ONE_SIDED * float(np.max(np.abs(signal), initial=0.0))
    return bool(np.all(signal >= -least) or np.all(signal <= least))
