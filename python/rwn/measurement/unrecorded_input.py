"""The input where no row shows it: between its neighbours, as the motion that followed tells.

Each unknown value adds the response of the linear drive to a pulse. They are fitted together to the errors of the
refitted nominal model, each with a deviation in proportion to that of what may lie anywhere between two neighbours, and
kept between them. The errors and responses are those of a high-pass filter: what else is missing moves slowly. As many
unknown values as samples take up much of the noise: how much is what they take up of noise that is drawn.
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
from rwn.fit.refitting import refitted_beside
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered
from rwn.measurement.switched_input import is_of_stairs, switched
from rwn.model.model import Model
from rwn.model.vocabulary import motor_index
from rwn.recording.inspection import Finding, inspected
from rwn.recording.intersample import AUTO, HELD, INTERSAMPLE, PiecewiseInput
from rwn.recording.noise import noise_from_differences
from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED
from rwn.recording.speed_measurement import SpeedMeasurement
from rwn.simulate.run import Run

if TYPE_CHECKING:
    from scipy.sparse import csr_array

Array = NDArray[np.float64]

SLOW = 0.9  # pole of the high-pass filter: it forgets within tens of rows
LASTS = 60  # rows after which nothing is left of a response in the filter
FINE = 8  # steps of a response per row
ROUNDS = 2  # of fitting the model and the input
ROUNDS_OF_SWITCHES = 3
TELLING = 200  # unknown values in a row, by which the share of their deviations is known to five per cent
STEPS = 20  # of expectation and maximisation
LEAST_SHARE = 1e-6  # of a variance: less moves nothing
TOLD = "told by the motion that followed"  # what is done about it in a recording that was not fitted
LEAST_LEFT = 0.01  # of the noise of a signal: less is rounding


def with_unrecorded_input(
    recordings: Sequence[Recording], model: Model, explanation: Fit | None = None, *,
    filters: Sequence[SensorFilter] = (),
) -> list[Recording]:  # fmt: skip
    """The recordings with their input as it acted by the model's law and the motion.

    `explanation`: of the motion, refitted; None: the nominal model, under which an input that acts late, say, is bent.
    `filters`: of the sensors, beside it.

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
            problem = filtered(problem, filters)
            (this,) = refitted_beside([explanation], problem)
        left = problem.residuals(this.vector, this.active)
        for k, (run, given) in enumerate(zip(problem.runs, applied, strict=True)):
            if given is not None and given.spread.any() and not run.restart_every:
                made[k] = replace(made[k], applied_input=_inferred(problem, this, run, left[k], given))
    return made


def recording_with_inferred_input(recording: Recording, model: Model) -> Recording:
    """A recording with its input as it acted, between rows that show it, by its motion and a model as it stands.

    Raises InputError where the recording does not fit the model.
    """
    ((inspected_one,), _) = inspected([recording])
    (told,) = with_unrecorded_input([inspected_one], replace(model, uncertainty={}))
    return replace(recording, applied_input=told.applied_input)


def with_inferred_input(problem: Problem, this: Fit) -> Problem:
    """The problem with the input values of its runs that no row shows as the errors of a fit tell."""
    runs = list(problem.runs)
    if not has_unknown_input(problem):
        return problem
    for k, (run, left) in enumerate(zip(runs, problem.residuals(this.vector, this.active), strict=True)):
        if (given := run.applied_input) is not None and _is_unknown(run):
            runs[k] = replace(run, applied_input=_inferred(problem, this, run, left, given))
    return replace(problem, runs=tuple(runs))


def rounds(problem: Problem) -> int:
    """How often a fit and the input take turns: a switch that is told wrong keeps a fit from telling others."""
    applied = [run.applied_input for run in problem.runs if _is_unknown(run)]
    return ROUNDS_OF_SWITCHES if any(given is not None and is_of_stairs(given) for given in applied) else 1


def inferred_input_findings(unseen: Sequence[Run], given: str) -> list[Finding]:
    """What a check says of recordings that were not fitted, where their motion told some of their input, `given`."""
    return [
        Finding(
            kind="intersample", recording=run.name, signals=(given,), count=int(np.sum(applied.spread > 0.0)),
            words=f"no row shows the {given} that acted between two of them", done=TOLD,
        )
        for run in unseen
        if (applied := run.applied_input) is not None and _is_unknown(run)
    ]  # fmt: skip


def has_unknown_input(problem: Problem) -> bool:
    """Whether a run of a problem has input values that no row shows, and that its motion may tell."""
    return any(_is_unknown(run) for run in problem.runs)


def _is_unknown(run: Run) -> bool:
    given = run.applied_input
    return given is not None and bool(given.spread.any()) and not run.restart_every


