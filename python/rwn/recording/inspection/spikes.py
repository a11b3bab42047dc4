"""Single samples far off a signal that goes on beside them as if nothing had been: dropouts, transmission errors."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.recording.inspection.finding import Check, Flags
from rwn.recording.noise import rough_noise
from rwn.recording.quantisation import quantum
from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED

Array = NDArray[np.float64]

LEVEL = 0.01  # chance that one is found in Gaussian noise, in all samples together
RARE = 0.02  # most of the samples that are called spikes: a signal that jumps more often does so by itself
BESIDE = 0.25  # most that the neighbours may differ from each other, in units of the jump
PASSES = 2  # so that one of two spikes side by side is found once the other is bridged
SETTLING = 3  # samples after a step of the input in which a current may peak by itself


def _after_steps(recording: Recording) -> Flags:
    """Samples at or shortly after a step of the input that stands out from its other changes."""
    flags = np.zeros(len(recording), dtype=bool)
    for name in (s for s in recording.signals if s not in MEASURED):
        change = np.abs(np.diff(recording.signals[name], prepend=recording.signals[name][0]))
        stepped = change > BESIDE * float(np.max(change, initial=0.0))
        for late in range(SETTLING + 1):
            flags[late:] |= stepped[: flags.size - late]
    return flags


def _spikes(recording: Recording, signal: str) -> Flags:
    x, after_steps = np.asarray(recording.signals[signal]), _after_steps(recording)
    found = np.zeros(x.size, dtype=bool)
    bridged = x
    for _ in range(PASSES):
        found |= _alone(bridged, after_steps)
        known = np.flatnonzero(~found)
        bridged = np.interp(np.arange(x.size), known, x[known])
    return found if found.mean() <= RARE else np.zeros(x.size, dtype=bool)


def _alone(x: Array, after_steps: Flags) -> Flags:
    """Samples off both neighbours by more than noise, which differ little from each other; dropouts to exactly 0."""
    from scipy.stats import norm

    flags = np.zeros(x.size, dtype=bool)
    noise = max(rough_noise(x), quantum(x))
    if x.size < 8 or noise == 0.0:
        return flags
    limit = float(norm.isf(0.5 * LEVEL / x.size)) * noise * np.sqrt(1.5)  # a sample against the mean of two
    before, here, after = x[:-2], x[1:-1], x[2:]
    jump = np.abs(here - 0.5 * (before + after))
    off = ((here - before) * (here - after) > 0.0) & (jump > limit)
    smooth = np.abs(after - before) < BESIDE * jump
    beyond = np.abs(here) > float(np.max(np.abs(x[1:-1][~off]), initial=0.0))
    flags[1:-1] = off & ((here == 0.0) | (smooth & (beyond | ~after_steps[1:-1])))
    return flags


# The input is what was commanded, and may jump as it likes.
SPIKES = Check(
    kind="spikes",
    flags=_spikes,
    words=lambda signal, flags: f"{int(flags.sum())} single samples of the {signal} are far off those beside them",
    done="left out",
)
