"""How long a signal stood still from its first sample on."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.measurement.filter_colour import SLOWEST
from rwn.model.initial_state import CERTAIN
from rwn.recording.quantisation import resolution

Array = NDArray[np.float64]

# Deviation of noise that the slowest filter of a sensor has passed, over what its second differences show of it.
COLOURED = float(np.sqrt(6.0 / (6.0 - 8.0 * SLOWEST + 2.0 * SLOWEST**2)))
FEWEST = 3  # samples that stand still: fewer are what an inductance and an inertia take


def first_moved(signal: Array) -> int:
    """The first sample of a signal (n,) that has certainly left where it stood, and stays away; else the last.

    Where it stood and how noisy it is are estimated, for each sample, from the first half of the samples before it: a
    motion that sets in slowly hardly counts there. The limits are Student's, as few samples tell little. No more is
    taken for noise than a sensor's filter can make of the least change of the signal. It stays away where the median of
    as many samples that follow is beyond the limit as well.
    """
    from scipy.special import ndtr, stdtrit  # late: the command line starts without it

    half = np.maximum(np.arange(1, signal.size + 1) // 2, 1)
    off = signal - np.median(signal[:FEWEST])
    sums, squares = np.cumsum(off)[half - 1], np.cumsum(off**2)[half - 1]
    middle = sums / half
    least = _least_change(signal)
    rms = np.sqrt(np.maximum(squares / half - middle**2, 0.0))
    most = CERTAIN * COLOURED * least  # is not estimated from those samples, however few they are
    limit = np.maximum(np.minimum(stdtrit(half, ndtr(CERTAIN)) * rms, most), CERTAIN * least)
    moved = (int(k) for k in np.flatnonzero(np.abs(off - middle) > limit) if k >= FEWEST)
    lasting = (k for k in moved if np.median(np.abs(off[k : 2 * k + 1] - middle[k])) > limit[k])
    return next(lasting, signal.size - 1)


def _least_change(signal: Array) -> float:
    """What a signal (n,) that stood still may change by at once, also where it was constant until then: a step or so.

    Rows between values of coarse steps lie on no steps themselves: then a change that nine of ten changes exceed.
    """
    changes = np.abs(np.diff(signal))
    changes = changes[changes > 0.0]
    return max(resolution(signal, signal.size), float(np.quantile(changes, 0.1)) if changes.size else 0.0)
