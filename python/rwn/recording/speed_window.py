"""A speed that a drive computes as the difference of its position over many rows, known by position and speed alone.

Motor controllers difference an encoder over a fixed time (100 ms is a common default), update the result every few
rows, and log the position beside it. The mean speed of the last rows then fits what was recorded far better than a mean
over any other time, with any other delay, or a first-order filter, which other ways to measure do not bring about.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

LONGEST_WINDOW = 40  # rows of a window
WIDTHS = range(1, LONGEST_WINDOW + 1)
JUDGED = 4000  # rows that are looked at
LIKELIER = float(np.log(1000.0))  # than every other window, delay and filter
MEMORIES = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95)  # of first-order filters, from update to update


def window_of(time: Array, speed: Array, position: Array, new: Flags) -> int:
    """Rows over which a speed (n,) is a backward difference of the position (n,), more than two updates; 0: none.

    `new`: where the speed was updated. The errors of a mean speed over `width` rows, its middle `delay` half rows
    before the row, are taken as independent from one window to the next and as Laplace's, so that a few rows that are
    out of step do not decide.
    """
    rows = np.nonzero(new)[0]
    rows = rows[(rows >= 2 * LONGEST_WINDOW) & (rows < time.size - LONGEST_WINDOW)]
    moving = np.abs(position[rows] - position[rows - 2 * LONGEST_WINDOW]) > 0.0
    if moving.sum() < 2 * LONGEST_WINDOW:
        return 0
    update = max(round(float(np.median(np.diff(rows)))), 1)
    judged = rows[moving][:JUDGED]
    backward = _errors(time, speed, position, judged, [(width, width) for width in WIDTHS])
    best = 1 + int(np.argmin(np.min(backward, axis=1)))
    if best <= 2 * update:  # not distinguished from its neighbours
        return 0
    whole = [(width, delay) for width in WIDTHS for delay in range(width % 2, 2 * LONGEST_WINDOW + 1, 2)]
    errors = _errors(time, speed, position, judged, whole)
    filtered = _filtered(time, speed, position, rows, moving, update)
    widths, delays = np.array(WIDTHS)[:, None], np.arange(2 * LONGEST_WINDOW + 1)
    other = (np.abs(widths - best) > update) | (
        np.abs(delays - best) > 2 * update
    )  # out of step by more than an update
    own, rival = float(np.min(errors[~other])), min(float(np.min(errors[other])), filtered)
    floor = 1e-12 * float(np.max(np.abs(speed)))
    independent = judged.size * min(update / best, 1.0)
    return best if independent * np.log(max(rival, floor) / max(own, floor)) > LIKELIER else 0


def is_centred(time: Array, speed: Array, position: Array, rows: NDArray[np.intp]) -> bool:
    """Whether a speed, a difference over the time between two updates, has its middle at the own row.

    Of a recording (n,); `rows`: where speed and position were updated. A drive that logs slower than it runs takes one
    over its own rows, which are not recorded; what lies between is a line here. Errors are independent and Laplace's,
    of which the mean is the scale: in most rows of a slow shaft both differences may be the same.
    """
    inner, half = rows[1:-1], 0.5 * float(np.median(np.diff(time[rows])))
    moving = inner[position[rows[2:]] != position[rows[:-2]]][:JUDGED]
    if not moving.size:
        return False
    line, at, own = position[rows], time[moving], speed[moving]
    backward, centred = (
        np.mean(np.abs(own - (np.interp(at + b, time[rows], line) - np.interp(at - a, time[rows], line)) / (a + b)))
        for a, b in ((2.0 * half, 0.0), (half, half))
    )
    floor = 1e-12 * float(np.max(np.abs(speed)))
    return bool(moving.size * np.log(max(backward, floor) / max(centred, floor)) > LIKELIER)


def _filtered(time: Array, speed: Array, position: Array, rows: NDArray[np.intp], moving: Flags, update: int) -> float:
    """Median error of the best first-order filter of differences from update to update."""
    from scipy.signal import lfilter  # late: scipy takes half a second to load

    mean = (position[rows] - position[rows - update]) / (time[rows] - time[rows - update])
    best = np.inf
    for memory in MEMORIES:
        shown, _ = lfilter([1.0 - memory], [1.0, -memory], mean, zi=[memory * mean[0]])
        best = min(best, float(np.median(np.abs(speed[rows] - shown)[moving][:JUDGED])))
    return best


def _errors(
    time: Array, speed: Array, position: Array, rows: NDArray[np.intp], pairs: Iterable[tuple[int, int]]
) -> Array:
    """Median error of the mean speed over each width (rows), with each delay of its middle (columns, half rows).

    Infinite at what is not among the `pairs` of both, or reaches further than the recording is looked at.
    """
    errors = np.full((LONGEST_WINDOW, 2 * LONGEST_WINDOW + 1), np.inf)
    shifts = range(-2 * LONGEST_WINDOW, LONGEST_WINDOW + 1)
    positions, times = ({k: signal[rows + k] for k in shifts} for signal in (position, time))
    own = speed[rows]
    for width, delay in pairs:
        first, last = (-delay - width) // 2, (width - delay) // 2
        if first >= -2 * LONGEST_WINDOW and last <= LONGEST_WINDOW:
            mean = (positions[last] - positions[first]) / (times[last] - times[first])
            errors[width - 1, delay] = np.median(np.abs(own - mean))
    return errors
