"""The input where no row shows it: between its neighbours, as the motion that followed tells.

Each unknown value adds the response of the linear drive to a pulse. They are fitted together to the errors of the
refitted nominal model, each with the deviation of what may lie anywhere between two neighbours, and kept between them.
The errors and responses are those of a high-pass filter: what else is missing moves slowly.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.nominal import nominal_of
from rwn.fit.problem import Problem
from rwn.fit.sensor_filter import refitted_beside
from rwn.model.model import Model
from rwn.model.vocabulary import motor_index
from rwn.recording.intersample import AUTO, HELD, INTERSAMPLE, PiecewiseInput
from rwn.recording.recording import Recording
from rwn.recording.speed_measurement import SpeedMeasurement
from rwn.simulate.run import Run

if TYPE_CHECKING:
    from scipy.sparse import csr_array

Array = NDArray[np.float64]

SLOW = 0.9  # pole of the high-pass filter: it forgets within tens of rows
LASTS = 60  # rows after which nothing is left of a response in the filter
FINE = 8  # steps of a response per row
ROUNDS = 2  # of fitting the model and the input


def with_unrecorded_input(
    recordings: Sequence[Recording], model: Model, explanation: Fit | None = None
) -> list[Recording]:
    """The recordings with their input as it acted by the model's law and the motion.

    `explanation`: of the motion, refitted; None: the nominal model, under which an input that acts late, say, is bent.

    Raises InputError where a recording does not fit the model.
    """
    law = model.recording.intersample
    if law in (AUTO, HELD) or model.drive.coefficients:
        return list(recordings)
    between = INTERSAMPLE[law].applied
    applied = [between(r.time - r.time[0], np.asarray(r.signals[model.drive.input])) for r in recordings]
    made = [replace(r, applied_input=a) for r, a in zip(recordings, applied, strict=True)]
    for _ in range(ROUNDS):
        problem, this = nominal_of(made, model)
        if explanation is not None:
            (this,) = refitted_beside([explanation], problem)
        left = problem.residuals(this.vector, this.active)
        for k, (run, given) in enumerate(zip(problem.runs, applied, strict=True)):
            if given is not None and given.spread.any() and not run.restart_every:
                made[k] = replace(made[k], applied_input=_inferred(problem, this, run, left[k], given))
    return made


def _inferred(
    problem: Problem, this: Fit, run: Run, left: Mapping[str, Array], given: PiecewiseInput
) -> PiecewiseInput:
    """`given` with its unknown values as the errors `left` of a simulation under those of `run` tell."""
    from scipy.signal import lfilter  # late: the command line starts without it
    from scipy.sparse import diags_array, vstack
    from scipy.sparse.linalg import spsolve

    unknown = given.spread > 0.0  # neighbours that no row shows are one unknown
    first = np.flatnonzero(unknown & ~np.concatenate([[False], unknown[:-1]]))
    after = np.flatnonzero(~unknown & np.concatenate([[False], unknown[:-1]]))
    ends = np.append(given.instants[after], run.time[-1])[: first.size]
    assumed = given if run.applied_input is None else run.applied_input
    before = (assumed.values - given.values)[first]  # what the errors are corrected by already
    responses, errors = [], []
    for signal, error in left.items():
        level = problem.noise[signal].deviation
        response = _pulses(problem, this, run, signal, given.instants[first], ends) / level
        masked = run.masked(signal, error) / level
        compared = np.isfinite(masked)
        if not compared.any():
            continue
        filled = np.interp(run.time, run.time[compared], masked[compared])
        weight = diags_array(compared.astype(np.float64))
        responses.append(weight @ response)
        errors.append(compared * lfilter([1.0, -1.0], [1.0, -SLOW], filled))
    joined = vstack(responses).tocsr()
    spread = given.spread[first]
    target = np.concatenate(errors) + joined @ before
    found = spsolve((joined.T @ joined + diags_array(1.0 / spread**2)).tocsc(), joined.T @ target)
    limit = np.sqrt(3.0) * spread  # half the way from neighbour to neighbour
    moved = np.clip(found, -limit, limit)
    values = given.values.copy()
    values[unknown] += moved[np.searchsorted(first, np.flatnonzero(unknown), side="right") - 1]
    return replace(given, values=values)


def _pulses(problem: Problem, this: Fit, run: Run, signal: str, begin: Array, end: Array) -> csr_array:
    """What an input of 1 from `begin` to `end` (m,) adds to the rows of a signal, (n, m), in the filter."""
    from scipy.signal import lfilter
    from scipy.sparse import csr_array

    step = run.sample_time / FINE
    table = _step_response(problem, this, run, signal, step)
    rows = np.searchsorted(run.time, begin, side="right")[:, None] + np.arange(LASTS)
    inside = rows < run.time.size
    at = run.time[np.minimum(rows, run.time.size - 1)]
    grid = step * np.arange(table.size)
    pulse = np.interp(at - begin[:, None], grid, table) - np.interp(at - end[:, None], grid, table)
    filtered = lfilter([1.0, -1.0], [1.0, -SLOW], pulse, axis=1)
    columns = np.broadcast_to(np.arange(begin.size)[:, None], rows.shape)
    return csr_array((filtered[inside], (rows[inside], columns[inside])), shape=(run.time.size, begin.size))


def _step_response(problem: Problem, this: Fit, run: Run, signal: str, step: float) -> Array:
    """Of a signal, as it is measured, to an input of 1 from 0 on at multiples of `step` [s], without friction."""
    way = run.speed_measured
    time: Array = step * np.arange((LASTS + 2.0) * FINE)
    fine = SpeedMeasurement(FINE * way.before, FINE * way.after)
    at_rest = Run(name=run.name, time=time, input=np.zeros(time.size), speed_measured=fine)
    vector = this.vector.copy()
    vector[motor_index("coulomb_friction")] = 0.0  # it holds what is at rest, not what moves
    on, off = (
        problem.simulator.simulate(replace(at_rest, input=given), vector, []).signals[signal]
        for given in (np.ones(time.size), np.zeros(time.size))
    )
    return on - off
