"""Single samples far off a signal that goes on beside them as if nothing had been: dropouts, transmission errors."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.recording.clock import clock_of
from rwn.recording.inspection.finding import Check, Flags
from rwn.recording.inspection.outliers import BESIDE, RARE, REACH, most_deviations, outliers
from rwn.recording.inspection.step_response import Interpolated, interpolated
from rwn.recording.noise import PER_MEDIAN, noise_from_differences
from rwn.recording.quantisation import quantum
from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED

Array = NDArray[np.float64]

SHOWN = 4  # spikes whose places are said
TOGETHER = (1, 1, 2)  # samples: one of two spikes is found once the other is bridged, or both as one that lasts
FEWEST = 8  # samples among which one is found
SETTLING = 3  # samples after a step of the input in which a current may peak by itself
NEARBY = 25  # samples whose changes a step of the input stands out from: a sine has none


def after_steps(recording: Recording, *, least: float = BESIDE) -> Array:
    """How large a step of the input is (n,), in units of the largest, that a sample is at or shortly after; or 0.

    Of those that stand out from the changes nearby and are no smaller than `least`.
    """
    from scipy.ndimage import median_filter  # late: the command line starts without it

    sizes = np.zeros(len(recording))
    for name in (s for s in recording.signals if s not in MEASURED):
        change = np.abs(np.diff(recording.signals[name], prepend=recording.signals[name][0]))
        largest = float(np.max(change, initial=0.0))
        usual = np.maximum(median_filter(change, NEARBY) / BESIDE, least * largest)
        stepped = np.where(change > usual, change, 0.0) / (largest or 1.0)
        for late in range(SETTLING + 1):
            sizes[late:] = np.maximum(sizes[late:], stepped[: sizes.size - late])
    return sizes


def _spikes(recording: Recording, signal: str) -> Flags:
    """Among the samples that were measured: what is held between updates has no noise."""
    missing = recording.missing.get(signal, np.zeros(len(recording), dtype=bool))
    measured = np.flatnonzero(~missing)
    if measured.size < FEWEST:
        return np.zeros(missing.size, dtype=bool)
    since = np.append(0, measured[:-1] + 1)  # the last sample that was measured
    stepped = np.maximum.reduceat(after_steps(recording), since)[: measured.size]
    flags = np.zeros(missing.size, dtype=bool)
    x = np.asarray(recording.signals[signal])[measured]
    inputs = [np.asarray(recording.signals[s])[measured] for s in recording.signals if s not in MEASURED]
    flags[measured] = _among(x, stepped > 0.0) | _beside_steps(x, inputs, stepped)
    flags &= ~_after_gaps(recording.time)
    return flags if flags.mean() <= RARE else np.zeros(missing.size, dtype=bool)


def _after_gaps(time: Array) -> Flags:
    """The rows (n,) that come after lost ones: what the input did there, and the signal for it, is in no row."""
    return np.asarray(np.diff(clock_of(time).ticks, prepend=-1) > 1)


def _among(x: Array, stepped: Flags) -> Flags:
    """The spikes among measured samples x (n,) of a signal; `stepped` (n,): shortly after a step of the input."""
    found = np.zeros(x.size, dtype=bool)
    bridged = x
    may_swing = np.pad(stepped, 1, constant_values=True)
    may_swing[[1, -2]] = True  # a run from rest may begin with a step
    for together in TOGETHER:
        mirrored = np.pad(bridged, 1, mode="reflect")  # the first sample has none before it, the last none behind it
        found |= _alone(mirrored, may_swing, together)[1:-1]
        known = np.flatnonzero(~found)
        bridged = np.interp(np.arange(x.size), known, x[known])
    return found | _alike(x, found)


def _beside_steps(x: Array, inputs: Sequence[Array], stepped: Array) -> Flags:
    """The few samples beside steps of the inputs that are off by themselves, and by much more than at other steps.

    Off what those beside them and the inputs make of them, which grows with the step: a winding answers within a
    sample, and the clock that times it is not exact.
    """
    from scipy.ndimage import maximum_filter1d  # late: the command line starts without it

    steps = maximum_filter1d(stepped, 2 * REACH + 1)  # the samples that have one within their reach
    beside = int(np.count_nonzero(steps))
    if beside == 0:
        return np.zeros(x.size, dtype=bool)
    off = interpolated(x, inputs)
    limit = most_deviations(x.size) * PER_MEDIAN * float(np.median(np.abs(off.errors)))
    relative = np.abs(off.errors) / np.where(steps > 0.0, steps, np.inf)
    found = outliers(relative, limit=0.0, among=beside, alone=lambda at: _is_alone(off, at))
    return found & (np.abs(off.errors) > limit)


def _is_alone(off: Interpolated, at: int) -> bool:
    """Whether the interpolation errs beside a sample as it does where that one alone is off."""
    here = off.errors[at - REACH : at + REACH + 1]
    return here.size == off.of_one.size and bool(
        np.max(np.abs(here - off.errors[at] * off.of_one)) < BESIDE * abs(off.errors[at])
    )


def _alike(x: Array, found: Flags) -> Flags:
    """Samples (n,) with the very value of spikes, a 0 or the end of a range, where most that have it are spikes.

    On a steep flank a dropout lies between its neighbours.
    """
    values, of = np.unique(x, return_inverse=True)
    spikes = np.bincount(of, weights=found, minlength=values.size)
    return np.asarray((spikes >= 0.5 * np.bincount(of, minlength=values.size))[of], dtype=np.bool_)


def _alone(x: Array, may_swing: Flags, together: int) -> Flags:
    """So many samples off both neighbours by more than noise, in a signal that rests beside them; dropouts to 0.

    It rests where the neighbours differ little from each other, and on one side at least from the next: a current that
    peaks, or a rectified speed that turns, moves on both. Both sides need not, since the next may be another spike.
    A motor may well swing within a few samples: several together, and those where it `may_swing`, are spikes beyond all
    others alone, and off by much more than these. A 0 to which those before it or after it lead is no dropout.
    """
    noise = max(noise_from_differences(x), quantum(x))
    if noise == 0.0:
        return np.zeros(x.size, dtype=bool)
    limit = most_deviations(x.size) * noise * np.sqrt(1.5)  # a sample against the mean of two
    before, after = x[: -together - 1], x[together + 1 :]
    here = np.stack([x[1 + k : x.size - together + k] for k in range(together)])
    jump = np.min(np.minimum(np.abs(here - before), np.abs(here - after)), axis=0)
    off = np.all((here - before) * (here - after) > 0.0, axis=0) & (jump > limit)
    leads, follows = np.diff(before, prepend=np.inf), np.diff(after, append=np.inf)
    smooth = np.maximum(np.abs(after - before), np.minimum(np.abs(leads), np.abs(follows))) < BESIDE * jump
    swings = may_swing[1:-together] | (together > 1)
    others = ~_in_all(off, together)
    others[[0, -1]] = False  # these are mirrored
    largest = np.min(np.abs(here), axis=0) > float(np.max(np.abs(x[others]), initial=0.0))
    few = int(RARE * np.count_nonzero(swings))  # that may be spikes too, within the range of the motion
    rest = np.sort(jump[off & swings & ~largest])[: -few or None]
    usual = float(np.max(rest, initial=0.0))
    beyond = smooth & largest & (BESIDE * jump > usual)
    led_to = np.minimum(np.abs(here[0] - before - leads), np.abs(here[-1] - after + follows)) < BESIDE * jump
    dropped = np.all(here == 0.0, axis=0) & ~led_to
    dropped[[0, -1]] = False  # a run begins and ends at rest
    return _in_all(off & (dropped | (smooth & ~swings) | beyond), together)


def _in_all(first: Flags, together: int) -> Flags:
    """The samples that belong to so many together, by whether such begin at each sample but the first."""
    flags = np.zeros(first.size + together + 1, dtype=bool)
    for k in range(together):
        flags[1 + k : 1 + k + first.size] |= first
    return flags


def _words(signal: str, flags: Flags) -> str:
    count = int(flags.sum())
    which = ", ".join(str(k + 1) for k in np.flatnonzero(flags)[:SHOWN]) + (", .." if count > SHOWN else "")
    if count == 1:
        return f"1 single sample of the {signal} (sample {which}) is far off those beside it"
    return f"{count} single samples of the {signal} (samples {which}) are far off those beside them"


# The input is what was commanded, and may jump as it likes.
SPIKES = Check(
    kind="spikes",
    flags=_spikes,
    words=_words,
    done="left out",
)
