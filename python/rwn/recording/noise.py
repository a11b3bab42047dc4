"""The noise of a measured signal: white, or an autoregression where a filter or a difference has coloured it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import comb

import numpy as np
from numpy.typing import NDArray

from rwn import _core

Array = NDArray[np.float64]

STABLE = 0.9999  # largest partial autocorrelation: a fit of one of 1 would not know the level of the errors
LEAST = 1e-12  # least level of a noise
PER_MEDIAN = 1.4826  # standard deviation of normal numbers over the median of their size


@dataclass(frozen=True, kw_only=True)
class Noise:
    """Noise of one signal: the deviation of what is new in each sample, and how a sample goes with those before.

    `reflection`: partial autocorrelations; none where it is white. `of_sensor`: those of the sensor's part of it, where
    it holds what errors of the input make of the signal too.
    """

    level: float
    reflection: tuple[float, ...] = ()
    of_sensor: tuple[float, ...] | None = None

    @property
    def deviation(self) -> float:
        """Standard deviation of the noise itself."""
        return float(self.level / np.sqrt(np.prod([1.0 - r**2 for r in self.reflection])))

    def scaled(self, factor: float) -> Noise:
        """The noise of the signal times `factor`."""
        return replace(self, level=abs(factor) * self.level)

    def innovations(self, errors: Array, *, restart: int = 0) -> Array:
        """What is new in each of `errors` (n,), in units of its standard deviation; NaN is passed over.

        Every `restart` samples the errors begin anew.
        """
        fresh = _core.innovations(np.ascontiguousarray(errors), list(self.reflection), restart)
        result: Array = fresh / self.level
        return result


WHITE = Noise(level=1.0)


def autoregression(errors: Sequence[Array], order: int) -> Noise:
    """Errors (n,) of each recording as an autoregression (Burg 1975); NaN is passed over."""
    forward = [x[np.isfinite(x)] for x in errors]
    backward, reflection = forward, list[float]()
    for _ in range(order):
        pairs = [(f[1:], b[:-1]) for f, b in zip(forward, backward, strict=True) if f.size > 1]
        energy = sum(float(f @ f + b @ b) for f, b in pairs)
        last = float(np.clip(2.0 * sum(float(f @ b) for f, b in pairs) / energy, -STABLE, STABLE)) if energy else 0.0
        forward, backward = [f - last * b for f, b in pairs], [b - last * f for f, b in pairs]
        reflection.append(last)
    new = np.concatenate(forward) if forward else np.zeros(1)
    level = float(np.sqrt(np.mean(new**2))) if new.size else 0.0
    return Noise(level=max(level, LEAST), reflection=tuple(reflection))


def noise_from_differences(signal: Array) -> float:
    """Standard deviation of white noise on a smooth signal (n,), from its second differences.

    By their median, so that a few sharp instants do not count; NaN is passed over.
    """
    return noise_of_differences(np.diff(signal[np.isfinite(signal)], 2), 2)


def noise_of_differences(change: Array, order: int) -> float:
    """Standard deviation of the white noise whose differences of an order (n,) these are, by their median."""
    if not change.size:
        return 0.0
    deviation = PER_MEDIAN * float(np.median(np.abs(change - np.median(change))))
    return deviation / float(np.sqrt(comb(2 * order, order)))
