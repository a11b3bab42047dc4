"""A power stage that was enabled after the recording began: a voltage was commanded, and nothing moved.

Friction and a dead zone hold a drive too, and an input may act late throughout: a late enable is said where it explains
the recordings far better than these. An explanation under which the drive would have stood still anyway needs none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit, fit, fit_nominal
from rwn.fit.hypothesis import hypothesis
from rwn.fit.likelihood import DECISIVE
from rwn.fit.nominal import nominal_of
from rwn.fit.preparation import prepare
from rwn.fit.prior_weight import worth
from rwn.fit.problem import Problem
from rwn.model.initial_state import CERTAIN, resolution
from rwn.model.model import Model
from rwn.name.observable import observable
from rwn.name.screening import screen
from rwn.recording.recording import Recording, beginnings
from rwn.simulate.run import Run, run_of

Array = NDArray[np.float64]

FEWEST = 3  # samples that stand still: fewer are what an inductance and an inertia take
DELAY = "input-delay"
HOLDING = ("coulomb-friction", "stribeck-friction", "actuator-deadzone")  # under which a drive stands still too
TRIED = 64  # instants of enabling that are compared at a time


@dataclass(frozen=True, kw_only=True)
class LateEnable:
    """The first `samples` of a recording had no power."""

    place: int  # of the recording among those that were given
    recording: str
    samples: int
    time: float  # [s] after its first sample


def late_enables(recordings: Sequence[Recording], model: Model) -> tuple[LateEnable, ...]:
    """What stood still where the refitted nominal model would have moved, and no friction, dead zone or delay did it.

    Raises InputError where a recording does not fit the model.
    """
    still = [_standing_samples(r, model) for r in recordings]
    if model.drive.coefficients or not any(still):
        return ()
    problem, nominal = nominal_of([_without_input(r, model, k) for r, k in zip(recordings, still, strict=True)], model)
    found = _enabled_late(recordings, model, problem, nominal, problem.runs)
    return _worthwhile(found, recordings, model) if found else ()


def late_beside(recordings: Sequence[Recording], model: Model, problem: Problem, this: Fit) -> tuple[LateEnable, ...]:
    """What stood still, of recordings that were not fitted, where an explanation `this` of others would have moved."""
    if model.drive.coefficients:
        return ()
    return _enabled_late(recordings, model, problem, this, [run_of(r, model) for r in recordings])


def _enabled_late(
    recordings: Sequence[Recording], model: Model, problem: Problem, this: Fit, runs: Sequence[Run]
) -> tuple[LateEnable, ...]:
    found = []
    for k, (recording, run) in enumerate(zip(recordings, runs, strict=True)):
        samples = _standing_samples(recording, model)
        if samples and _would_move(problem, this, recording, model, run, samples):
            enabled = _enabling_sample(problem, this, recording, model, run, samples)
            time = float(recording.time[enabled] - recording.time[0])
            if enabled >= FEWEST:
                found.append(LateEnable(place=k, recording=recording.name, samples=enabled, time=time))
    return tuple(found)


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


def _standing_samples(recording: Recording, model: Model) -> int:
    """Samples from the first on that stand still, of a recording with an input in them; 0 of others."""
    measured = [np.asarray(x) for name, x in recording.signals.items() if name != model.drive.input]
    moved = [np.abs(x - np.median(x[:FEWEST])) > CERTAIN * resolution(x, x.size) for x in measured]
    samples = min((int(np.argmax(m)) if m.any() else m.size - 1 for m in moved), default=0)
    given = np.asarray(recording.signals[model.drive.input])[: max(samples - FEWEST, 0)]
    return samples if samples > FEWEST and given.any() else 0


def _worthwhile(
    found: tuple[LateEnable, ...], recordings: Sequence[Recording], model: Model
) -> tuple[LateEnable, ...]:
    """The late enables with each of which the recordings are far likelier than by what else holds a drive or delays it.

    Each is a number of its own. With it and without, the same effects may act beside the nominal model; errors count as
    what the best leaves is worth.
    """
    weighted, _ = nominal_of(beginnings(powered(recordings, found, model)), model)
    waits = [_waiting_time(recordings[late.place], late, model) for late in found]

    def best(kept: Sequence[LateEnable]) -> Fit:
        on = prepare(beginnings(powered(recordings, kept, model)), model)
        return _best_held(replace(on, noise=weighted.noise, colour=weighted.colour), waits)

    this = best(found)
    enough = 2.0 * worth(weighted, this) * DECISIVE
    while found:
        others = {late: best([other for other in found if other != late]) for late in found}
        least = min(others, key=lambda late: others[late].cost)
        if others[least].cost - this.cost > enough:
            break
        found, this = tuple(late for late in found if late != least), others[least]
    return found


def _best_held(problem: Problem, waits: Sequence[float]) -> Fit:
    """The best of the nominal model, what holds a drive, and a delay of the input beside either.

    `waits`: delays [s] to begin from.
    """
    nominal = fit_nominal(problem)
    held = min([nominal, *screen(problem, nominal, [n for n in HOLDING if observable(n, problem)])], key=_cost)
    if DELAY in held.hypothesis.effects or not observable(DELAY, problem):
        return held
    names, known = (*held.added, DELAY), held.starts(held.added)
    begun = [{**known, DELAY: {"delay": wait}} for wait in waits]
    delayed = [fit(problem, hypothesis(problem.prior, names, problem.scales, start, held.motor)) for start in begun]
    return min([held, *delayed], key=_cost)


def _cost(this: Fit) -> float:
    return this.cost


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
