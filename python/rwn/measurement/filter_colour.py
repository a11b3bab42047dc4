"""First-order filters of sensors, as the colour of their noise shows them.

Noise that a filter y_k = phi y_{k-1} + (1 - phi) x_k has passed goes from sample to sample with phi = exp(-T / tau).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.problem import Problem
from rwn.fit.residuals import structured_of
from rwn.measurement.noise_spectrum import FASTEST, NoiseColour, noise_colour
from rwn.model.vocabulary import analog_filters
from rwn.recording.noise import autoregression, noise_from_differences
from rwn.simulate.run import Run

Array = NDArray[np.float64]

CERTAINLY, MAYBE = 0.9, 0.75  # probability that noise went through a filter, from which it did, and may have
SLOWEST = 0.95  # of phi: a slower filter is physics


@dataclass(frozen=True, kw_only=True)
class SensorFilter:
    """A first-order filter of one signal."""

    signal: str
    share: float  # phi: of a sample's noise that was in the sample before
    time_constant: float  # [s]
    noise: NoiseColour = field(default_factory=NoiseColour)  # what the noise alone shows of it
    digital: bool = False  # it takes samples, as a drive's program does; else it is fitted as a law of the sensor
    reflection: tuple[float, ...] = ()  # partial autocorrelations of noise that it alone has coloured

    @property
    def of_noise(self) -> bool:
        """Whether it coloured the noise alone: the motion went through none."""
        return bool(self.reflection)

    @property
    def spread(self) -> float:
        """Standard deviation of the logarithm of the time constant by the noise alone; 1 where that tells less."""
        return min(self.noise.deviation / (self.share * -float(np.log(self.share))), 1.0)


def coloured_signals(problem: Problem, residuals: Sequence[Mapping[str, Array]]) -> list[SensorFilter]:
    """The signals whose noise may have passed a filter, with the filter that would have coloured it so.

    `residuals`: (n,) of each run, by signal.
    """
    found = []
    for signal, lag in analog_filters(problem.prior.table).items():
        parts = [(run, left[signal]) for run, left in zip(problem.runs, residuals, strict=True) if signal in left]
        parts = [(run, x) for run, x in parts if _is_sensor_noise(run, signal, x)]
        if not parts or signal in problem.filters or lag.name in problem.prior.effects:
            continue
        colour = noise_colour([run.masked(signal, x) for run, x in parts])
        if colour.filtered > MAYBE:
            share = min(colour.share, SLOWEST)
            step = float(np.median([run.sample_time for run, _ in parts]))
            if colour.share >= SLOWEST:  # it is physics that is seen, which tells nothing of a filter
                colour = replace(colour, deviation=np.inf, evidence=0.0)
            found.append(
                SensorFilter(signal=signal, share=share, time_constant=-step / float(np.log(share)), noise=colour)
            )
    return found


def certain(seen: Sequence[SensorFilter]) -> bool:
    """Whether the noise of a signal did pass a filter; then all that may have are worth asking."""
    return any(f.noise.filtered > CERTAINLY for f in seen)


def coloured_noise(problem: Problem, residuals: Sequence[Mapping[str, Array]]) -> list[SensorFilter]:
    """The signals whose errors are first-order noise and nothing else, and went through no filter that is known.

    `residuals`: (n,) of each run, by signal. What is new in such errors is white.
    """
    lags, known = analog_filters(problem.prior.table), {n.effect for n in problem.prior.nuisance}
    found = []
    for seen in coloured_signals(problem, residuals):
        pairs = zip(problem.runs, residuals, strict=True)
        errors = [run.masked(seen.signal, left[seen.signal]) for run, left in pairs if seen.signal in left]
        noise = autoregression(errors, 1)
        (share,) = noise.reflection
        if not FASTEST < share < SLOWEST or lags[seen.signal].name in known:
            continue
        if not structured_of({seen.signal: np.concatenate([noise.innovations(x) for x in errors])}):
            time_constant = seen.time_constant * float(np.log(seen.share) / np.log(share))
            found.append(replace(seen, share=share, time_constant=time_constant, reflection=noise.reflection))
    return found


def _is_sensor_noise(run: Run, signal: str, residual: Array) -> bool:
    """Whether its noise is a sensor's: not that of counts or their difference, and larger than its steps."""
    if signal == "speed" and run.speed_measured.is_difference:
        return False
    return noise_from_differences(residual) > 2.0 * run.quantisation(signal)
