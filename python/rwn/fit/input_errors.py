"""Errors that are left where the noise of a recorded input was taken off: what the drive makes of them is no structure.

A curve through noisy values is off the true input by some of the noise, slowly. How far, one draw shows: noise of the
same size on the curve, taken off as before. The drive's answer to that is what the errors of a right model hold beside
the noise of the sensors; both together are an autoregression.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.recording.denoising import denoised
from rwn.recording.noise import Noise, autoregression
from rwn.simulate.run import Run

Array = NDArray[np.float64]

ORDER = 8  # of the autoregression
REMEMBERED = 16  # draws kept, of a few recordings: a search asks for each many times


def of_sensors(noise: Mapping[str, Noise]) -> dict[str, Noise]:
    """The noise of each signal as its sensor has it, of what `with_input_errors` makes."""
    bare = {s: n.of_sensor for s, n in noise.items() if n.of_sensor is not None}
    return {s: replace(n, reflection=bare[s], of_sensor=None) if s in bare else n for s, n in noise.items()}


def with_input_errors(problem: Problem, this: Fit, noise: Mapping[str, Noise]) -> dict[str, Noise]:
    """The noise of the sensors with what a fit makes of the errors of the input; as it is where none was taken off."""
    if not any(run.input_noise > 0.0 for run in problem.runs):
        return dict(noise)
    rng, made = np.random.default_rng(0), dict(noise)
    answers = [_answer(problem, this, run) for run in problem.runs]
    for signal, own in noise.items():
        drawn = [
            run.masked(signal, of_a_run[signal] + _drawn(own, run.time.size, rng))
            for run, of_a_run in zip(problem.runs, answers, strict=True)
            if signal in of_a_run
        ]
        if drawn:
            made[signal] = replace(autoregression(drawn, ORDER), of_sensor=own.reflection)
    return made


def _drawn(noise: Noise, count: int, rng: np.random.Generator) -> Array:
    """Noise of a sensor (n,), white or of first order."""
    from scipy.signal import lfilter  # late: the command line starts without it

    memory = [1.0, *(-share for share in noise.reflection[:1])]
    drawn: Array = lfilter([noise.level], memory, rng.standard_normal(count))
    return drawn


def _answer(problem: Problem, this: Fit, run: Run) -> dict[str, Array]:
    """What an error of the input adds to each signal (n,) of a run that a fit can be simulated over."""
    off = _error(np.ascontiguousarray(run.input).tobytes(), run.input_noise)
    shown = problem.simulate(run, this.vector, this.active).signals
    other = problem.simulate(replace(run, input=run.input + off), this.vector, this.active).signals
    return {s: other[s] - shown[s] for s in run.recorded if np.isfinite(other[s] - shown[s]).all()}


@lru_cache(maxsize=REMEMBERED)
def _error(values: bytes, noise: float) -> Array:
    """One draw (n,) of how far an input of these values is off once noise of this deviation is taken off it."""
    given = np.frombuffer(values)
    drawn = given + noise * np.random.default_rng(0).standard_normal(given.size)
    found = denoised(drawn)
    return np.zeros(given.size) if found is None else found.values - given
