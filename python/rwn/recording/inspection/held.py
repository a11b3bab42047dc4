"""Samples that repeat the last one because the sensor had nothing new: sample-and-hold between its own updates."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.recording.clock import clock_of
from rwn.recording.inspection.finding import Check, Flags
from rwn.recording.noise import noise_from_differences
from rwn.recording.quantisation import quantum
from rwn.recording.recording import Recording

Array = NDArray[np.float64]

OFTEN = 0.3  # share of the samples that have to repeat the last one
AT_ONCE = 0.8  # share of the updates that come after the usual number of samples, or on one grid
LEVEL = 0.01  # chance that the changes of a coarse signal lie on a grid
RARELY = 0.001  # chance that a fine signal repeats itself so often: 1 % of a diagnosis, of some ten signals
FEWEST = 20  # times that a sample repeats the last; of fewer values `quantum` tells no step


def _repeated(recording: Recording, signal: str) -> Flags:
    """Samples that only repeat the last; none where the signal has coarse steps, or stands still by itself.

    A coarse signal repeats itself without being held. One that is held, too, changes at every n-th sample only; each of
    these is an update, also one that brings an equal value.
    """
    x = np.asarray(recording.signals[signal])
    repeats = np.append(False, np.diff(x) == 0.0)
    none = np.zeros(x.size, dtype=bool)
    if repeats.mean() < OFTEN:
        return _now_and_then(x, repeats)
    if repeats.mean() > 0.99:
        return none
    gaps = np.diff(np.flatnonzero(~repeats))
    usual = int(np.median(gaps))
    if usual < 2:
        return none
    if quantum(x) > 0.0:
        regular = float(np.mean(gaps == usual)) > AT_ONCE
        widths = range(usual, usual - 1 if regular else 1, -1)
        updates = _updates(clock_of(np.asarray(recording.time)).ticks, ~repeats, widths)
        if updates is not None:
            return repeats & ~updates
        if not regular:
            return none
    repeats[2:] |= x[2:] == x[:-2]  # also behind a single spike
    return repeats


def _now_and_then(x: Array, repeats: Flags) -> Flags:
    """The repeats (n,) of a fine signal where there are more than its noise makes by chance; else none.

    Two samples of independent noise are written alike with a chance of step / (2 sqrt(pi) deviation), less where it
    moves. A value that comes back is that of a standstill, or the end of a range; values on a step are of a coarse
    signal between whose samples the rows lie.
    """
    from scipy.special import pdtrc  # late: the command line starts without it

    begins = repeats & ~np.append(False, repeats[:-1])
    values, runs = np.unique(x[begins], return_counts=True)
    held: Flags = repeats & ~np.isin(x, values[runs > 1]) & (x > np.min(x)) & (x < np.max(x))
    change, noise = np.abs(np.diff(x)), noise_from_differences(x[~repeats])
    often = int((held & begins).sum())
    if often < FEWEST or noise == 0.0 or quantum(x) > 0.0 or quantum(x[held]) > 0.0:
        return np.zeros(x.size, dtype=bool)
    by_chance = x.size * float(np.min(change[change > 0.0])) / (2.0 * np.sqrt(np.pi) * noise)
    return held if pdtrc(often - 1, by_chance) < RARELY else np.zeros(x.size, dtype=bool)


def _updates(ticks: NDArray[np.int64], changes: Flags, widths: Sequence[int]) -> Flags | None:
    """The samples (n,) on the first grid, one of every so many ticks, that nearly all changes lie on; None: on none."""
    from scipy.special import bdtrc  # late: the command line starts without it

    at = ticks[changes][1:]  # the first sample is no change
    for every in widths:
        phase = np.bincount(at % every, minlength=every)
        most = int(np.argmax(phase))
        chance = every * float(bdtrc(phase[most] - 1, at.size, 1.0 / every))
        if phase[most] > AT_ONCE * at.size and chance < LEVEL / len(widths):
            return np.asarray(ticks % every == most, dtype=np.bool_)
    return None


def _words(signal: str, repeated: Flags) -> str:
    every = round(float(np.median(np.diff(np.flatnonzero(~repeated)))))  # an update may bring an equal value
    if every < 2:
        return f"the {signal} repeats its last sample now and then"
    return f"the {signal} is updated every {every} samples and held between"


HELD = Check(kind="held", flags=_repeated, words=_words, done="repeated samples left out", bridged=False)
