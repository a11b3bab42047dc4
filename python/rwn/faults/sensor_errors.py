"""Errors of sensors that the motion hid, told by what the best explanation leaves: spikes and hum."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.recording.inspection import Finding, Inspected, without_samples
from rwn.recording.inspection.hum import without_hum
from rwn.recording.inspection.outliers import BESIDE, most_deviations, outliers
from rwn.recording.inspection.spikes import FEWEST, SPIKES, after_steps
from rwn.recording.noise import PER_MEDIAN
from rwn.recording.recording import Recording

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

TWO_STEPS = 2  # that by chance may both have an error of a sensor


def without_sensor_errors(recordings: Sequence[Recording], problem: Problem, this: Fit) -> Inspected:
    """The recordings without samples that are far off a fit and without hum in what it leaves, and what was found.

    `problem`: of the same recordings; one that lost or moved samples on the way there is left as it is.
    """
    made, found = [], list[Finding]()
    left = problem.residuals(this.vector, this.active)
    for recording, run, errors in zip(recordings, problem.runs, left, strict=True):
        if run.time.size == len(recording):
            for signal, error in errors.items():
                flags = _far_off(run.masked(signal, error), problem.noise[signal].deviation)
                if flags.any():
                    stepped, changed = after_steps(recording), after_steps(recording, least=0.0)
                    flags &= ~_of_steps(flags, stepped > 0.0, changed > 0.0)
                if flags.any():
                    found.append(SPIKES.found(recording, signal, flags))
                    recording = without_samples(recording, signal, flags)
            simulated = {signal: run.signal(signal) - error for signal, error in errors.items()}
            recording, hum = without_hum(recording, simulated=simulated)
            found += hum
        made.append(recording)
    return Inspected(made, tuple(found))


def _far_off(error: Array, noise: float) -> Flags:
    """Of the error (n,) of a signal, NaN where nothing is compared: the few samples that are off those beside them.

    By more than four times as much as any other is: what a model has wrong it has wrong beside other steps as well.
    """
    flags = np.zeros(error.size, dtype=bool)
    compared = np.flatnonzero(np.isfinite(error))
    if compared.size < FEWEST:
        return flags
    x = error[compared]
    off, apart = np.zeros(x.size), np.full(x.size, np.inf)  # the first and the last have nothing on one side
    off[1:-1], apart[1:-1] = np.abs(x[1:-1] - 0.5 * (x[:-2] + x[2:])), np.abs(x[2:] - x[:-2])
    limit = most_deviations(off.size) * max(PER_MEDIAN * float(np.median(off)), noise)
    found = outliers(off, limit=limit, among=off.size, alone=lambda at: bool(apart[at] < BESIDE * off[at]))
    flags[compared] = found
    return flags


def _of_steps(flags: Flags, stepped: Flags, changed: Flags) -> Flags:
    """The flags (n,) of samples where the input `changed`, (n,), if they are at most of its large steps, `stepped`.

    Errors of a sensor do not wait for the input; a model that times it wrong, or its winding, errs at most of its
    steps. One step or two tell nothing.
    """
    begins = stepped & ~np.concatenate([[False], stepped[:-1]])
    step = np.cumsum(begins)[flags & stepped]  # the number of the step that each belongs to
    hit = np.unique(step).size
    return flags & changed if hit > max(TWO_STEPS, 0.5 * begins.sum()) else np.zeros(flags.size, dtype=bool)
