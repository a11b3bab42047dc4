"""An input without the noise of what recorded it: steady between its steps, or smooth between these and its bends."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.recording.noise import noise_of_differences
from rwn.recording.quantisation import quantum
from rwn.recording.smoothing import LENGTHS, ORDER, smooth

Array = NDArray[np.float64]

LEAST = 1e-4  # of the largest value: a converter of 13 bits resolves no less
ALIKE = 8.0  # over sqrt(n): relative difference of two estimates of white noise from n values, whose deviation is 0.85
RETURNS = 8.0  # over sqrt(m): excess of m squares of means over their noise, whose deviation is sqrt(2)
STEADY = 3.0  # deviations of the sum of squares of noise, beyond which a stretch is not steady
STEP = 6.0  # deviations of the noise beyond which a change from row to row is a step: one in 5e8 by chance
LEVEL = 0.01  # chance that values which bend nowhere are taken to, and steady ones to step
NUMBERS = 2.25  # that cubics over so many rows take, for each time that these go into all: the noise that they keep
TOGETHER = 4096  # rows in which lines are sought at once
NOWHERE: NDArray[np.intp] = np.empty(0, dtype=np.intp)


class Denoised(NamedTuple):
    """Values (n,) without white noise, and the deviation of that."""

    values: Array
    noise: float


def denoised(values: Array) -> Denoised | None:
    """Values (n,) without white noise; None where they show none beyond their rounding."""
    if values.size <= LENGTHS[0]:
        return None
    steps = _steps(values, _noise(values, 2))
    noise, other = (_noise(values, order, steps) for order in (2, 4))
    # medians of rounded values are multiples of a step: less noise than that is not seen
    least = max(quantum(values), LEAST * float(np.max(np.abs(values))))
    # of what is smooth, higher differences show less than of what is white
    if noise <= least or abs(other / noise - 1.0) > ALIKE / np.sqrt(values.size):
        return None
    between = np.split(values, _steps(values, noise))
    parts = [part for x in between for part in ([_Part(x, x)] if _is_steady(x, noise) else _parts(x, noise))]
    steady = [_is_steady(part.values, noise) for part in parts]
    levels = iter(_levels([part.values for part, is_steady in zip(parts, steady, strict=True) if is_steady], noise))
    without = [
        np.full(part.values.size, next(levels)) if is_steady else part.course
        for part, is_steady in zip(parts, steady, strict=True)
    ]
    return Denoised(np.concatenate(without), noise)


class _Part(NamedTuple):
    """Values (n,) with a course through them, and how many numbers that takes."""

    values: Array
    course: Array
    numbers: float = 1.0

    def cost(self, noise: float, number: float) -> float:
        """What it leaves in units of the noise, and for each number that it takes as much as a `number` costs."""
        return float(np.sum((self.values - self.course) ** 2)) / noise**2 + self.numbers * number


def _steps(values: Array, noise: float) -> NDArray[np.intp]:
    """The first samples after steps of values (n,)."""
    return np.flatnonzero(np.abs(np.diff(values)) > STEP * np.sqrt(2.0) * noise) + 1


def _parts(x: Array, noise: float) -> list[_Part]:
    """Values (n,) along lines with steps and bends between, or smooth between bends, whichever is likelier (BIC)."""
    straight = [_line(part) for part in np.split(x, _corners(x, noise))]
    smoothed = [_smoothed(part, noise) for part in np.split(x, _bends(x, noise))]
    costs = [sum(part.cost(noise, float(np.log(x.size))) for part in parts) for parts in (straight, smoothed)]
    return straight if costs[0] < costs[1] else smoothed


def _line(x: Array) -> _Part:
    """Values (n,) along a line, which also takes where it begins."""
    place = np.arange(x.size)
    return _Part(x, np.asarray(np.polyval(np.polyfit(place, x, 1), place)) if x.size > 1 else x, 3.0)


def _smoothed(x: Array, noise: float) -> _Part:
    """Values (n,) along cubics over so many rows as predict others best (Mallows 1973)."""
    found = [_Part(x, smooth(x, n), max(x.size * NUMBERS / n, ORDER + 1)) for n in LENGTHS]
    return min(found, key=lambda part: part.cost(noise, 2.0))


def _corners(x: Array, noise: float) -> NDArray[np.intp]:
    """Where values (n,) that follow lines step or bend: each part is two lines rather than one, by no chance.

    Long ones are cut, since what it costs grows as the square of the rows at worst.
    """
    begins = range(0, x.size, TOGETHER)
    enough = 2.0 * float(np.log(x.size / LEVEL)) * noise**2
    found = [[begin, *(begin + k for k in _corners_of(x[begin : begin + TOGETHER], enough))] for begin in begins]
    return np.array([k for corners in found for k in corners][1:], dtype=np.intp)


def _corners_of(x: Array, enough: float) -> list[int]:
    """The corners of values (n,), each of which takes more than `enough` off the squares that a line leaves."""
    place = np.arange(x.size, dtype=np.float64)
    columns = np.stack([np.ones(x.size), place, place**2, x, place * x, x**2])
    sums = np.concatenate([np.zeros((6, 1)), np.cumsum(columns, axis=1)], axis=1)
    corners, open_parts = list[int](), [(0, x.size)]
    while open_parts:
        begin, end = open_parts.pop()
        k = np.arange(begin + 2, end - 1)
        if not k.size:
            continue
        apart = _off_a_line(sums[:, k] - sums[:, [begin]]) + _off_a_line(sums[:, [end]] - sums[:, k])
        gained = float(_off_a_line(sums[:, [end]] - sums[:, [begin]])[0]) - apart
        best = int(np.argmax(gained))
        if gained[best] > enough:
            corners.append(int(k[best]))
            open_parts += [(begin, corners[-1]), (corners[-1], end)]
    return sorted(corners)


def _off_a_line(sums: Array) -> Array:
    """Sum of squares (m,) that a line leaves, of the sums (6, m) of 1, t, t^2, x, t x and x^2."""
    n, t, tt, x, tx, xx = sums
    spread, slope = tt - t**2 / n, tx - t * x / n
    left: Array = xx - x**2 / n - slope**2 / np.maximum(spread, 1e-300)
    return np.maximum(left, 0.0)


def _bends(values: Array, noise: float) -> NDArray[np.intp]:
    """Where values (n,) bend, as a ramp that begins: beside a bend a cubic leaves much, and with it noise alone."""
    from scipy.signal import find_peaks  # late: the command line starts without it
    from scipy.special import ndtri

    deviations, scaled = np.zeros(values.size), (values - np.mean(values)) / noise
    for length in (n for n in LENGTHS if n <= values.size):
        place = np.linspace(-1.0, 1.0, length)
        smooth_part = np.linalg.qr(np.vander(place, ORDER + 1))[0]
        bend = np.abs(place) - smooth_part @ (smooth_part.T @ np.abs(place))
        bend /= np.linalg.norm(bend)
        found = np.correlate(scaled, bend)
        explained = sum(np.correlate(scaled, column) ** 2 for column in smooth_part.T) + found**2
        free = length - ORDER - 2
        left = np.convolve(scaled**2, np.ones(length), "valid") - explained
        known = left <= free + STEADY * np.sqrt(2.0 * free)
        middle = deviations[length // 2 : values.size - length // 2]
        np.maximum(middle, np.abs(found) * known, out=middle)
    by_chance = -float(ndtri(0.5 * LEVEL / values.size))
    bends: NDArray[np.intp] = find_peaks(deviations, height=by_chance, distance=LENGTHS[-1] // 2 + 1)[0]
    return bends


def _noise(values: Array, order: int, steps: NDArray[np.intp] = NOWHERE) -> float:
    """Standard deviation of white noise on values (n,) by their differences of an order, by those over no step."""
    change = np.diff(values, order)
    over = np.zeros(change.size + order, dtype=bool)
    for row in range(order):
        over[np.maximum(steps - 1 - row, 0)] = True
    return noise_of_differences(change[~over[: change.size]], order)


def _is_steady(x: Array, noise: float) -> bool:
    """Whether values (n,) between two steps are one value and noise."""
    free = max(x.size - 1, 1)
    return bool(np.sum((x - np.mean(x)) ** 2) / noise**2 <= free + STEADY * np.sqrt(2.0 * free))


def _levels(stretches: Sequence[Array], noise: float) -> Array:
    """The value of each steady stretch (m,): its mean, or that of all at a level that comes back, as of a PRBS."""
    means, sizes = np.array([np.mean(x) for x in stretches]), np.array([x.size for x in stretches])
    order = np.argsort(means)
    apart = np.diff(means[order]) > STEP * noise * np.sqrt(1.0 / sizes[order][1:] + 1.0 / sizes[order][:-1])
    for group in np.split(order, np.flatnonzero(apart) + 1):
        level = float(np.average(means[group], weights=sizes[group])) if group.size else 0.0
        off = float(np.sum(sizes[group] * (means[group] - level) ** 2)) / noise**2
        if off < group.size + RETURNS * np.sqrt(group.size):  # else they are many levels, near each other
            means[group] = level
    return means
