"""Whether a position errs as under a torque that is new in every row: what a free run makes of an input known roughly.

A free run adds up every torque that is not known, as that between two rows which a logger did not keep. The error e of
a position under white torque and with white noise of its sensor has, once the drive's answer is undone,

    r_k = (1 - z)(1 - a z) e_k,    S(w) = f + m |1 - exp(-iw)|^2 |1 - a exp(-iw)|^2,

a from `speed_filter`. A law that is missing acts with the motion, and leaves more at some frequencies than either.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.fit.whiteness import distance_from_level

Array = NDArray[np.float64]

RATIOS = np.logspace(-6.0, 9.0, 121)  # m / f: the noise of the sensor alone is all, or nothing, at their ends
FEWEST = 64  # samples below which nothing is told


def distance_from_disturbance(error: Array, share: float) -> float:
    """sqrt(n) times the largest distance of a cumulative periodogram of n frequencies from that of a disturbance.

    `error` (n,) of a position in free run, NaN where it was not compared; `share`: a. Each frequency counts relative to
    the likeliest f and m (Whittle 1953); it is a distance as in Bartlett's test, and infinite where nothing is told.
    """
    known = np.flatnonzero(np.isfinite(error))
    if known.size < FEWEST:
        return np.inf
    filled = np.interp(np.arange(known[0], known[-1] + 1), known, error[known])
    answered = np.diff(filled)
    torque = answered[1:] - share * answered[:-1]
    power = np.abs(np.fft.rfft(torque - torque.mean())[1 : (torque.size + 1) // 2]) ** 2
    turn = np.exp(-2j * np.pi * np.arange(1, power.size + 1) / torque.size)
    sensor = np.abs((1.0 - turn) * (1.0 - share * turn)) ** 2
    shapes = 1.0 + RATIOS[:, None] * sensor
    levels = np.mean(power / shapes, axis=1)
    likeliest = int(np.argmin(np.log(np.maximum(levels, 1e-300)) + np.mean(np.log(shapes), axis=1)))
    return distance_from_level(power / shapes[likeliest])
