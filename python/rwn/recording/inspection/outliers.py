"""The few samples of a signal, or of its error, that are far beyond all others, each by itself."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

LEVEL = 0.01  # chance that one is found in Gaussian noise, in all samples together
RARE = 0.02  # most of the samples that may be some: a signal that jumps more often does so by itself
BESIDE = 0.25  # most that a signal may move beside one, and that any other may be off, in units of what it is off
REACH = 2  # samples on either side that one may spoil


def most_deviations(samples: int) -> float:
    """Deviations that none of so many normal numbers is off, but in one case of 1 / `LEVEL`."""
    from scipy.special import ndtri  # late: the command line starts without it

    return float(-ndtri(0.5 * LEVEL / samples))


def outliers(sizes: Array, *, limit: float, among: int, alone: Callable[[int], bool]) -> Flags:
    """Which samples are off by more than the limit, and by much more than all that are not among them, (n,).

    Args:
        sizes: how far each sample (n,) is off.
        limit: of noise.
        among: how many samples they are among, of which few may be some.
        alone: whether the sample at an index is off by itself.
    """
    from scipy.ndimage import maximum_filter1d  # late: the command line starts without it

    found, most = np.zeros(sizes.size, dtype=bool), int(RARE * among)
    if most == 0:
        return found
    peaks = np.flatnonzero((sizes > 0.0) & (sizes == maximum_filter1d(sizes, 4 * REACH + 1)))
    peaks = peaks[np.argsort(-sizes[peaks], kind="stable")]
    usual = np.append(sizes[peaks], 0.0)[1:]  # the largest of those that are left
    for count, at in enumerate(peaks[:most]):
        if sizes[at] <= limit or not alone(int(at)):
            break
        if BESIDE * sizes[at] > usual[count]:
            found[peaks[: count + 1]] = True
    return found
