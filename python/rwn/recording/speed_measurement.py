"""How a recorded speed was obtained: by a tachometer, or as a difference of the position over some samples."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.recording.by_content import ByContent
from rwn.recording.clock import LOST_ROW, clock_beside, clock_of
from rwn.recording.quantisation import NEAR, quantum
from rwn.recording.speed_window import is_centred, window_of

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

SHORTEST = 20  # samples that say how a speed was obtained
REPEATED = 0.05  # error of a difference of the recorded position, in units of the noise that it has
NEARER = 0.25  # the same of three quarters of the rows, which are nearer to it than to half of a count off it
ROUNDED = 1e-3  # of the largest change of its pace, up to which digits that were not written make it
# Power near half the sampling rate over that near a quarter: a rounded speed has 0.4 to 1, central differences 0.005,
# differences over one sample 2.
VANISHING = 0.05  # ratio below which there is no power, as of central differences
LONGEST = 8  # samples of a difference: a moving average of so many differences over one
FASTEST = 0.2  # highest frequency of a motion, of the sampling rate: what moves a drive is slower
STRETCH = 64  # samples of which the power near half the rate is told from that near a quarter
QUIET = 30.0  # per cent of the stretches: those in which the motion is slowest are looked at
SLOW, LOOKED_AT = 20.0, 200  # angles up to so many times the smallest, and how many of them
MIN_COUNTS, MOST_COUNTS = 4, 40_000  # of an encoder, in a turn: one line in quadrature to 10 000
MOSTLY = 0.9  # share of the angles that are whole counts: a row that was lost before one leaves it another interval
RISING = 1.4  # above this ratio a speed is a difference over one sample


@dataclass(frozen=True)
class SpeedMeasurement:
    """Samples before and after the own one between whose positions a speed was taken; none: an instantaneous speed."""

    before: int = 0
    after: int = 0

    @property
    def is_difference(self) -> bool:
        """Whether the speed is a difference of positions."""
        return self.before + self.after > 0

    def in_words(self, step: float) -> str:
        """What the speed is, of samples `step` [s] apart."""
        apart = self.before + self.after
        over = f" of {apart} samples: a mean over {1e3 * apart * step:.3g} ms" if apart > 1 else ""
        return f"the speed is a difference of positions{over}"

    @property
    def shows_counts(self) -> bool:
        """Whether its noise is that of the counts; over many rows the instants of its updates outweigh these."""
        return 0 < self.before + self.after <= LONGEST


_Power = Callable[[Array, float, float], float]
INSTANTANEOUS = SpeedMeasurement()
CENTRAL = SpeedMeasurement(1, 1)
BACKWARD = SpeedMeasurement(1, 0)
FORWARD = SpeedMeasurement(0, 1)
AVERAGED = tuple(SpeedMeasurement(k, 0) for k in range(LONGEST, 2, -1))
_KNOWN = ByContent[SpeedMeasurement]()
DIFFERENCES = (CENTRAL, BACKWARD, FORWARD, SpeedMeasurement(2, 0), *AVERAGED)


def speed_measurement(
    time: Array, speed: Array, position: Array, *, new: Flags | None = None, new_position: Flags | None = None
) -> SpeedMeasurement:
    """How a speed was obtained, as far as the values (n,) show it; instantaneous where they do not.

    A difference of the position that was recorded beside it repeats its noise; one of encoder counts that were not
    recorded lies on multiples of a step. Whether such a difference is a backward or a forward one no value tells: the
    backward one is what a drive can compute as it runs.

    `new`, `new_position`: where these were updated (default: everywhere); the samples of the result are rows.
    """
    every = np.full(time.size, True)
    new, known = (every if new is None else new), (every if new_position is None else new_position)
    key = _KNOWN.key(time, speed, position, new, known)
    return _KNOWN.get(key) or _KNOWN.keep(key, _measured(time, speed, position, new, known))


def _measured(time: Array, speed: Array, position: Array, new: Flags, known: Flags) -> SpeedMeasurement:
    if speed.size and position.size and (rows := window_of(time, speed, position, new)):
        return SpeedMeasurement(rows, 0)
    known = known & new
    updates = np.nonzero(known)[0]
    update = max(round(float(np.median(np.diff(updates)))), 1) if updates.size > 1 else 1
    when, *values = time[known], *(x[known] if x.size else x for x in (speed, position))
    way = _of_the_position(when, *values)
    if way is None:
        way = _of_rows(when, *values)
        if way == BACKWARD and position.size and is_centred(time, speed, position, updates):
            half = update // 2  # of the time between two rows no row shows the middle
            return SpeedMeasurement(half, half)
    return SpeedMeasurement(way.before * update, way.after * update) if update > 1 else way


def _of_the_position(time: Array, speed: Array, position: Array) -> SpeedMeasurement | None:
    """The difference of the position beside it that a speed is; None where it is none."""
    if speed.size < SHORTEST or not position.size:
        return None
    clock = clock_beside(time)  # a drive divides by its own period, however a computer notes the times
    instants = [time] if clock is None else [time, np.asarray(clock.period * clock.ticks)]
    errors = {way: min(_repeats(t, speed, position, way) for t in instants) for way in DIFFERENCES}
    best = min(errors, key=lambda way: errors[way])
    return best if errors[best] < REPEATED else None


def _of_rows(time: Array, speed: Array, position: Array) -> SpeedMeasurement:
    if speed.size < SHORTEST:
        return INSTANTANEOUS
    if not position.size and (way := _of_intervals(time, speed)).is_difference:
        return way
    step = quantum(speed)
    if _is_rounded(_power, speed, step):
        averages = () if position.size else AVERAGED
        over_more = next((way for way in averages if _vanishes(speed, way.before)), None)
        way = over_more or _of_counts(_power, time, speed, step)
        if way.is_difference:
            return way
    return _of_counts(_quiet_power, time, speed, step) if _is_rounded(_quiet_power, speed, step) else INSTANTANEOUS


def _is_rounded(power: _Power, speed: Array, step: float) -> bool:
    """Whether it has no more power than two roundings to a step, which are never further apart than that."""
    return 0.0 < power(speed, FASTEST, 0.5) <= step**2


def difference(measurement: SpeedMeasurement, time: Array, position: Array) -> Array:
    """The speed as measured: of `position` (n,) or (n, p) over `time` (n,), over the nearest sample at the ends."""
    n = time.size
    first = np.maximum(np.arange(n) - measurement.before, 0)
    last = np.minimum(np.arange(n) + measurement.after, n - 1)
    at_an_end = first == last
    last[at_an_end] = np.minimum(first[at_an_end] + 1, n - 1)
    first[at_an_end] = last[at_an_end] - 1
    span = time[last] - time[first]
    change = position[last] - position[first]
    result: Array = change / (span if position.ndim == 1 else span[:, None])
    return result


def integral(measurement: SpeedMeasurement, time: Array, speed: Array) -> Array:
    """What a speed has turned since its first sample, (n,): as its differences add up, else by trapezia."""
    if not speed.size:
        return speed
    of_step = {
        BACKWARD: speed[1:],
        FORWARD: speed[:-1],
    }.get(measurement, 0.5 * (speed[1:] + speed[:-1]))
    return np.concatenate([[0.0], np.cumsum(of_step * np.diff(time))])


def _repeats(time: Array, speed: Array, position: Array, way: SpeedMeasurement) -> float:
    """How far a speed is off a difference of the position, in units of the noise that this has.

    Where a slow shaft turns by as many counts after a row as before it, every difference fits: such rows say nothing.
    """
    expected = difference(way, time, position)
    noise = np.abs(np.diff(expected, 2))
    intervals, bends = np.diff(time), np.abs(np.diff(position, 2))
    whole = intervals < LOST_ROW * np.median(intervals)
    tells = whole[1:] & whole[:-1] & (bends > ROUNDED * bends.max())
    if not tells.any():
        return np.inf
    own, errors = np.median(noise[tells]), np.abs(speed - expected)[1:-1][tells]
    fits = np.percentile(errors, 75.0) < NEARER * own
    return float(np.median(errors) / own) if fits else np.inf


def _of_counts(power: _Power, time: Array, speed: Array, step: float) -> SpeedMeasurement:
    """By their steps, and by what these hold near half the sampling rate. `power`: of all samples, or of quiet ones.

    The central difference (q[k+1] - q[k-1]) / 2T vanishes there, whatever gear is between encoder and shaft; that over
    one sample, with a whole number of counts per revolution, holds most there; what a coarse converter rounds neither.
    """
    near_half, high, quarter = (power(speed, *band) for band in ((0.48, 0.5), (0.4, 0.5), (0.2, 0.3)))
    if near_half < VANISHING * quarter:
        return CENTRAL
    counts = 2.0 * np.pi / (step * clock_of(time).period)
    # that over four samples holds nothing at a quarter either, and at half of the rate no more
    if _whole(counts) and high > RISING * quarter and near_half > 0.5 * high:
        return BACKWARD
    return INSTANTANEOUS


def _of_intervals(time: Array, speed: Array) -> SpeedMeasurement:
    """By angles of whole counts, where each was divided by the time that passed between its two rows, as it was noted.

    Not where angles over equal intervals are whole counts as well: rows that are evenly spaced tell nothing of this.
    """
    intervals = np.diff(time)
    if np.ptp(intervals) < 1e-6 * intervals[0] or _are_counts(np.abs(speed * np.median(intervals))):
        return INSTANTANEOUS
    turned = {BACKWARD: np.abs(speed[1:] * intervals), FORWARD: np.abs(speed[:-1] * intervals)}
    return next((way for way, angles in turned.items() if _are_counts(angles)), INSTANTANEOUS)


def _are_counts(angles: Array) -> bool:
    """Whether the smallest of `angles` (n,) are multiples of a whole part of a turn.

    An error of an interval is multiplied by its counts, so that slow rows tell most.
    """
    moving = np.sort(angles[angles > 0.0])
    if moving.size < SHORTEST:
        return False
    slow = moving[moving < SLOW * moving[0]]
    slow = slow[:: -(-slow.size // LOOKED_AT)]
    if np.pi > slow[0] * MOST_COUNTS:  # the smallest angle is half a count; of a float next to 0 it is none
        return False
    fewest = max(round(np.pi / slow[0]), MIN_COUNTS)  # counts in a turn
    counts = np.arange(fewest, min(4 * fewest, MOST_COUNTS) + 1)
    for some in (slow[:: -(-slow.size // SHORTEST)], slow):  # few rule out most
        in_steps = np.multiply.outer(counts, some / (2.0 * np.pi))
        near = np.round(in_steps)
        counts = counts[(np.mean(np.abs(in_steps - near) < NEAR, axis=1) > MOSTLY) & (near[:, -1] > near[:, 0])]
    return counts.size > 0


def _vanishes(speed: Array, samples: int) -> bool:
    """Whether a speed of counts has no power at the multiples of 1/samples beyond its motion, but some between them."""
    if speed.size < samples * SHORTEST:
        return False
    zeros = [k / samples for k in range(1, samples // 2 + 1) if k / samples > FASTEST]
    between = min(_power(speed, z - 0.6 / samples, z - 0.4 / samples) for z in zeros)
    return all(_power(speed, z - 0.01, min(z + 0.01, 0.5)) < VANISHING * between for z in zeros)


def _whole(counts: float) -> bool:
    return counts > 3.0 and abs(counts - round(counts)) < max(0.01, 3e-6 * counts)


def _quiet_power(signal: Array, lowest: float, highest: float) -> float:
    """Power over a band in the stretches of a motion in which it moves least at lower frequencies, their mean.

    Steps of the speed would else outweigh its rounding; what stands still shows none. Of a short signal: all of it.
    """
    stretches = np.lib.stride_tricks.sliding_window_view(signal, min(STRETCH, signal.size))[:: STRETCH // 2]
    moving = stretches[np.ptp(stretches, axis=1) > 0.0]
    if signal.size < 4 * STRETCH or not moving.size:
        return _power(signal, lowest, highest)
    slow = _powers(moving, 0.5 * FASTEST, FASTEST)
    return float(np.mean(_powers(moving[slow <= np.percentile(slow, QUIET)], lowest, highest)))


def _power(signal: Array, lowest: float, highest: float) -> float:
    """Mean power over a band of frequencies, in units of the sampling rate: the variance of a signal that is white."""
    return float(_powers(signal[np.newaxis, :], lowest, highest)[0])


def _powers(signals: Array, lowest: float, highest: float) -> Array:
    """`_power` (k,) of each of signals (k, n)."""
    window = np.hanning(signals.shape[1])
    centred = signals - np.mean(signals, axis=1, keepdims=True)
    power = np.abs(np.fft.rfft(centred * window)) ** 2 / np.sum(window**2)
    rate = np.linspace(0.0, 0.5, power.shape[1])
    return np.asarray(np.mean(power[:, (rate >= lowest) & (rate <= highest)], axis=1))
