"""Noise on a recorded voltage that the drive did not have: a sensor's, which nothing else in the recording goes with.

A voltage that varies by itself drives a current, and a controller that answers the noise of a sensor varies it with
that. Where the noise is white and independent of all other signals some rows before and after, it is the recorder's.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.recording.clock import JITTER, clock_of
from rwn.recording.denoising import denoised
from rwn.recording.inspection.finding import Finding
from rwn.recording.noise import PER_MEDIAN
from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED
from rwn.recording.smoothing import LENGTHS, smooth

Array = NDArray[np.float64]

INPUT = "voltage"  # a torque or a force may be what a model is judged by, with its noise
LAGS = 3  # rows before and after that it may go with another signal
LEVEL = 0.01  # chance that independent noise seems to go with a signal of the recording
FARTHEST = 5.0  # deviations at which a departure from a smooth course is cut: some steps would outweigh all else


def without_input_noise(recording: Recording) -> tuple[Recording, list[Finding]]:
    """The recording without the noise of its voltage where that is no part of it, and what was found."""
    given = recording.signals.get(INPUT)
    beside_a_clock = clock_of(recording.time).jitter > JITTER  # a ramp is then no ramp from row to row
    found = None if given is None or beside_a_clock else denoised(np.asarray(given))
    measured = [s for s in MEASURED if s in recording.signals]
    if given is None or found is None or not measured:
        return recording, []
    noise = given - found.values
    if any(_goes_with(noise, _departures(recording, s)) < LEVEL / len(measured) for s in measured):
        return recording, []
    said = Finding(
        kind="input-noise", recording=recording.name, signals=(INPUT,), count=len(recording),
        words=f"the {INPUT} has a noise of {found.noise:.3g} V rms that no signal answers", done="simulated without it",
    )  # fmt: skip
    signals = {**recording.signals, INPUT: found.values}
    return replace(recording, signals=signals, input_noise=found.noise), [said]


def _departures(recording: Recording, signal: str) -> Array:
    """How far a signal (n,) is off its smooth course, 0 where it measures nothing."""
    values = np.asarray(recording.signals[signal])
    off = values - smooth(values, LENGTHS[-1])
    known = ~recording.missing.get(signal, np.zeros(off.size, dtype=bool))
    most = FARTHEST * PER_MEDIAN * float(np.median(np.abs(off[known]))) if known.any() else 0.0
    return np.where(known, np.clip(off, -most, most), 0.0)


def _goes_with(noise: Array, other: Array) -> float:
    """Chance that white noise (n,) goes as closely with another signal (n,), some rows before and after, by nothing."""
    from scipy.special import chdtrc  # late: the command line starts without it

    lags = np.arange(-LAGS, LAGS + 1)
    every = [int(k) for k in lags]
    pairs = [(noise[max(k, 0) : noise.size + min(k, 0)], other[max(-k, 0) : noise.size + min(-k, 0)]) for k in every]
    along = np.array([float(a @ b) for a, b in pairs])
    alike = np.array([float(other[k:] @ other[: other.size - k]) for k in range(lags.size)])
    spread = np.mean(noise**2) * alike[np.abs(lags[:, None] - lags[None, :])]  # of white noise beside this signal
    if not alike[0] > 0.0:
        return 1.0
    distance = float(along @ np.linalg.pinv(spread, hermitian=True) @ along)
    return float(chdtrc(lags.size, max(distance, 0.0)))  # where the two are less alike than rounding, it may be below 0
