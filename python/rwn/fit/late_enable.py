"""A power stage that was enabled after the recording began: a voltage was commanded, and nothing moved.

Standing still under an input tells this apart from friction: an explanation under which the drive would have stood
still anyway needs no late enable. Nor does one under which the input acts late throughout: a delay says more.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit, fit, fit_nominal
from rwn.fit.hypothesis import hypothesis
from rwn.fit.nominal import nominal_of
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.model.initial_state import CERTAIN, resolution
from rwn.model.model import Model
from rwn.recording.recording import Recording
from rwn.simulate.run import Run, run_of

Array = NDArray[np.float64]

FEWEST = 3  # samples that stand still: fewer are what an inductance and an inertia take
DELAY = "input-delay"
TRIED = 64  # instants of enabling that are compared at a time


@dataclass(frozen=True, kw_only=True)
class LateEnable:
    """The first `samples` of a recording had no power."""

    place: int  # of the recording among those that were given
    recording: str
    samples: int
    time: float  # [s] after its first sample


def late_enables(recordings: Sequence[Recording], model: Model) -> tuple[LateEnable, ...]:
    """What stood still where the refitted nominal model would have moved.

    Raises InputError where a recording does not fit the model.
    """
    still = _standing_samples(recordings, model)
    if model.drive.coefficients or not any(still):
        return ()
    problem, nominal = nominal_of([_without_input(r, model, k) for r, k in zip(recordings, still, strict=True)], model)
    found: list[LateEnable] = []
    for k, (recording, run, samples) in enumerate(zip(recordings, problem.runs, still, strict=True)):
        if samples and _would_move(problem, nominal, recording, model, run, samples):
            enabled = _enabling_sample(problem, nominal, recording, model, run, samples)
            time = float(recording.time[enabled] - recording.time[0])
            if enabled >= FEWEST:
                found.append(LateEnable(place=k, recording=recording.name, samples=enabled, time=time))
    return () if found and _is_a_delay(found, recordings, model, problem) else tuple(found)


def powered(recordings: Sequence[Recording], found: Sequence[LateEnable], model: Model) -> list[Recording]:
    """The recordings with no input where they had no power."""
    samples = {late.place: late.samples for late in found}
    return [_without_input(r, model, samples.get(k, 0)) for k, r in enumerate(recordings)]


def needed(
    found: Sequence[LateEnable], recordings: Sequence[Recording], model: Model, problem: Problem, this: Fit
) -> tuple[LateEnable, ...]:
    """Those without which an explanation would move where the recordings stand still; `problem`: of `powered` ones."""
    return tuple(
        late
        for late in found
        if _would_move(problem, this, recordings[late.place], model, problem.whole[late.place], late.samples)
    )


def _standing_samples(recordings: Sequence[Recording], model: Model) -> list[int]:
    """Samples from the first on that stand still under an input, of each recording; 0 where few do.

    Or where friction or a dead zone may have held it: where no larger input acted on them than when the motion begins,
    or than when other recordings begin to move.
    """
    begun = [_beginning_of(r, model) for r in recordings]
    standing = []
    for k, this in enumerate(begun):
        elsewhere = [max(b.held, b.moved) for j, b in enumerate(begun) if j != k and b.samples > FEWEST]
        held = 0.0 < this.moved <= this.held or this.held > max(elsewhere, default=np.inf)
        standing.append(this.samples if this.samples > FEWEST and held else 0)
    return standing


class _Beginning(NamedTuple):
    """How a recording begins: the samples that stand still, and the largest input before and when it moves."""

    samples: int
    held: float
    moved: float


def _beginning_of(recording: Recording, model: Model) -> _Beginning:
    measured = [np.asarray(x) for name, x in recording.signals.items() if name != model.drive.input]
    moved = [np.abs(x - np.median(x[:FEWEST])) > CERTAIN * resolution(x, x.size) for x in measured]
    samples = min((int(np.argmax(m)) for m in moved), default=0)
    given = np.abs(np.asarray(recording.signals[model.drive.input])[: samples + 1])
    begins = max(samples - FEWEST, 0)
    return _Beginning(samples, float(np.max(given[:begins], initial=0.0)), float(np.max(given[begins:])))


def _is_a_delay(
    found: Sequence[LateEnable], recordings: Sequence[Recording], model: Model, powered_later: Problem
) -> bool:
    """Whether an input that acts late in all recordings leaves no more of them than these late enables do.

    Each late enable is a number of its own; a delay is one for all, and says what any other recording will do.
    """
    problem = replace(prepare(recordings, model), noise=powered_later.noise, colour=powered_later.colour)
    if DELAY in problem.prior.effects:
        return False
    waits = [_waiting_time(recordings[late.place], late, model) for late in found]
    late = fit(problem, hypothesis(problem.prior, (DELAY,), problem.scales, {DELAY: {"delay": float(max(waits))}}))
    return late.cost <= fit_nominal(powered_later).cost


def _waiting_time(recording: Recording, late: LateEnable, model: Model) -> float:
    """From the first input to the power [s], between two rows: at a row a delay has two slopes."""
    begins = int(np.argmax(np.asarray(recording.signals[model.drive.input]) != 0.0))
    before, after = recording.time[late.samples - 1], recording.time[late.samples]
    return float(max(0.5 * (before + after) - recording.time[begins], 0.0))


def _without_input(recording: Recording, model: Model, samples: int) -> Recording:
    if not samples:
        return recording
    given = np.array(recording.signals[model.drive.input])
    given[:samples] = 0.0
    return replace(recording, signals={**recording.signals, model.drive.input: given})


def _would_move(problem: Problem, this: Fit, recording: Recording, model: Model, beside: Run, samples: int) -> bool:
    """Whether a fit leaves the noise of the samples that stand still, under the input as it was recorded."""
    run = replace(run_of(recording, model).until(samples), own=beside.own)
    if run.in_motion:
        return False
    out = problem.simulate(run, this.vector, this.active).signals
    error = {s: np.abs(out[s] - run.signal(s)) for s in run.recorded}
    return any(np.max(e) > CERTAIN * problem.noise[s].deviation for s, e in error.items())


def _enabling_sample(problem: Problem, this: Fit, recording: Recording, model: Model, beside: Run, samples: int) -> int:
    """The sample at which power came: that under which the fit errs least, until twice the time that it stood still."""

    def error(k: int) -> float:
        run = replace(run_of(_without_input(recording, model, k), model).until(2 * samples), own=beside.own)
        return replace(problem, runs=(run,)).error(this.vector, this.active)

    low, high = 0, samples
    while True:
        tried = np.unique(np.linspace(low, high, TRIED).astype(int))
        best = int(np.argmin([error(int(k)) for k in tried]))
        low, high = int(tried[max(best - 1, 0)]), int(tried[min(best + 1, tried.size - 1)])
        if high - low <= 2:
            return int(tried[best])
