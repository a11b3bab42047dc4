"""How far a periodogram is from that of white noise: Bartlett's test of its cumulative shares."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def distance_from_level(power: Array, *, fast: bool = True) -> float:
    """sqrt(n) times the largest distance of the cumulative shares of a periodogram (n,) from a straight line.

    `fast`: also where the shares are below it, as of errors that are mostly fast. Infinite where there is no power.
    """
    shares = np.cumsum(power)
    if not shares[-1] > 0.0:
        return np.inf
    above = shares / shares[-1] - np.arange(1, power.size + 1) / power.size
    return float(np.sqrt(power.size) * np.max(np.abs(above) if fast else above))
