"""Noise of a speed that lasts otherwise than by a first order: the winding tells it from motion.

A shaft that really turns faster than its simulation by e induces Ke e more, and less current flows. Of an error of the
speed's sensor the current knows nothing.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.input_errors import ORDER
from rwn.fit.problem import Problem
from rwn.fit.residuals import correlation_time, structured_of
from rwn.measurement.filter_colour import SensorFilter
from rwn.model.vocabulary import analog_filters, motor_values
from rwn.recording.noise import autoregression
from rwn.simulate.run import Run

Array = NDArray[np.float64]

LEVEL = 0.01  # chance that the size of noise seems to go with the motion, in any of the recordings
MOTION = 0.1  # largest part of an error of the sensor, or of its size, that may go with the motion: what a fit bends
CERTAIN = 4.0  # deviations by which the current would have shown motion
ANSWER = 16  # samples that the winding's answer to a change of the speed is looked for in


def lasting_noise(problem: Problem, this: Fit) -> list[SensorFilter]:
    """The speed, where all that lasts in its error is noise of its sensor.

    What is new in it is white, its size goes neither with the speed nor with the acceleration, and the winding says
    that the shaft did not move so.
    """
    signal, fitted = "speed", {n.effect for n in problem.prior.nuisance}
    filtered = signal in problem.filters or analog_filters(problem.prior.table)[signal].name in fitted
    if filtered or not _has_a_witness(problem):
        return []
    left = problem.residuals(this.vector, this.active)
    errors = [run.masked(signal, x[signal]) for run, x in zip(problem.runs, left, strict=True)]
    noise = autoregression(errors, ORDER)
    if noise.reflection[0] <= 0.0 or not structured_of({signal: np.concatenate(errors) / noise.level}):
        return []  # there is nothing that lasts
    if structured_of({signal: np.concatenate([noise.innovations(x) for x in errors])}):
        return []
    lasting = [np.nan_to_num(x - noise.level * noise.innovations(x)) for x in errors]  # foretold by the samples before
    current = [run.masked("current", x["current"]) for run, x in zip(problem.runs, left, strict=True)]
    if _goes_with_the_motion(problem.runs, lasting) or not _is_of_its_sensor(problem, this, lasting, current):
        return []
    share = noise.reflection[0]
    kept = problem.time_kept(signal, share)
    return [SensorFilter(signal=signal, share=share, time_constant=kept, reflection=noise.reflection)]


def _has_a_witness(problem: Problem) -> bool:
    """Whether every recording has a speed of its own and the winding's voltage and current."""
    return problem.drive.winding and all(
        run.speed.size and run.current.size and not run.speed_measured.is_difference for run in problem.runs
    )


def _goes_with_the_motion(runs: Sequence[Run], lasting: Sequence[Array]) -> bool:
    """Whether errors (n,) are larger where the shaft is faster or changes its speed more, by ranks of blocks."""
    from scipy.stats import spearmanr  # late: the command line starts without it

    ranks = []
    for run, error in zip(runs, lasting, strict=True):
        length = int(np.ceil(2.0 * correlation_time(error)))
        count = error.size // length
        sizes = [x[: count * length].reshape(count, length).mean(axis=1) for x in (error**2, *map(np.abs, run.motion))]
        ranks += [spearmanr(sizes[0], of) for of in sizes[1:] if count > 2 and np.ptp(of) > 0.0]
    return not ranks or any(r.pvalue < LEVEL / len(ranks) and r.statistic**2 > MOTION for r in ranks)


def _is_of_its_sensor(
    problem: Problem, this: Fit, lasting: Sequence[Array], current: Sequence[Array]
) -> bool:
    """Whether the errors of the current are without what the lasting ones of the speed, were they motion, induce.

    Both (n,) of each run. The answer of the winding is a few samples long; what it adds up to is that of a resting
    current.
    """
    past = [np.stack([np.roll(x, k) for k in range(ANSWER)], axis=1)[ANSWER:] for x in lasting]
    there = [np.isfinite(x[ANSWER:]) for x in current]
    before = np.concatenate([x[ok] for x, ok in zip(past, there, strict=True)])
    errors = np.concatenate([x[ANSWER:][ok] for x, ok in zip(current, there, strict=True)])
    free = errors.size - ANSWER - 1
    if free < 1:
        return False
    before, errors = before - before.mean(axis=0), errors - errors.mean()
    inverse = np.linalg.pinv(before.T @ before, hermitian=True)
    answer = inverse @ (before.T @ errors)
    rest = errors - before @ answer
    deviation = float(np.sqrt(np.sum(inverse) * (rest @ rest) / free * correlation_time(rest)))
    motor = motor_values(this.vector)
    of_motion = float(problem.drive.resting_current(motor, 1.0, 0.0) - problem.drive.resting_current(motor, 0.0, 0.0))
    share = float(np.sum(answer)) / of_motion
    return share < MOTION and CERTAIN * deviation < abs(of_motion)
