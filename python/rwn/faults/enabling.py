"""When a drive that stands still got its power: recordings with no input until then, and the instant that fits best."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import NEAR_ITS_END, Fit, refit
from rwn.fit.prior_weight import variance_inflation
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.recording.recording import Recording
from rwn.simulate.run import Run
from rwn.simulate.windows import windowed

Array = NDArray[np.float64]

TRIED = 64  # instants of enabling that are compared at a time
INSTANT_TOLERANCE = 0.01  # accuracy of the instant of enabling, in times between rows


def since_start(recording: Recording) -> Array:
    """Time [s] of each sample after the first, (n + 1,): the last is the end of the last one's step."""
    time = recording.time - recording.time[0]
    return np.append(time, 2.0 * time[-1] - time[-2])


def powered_from(time: float, recording: Recording, model: Model) -> Recording:
    """The recording with no input before a time [s]; in the step in which it comes the input acts for a part."""
    if time == 0.0:
        return recording
    given = _acting(since_start(recording), time) * np.asarray(recording.signals[model.drive.input])
    return replace(recording, signals={**recording.signals, model.drive.input: given})


def run_powered_from(time: float, run: Run) -> Run:
    """The run with no input before a time [s]; in the step in which it comes the input acts for a part."""
    if time == 0.0:
        return run
    steps, acted = np.append(run.time, 2.0 * run.time[-1] - run.time[-2]), run.applied_input
    if acted is not None:
        between = np.append(acted.instants, max(steps[-1], acted.instants[-1]))
        acted = replace(acted, values=_acting(between, time) * acted.values)
    return replace(run, input=_acting(steps, time) * run.input, applied_input=acted, input_before=0.0)


def _acting(steps: Array, time: float) -> Array:
    """The part (n,) of each step between `steps` (n + 1,) [s] in which there is power, from a time [s] on."""
    lengths = np.diff(steps)
    parts = np.divide(steps[1:] - time, lengths, out=np.where(steps[1:] > time, 1.0, 0.0), where=lengths > 0.0)
    return np.asarray(np.clip(parts, 0.0, 1.0))


@dataclass(frozen=True)
class Standstill:
    """A recording until twice the time that it stood still, and a fit that would move under its input.

    It is simulated in short windows from the recorded motion, so that what the fit lacks of the motion that follows
    does not shift the instant at which power came.
    """

    problem: Problem
    this: Fit
    recording: Recording
    run: Run  # the same as it is simulated, with power from the first sample on
    samples: int  # that stand still

    def error(self, time: float) -> float:
        """Weighted squared error of the fit with power from a time [s] on."""
        return self._with_power_from(time).error(self.this.vector, self.this.active)

    def cost(self, time: float) -> float:
        """Cost, priors included, of the hypothesis refitted to this alone with power from a time [s] on."""
        return refit(self.this, self._with_power_from(time), iterations=NEAR_ITS_END).cost

    def inflation(self, time: float) -> float:
        """`variance_inflation` of the fit with power from a time [s] on."""
        return variance_inflation(self._with_power_from(time), self.this)

    def _with_power_from(self, time: float) -> Problem:
        return replace(self.problem, runs=(run_powered_from(time, self._run),))

    @cached_property
    def _run(self) -> Run:
        """The beginning as it is simulated, with power from the first sample on."""
        return windowed(self.run.until(2 * self.samples))

    def enabling_time(self) -> float:
        """When power came [s]: where the fit errs least."""
        from scipy.optimize import minimize_scalar  # late: the command line starts without it

        times, low, high = since_start(self.recording), 0, self.samples
        while True:
            tried = np.unique(np.linspace(low, high, TRIED).astype(int))
            best = int(np.argmin([self.error(float(times[k])) for k in tried]))
            low, high = int(tried[max(best - 1, 0)]), int(tried[min(best + 1, tried.size - 1)])
            if high - low <= 2:
                break
        around = (float(times[low]), float(times[high]))
        exact = {"xatol": INSTANT_TOLERANCE * (around[1] - around[0])}
        found = minimize_scalar(self.error, bounds=around, method="bounded", options=exact)
        return min((float(times[tried[best]]), float(found.x)), key=self.error)