def _inferred(
    problem: Problem, this: Fit, run: Run, left: Mapping[str, Array], given: PiecewiseInput
) -> PiecewiseInput:
    """`given` with its unknown values as the errors `left` of a simulation under those of `run` tell."""
    from scipy.signal import lfilter  # late: the command line starts without it
    from scipy.sparse import diags_array

    unknown = given.spread > 0.0
    stairs = is_of_stairs(given)
    together = None if stairs else given.gaps  # values that lie off the line as one
    one = unknown[1:] & unknown[:-1] & (np.diff(together) == 0 if together is not None else False)
    begins = np.concatenate([[True], ~one])
    first = np.flatnonzero(unknown & begins)
    after = np.flatnonzero(begins & np.concatenate([[False], unknown[:-1]]))
    ends = np.append(given.instants[after], run.time[-1])[: first.size]
    assumed = given if run.applied_input is None else run.applied_input
    before = (assumed.values - given.values)[first]  # what the errors are corrected by already
    responses, errors = {}, {}
    for signal, error in left.items():
        if signal not in MEASURED:  # the driving force that a motion would need
            continue
        level = problem.noise[signal].deviation
        response = _pulses(problem, this, run, signal, given.instants[first], ends) / level
        masked = run.masked(signal, error) / level
        compared = np.isfinite(masked)
        if not compared.any():
            continue
        filled = np.interp(run.time, run.time[compared], masked[compared])
        weight = diags_array(compared.astype(np.float64))
        responses[signal] = (weight @ response).tocsr()
        errors[signal] = compared * lfilter([1.0, -1.0], [1.0, -SLOW], filled) + responses[signal] @ before
    if not responses:
        return given
    if stairs:
        return switched(given, responses, errors)
    share, levels = _magnitudes(responses, errors, given.spread[first])
    responses = {s: r / levels[s] for s, r in responses.items()}
    rng = np.random.default_rng(0)
    both = {s: np.stack([e / levels[s], rng.standard_normal(e.size)], axis=1) for s, e in errors.items()}
    told = _told(responses, both, share * given.spread[first])
    low, high = _farthest(given, first)
    values = given.values.copy()
    values[unknown] += np.clip(told[:, 0], low, high)[np.searchsorted(first, np.flatnonzero(unknown), side="right") - 1]
    noise = {s: (noises[:, 1], responses[s] @ told[:, 1]) for s, noises in both.items()}
    return replace(given, values=values, noise_left={s: _share_left(*each) for s, each in noise.items()})


def _farthest(given: PiecewiseInput, first: NDArray[np.intp]) -> tuple[Array, Array]:
    """The least and the most (m,) that unknown values, which begin at `first` (m,), may move by.

    They reach to the nearest known value on either side, and as far as the input may lie off the line between these.
    """
    off = np.sqrt(3.0) * given.spread[first]
    known = np.concatenate([[0], np.flatnonzero(given.spread == 0.0), [given.values.size - 1]])
    place = np.searchsorted(known[1:-1], first)  # of the next one that is known
    beside = np.stack([known[place], known[place + 1]])
    way = given.values[beside] - given.values[first]
    return np.minimum(way.min(axis=0), -off), np.maximum(way.max(axis=0), off)


def _told(responses: Mapping[str, csr_array], errors: Mapping[str, Array], spread: Array) -> Array:
    """The unknown values (m, k) of deviations `spread` (m,) that errors (n, k) of unit noise tell, by signal."""
    from scipy.sparse import diags_array
    from scipy.sparse.linalg import spsolve

    normal = diags_array(1.0 / spread**2) + sum(r.T @ r for r in responses.values())
    return np.asarray(spsolve(normal.tocsc(), sum(r.T @ errors[s] for s, r in responses.items())))


def _magnitudes(
    responses: Mapping[str, csr_array], errors: Mapping[str, Array], spread: Array
) -> tuple[float, dict[str, float]]:
    """The share of their deviations `spread` (m,) that unknown values have, at most 1, and the noise of each signal.

    The likeliest, as those show that may lie farthest off: expectation and maximisation (Dempster, Laird, Rubin 1977).
    """
    few = min(spread.size, TELLING)
    begin = int(np.argmax(np.convolve(spread, np.ones(few), mode="valid")))
    these = slice(begin, begin + few)
    blocks = {s: r[:, these] for s, r in responses.items()}
    kept = {s: np.unique(block.nonzero()[0]) for s, block in blocks.items()}  # rows that say anything
    parts = {s: blocks[s][kept[s]].toarray() * spread[these] for s in blocks}
    targets = {s: errors[s][kept[s]] for s in parts}
    grams = {s: p.T @ p for s, p in parts.items()}
    share, noise = 1.0, dict.fromkeys(parts, 1.0)
    for _ in range(STEPS):
        within = np.linalg.inv(sum(g / noise[s] for s, g in grams.items()) + np.eye(few) / share)
        told = within @ sum(p.T @ targets[s] / noise[s] for s, p in parts.items())
        share = float(np.clip((told @ told + np.trace(within)) / few, LEAST_SHARE, 1.0))
        for s, p in parts.items():
            left = np.sum((targets[s] - p @ told) ** 2) + np.sum(grams[s] * within)
            noise[s] = max(float(left) / max(targets[s].size, 1), LEAST_SHARE)
    return float(np.sqrt(share)), {s: float(np.sqrt(v)) for s, v in noise.items()}


def _share_left(noise: Array, told: Array) -> float:
    """The share of the deviation of white noise (n,) that is left once the input that it `told` (n,) is taken off."""
    return float(np.clip(noise_from_differences(noise - told) / noise_from_differences(noise), LEAST_LEFT, 1.0))


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
    """Of a signal, as it is measured, to an input of 1 from 0 on at multiples of `step` [s], without friction.

    It comes as late as the fit has it, by a delay of the input or by its sensor.
    """
    way = run.speed_measured
    time: Array = step * np.arange((LASTS + 2.0) * FINE)
    fine = SpeedMeasurement(FINE * way.before, FINE * way.after)
    at_rest = Run(name=run.name, time=time, input=np.zeros(time.size), speed_measured=fine)
    known, vector = this.hypothesis.table, this.vector.copy()
    late = [known[name].index for name in this.hypothesis.effects if known[name].retards]
    vector[motor_index("coulomb_friction")] = 0.0  # it holds what is at rest, not what moves
    on, off = (
        problem.simulator.simulate(replace(at_rest, input=given), vector, late).signals[signal]
        for given in (np.ones(time.size), np.zeros(time.size))
    )
    return on - off
