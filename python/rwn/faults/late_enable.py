"""A power stage that was enabled after the recording began: a voltage was commanded, and nothing moved.

Friction and a dead zone hold a drive too, and an input may act late throughout: a late enable is said where it explains
the recordings far better than these. An explanation under which the drive would have stood still anyway needs none.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter

import numpy as np
from numpy.typing import NDArray

from rwn.faults.enabling import Standstill, powered_from, run_powered_from, since_start
from rwn.faults.standstill import FEWEST, first_moved
from rwn.fit.fit import NEAR_ITS_END, Fit, fit, fit_nominal, refit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.nominal import nominal_of
from rwn.fit.preparation import prepare
from rwn.fit.prior_weight import variance_inflation
from rwn.fit.problem import Problem
from rwn.measurement.likelihood import DECISIVE
from rwn.model.initial_state import CERTAIN
from rwn.model.model import Model
from rwn.model.vocabulary import Effect
from rwn.name.observable import observable
from rwn.name.screening import screen
from rwn.recording.inspection import Finding
from rwn.recording.recording import Recording, beginnings
from rwn.simulate.recorded_run import run_of
from rwn.simulate.run import Run

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class LateEnable:
    """A recording that had no power until some time after its first sample."""

    place: int  # of the recording among those that were given
    recording: str
    samples: int  # before that time
    time: float  # [s] after the first sample

    def as_finding(self, given: str) -> Finding:
        """As a check of recordings says it. `given`: the input."""
        return Finding(
            kind="late-enable", recording=self.recording, signals=(given,), count=self.samples,
            words=f"it stands still under its {given} for the first {self.time:.3g} s, as before an enable",
            done=f"the {given} is taken as 0 until then",
        )  # fmt: skip


def late_enables(recordings: Sequence[Recording], model: Model) -> tuple[LateEnable, ...]:
    """What stood still where the refitted nominal model would have moved, and no friction, dead zone or delay did it.

    Raises InputError where a recording does not fit the model.
    """
    still = [_standing_samples(r, model) for r in recordings]
    if model.drive.coefficients or not any(still):
        return ()
    without = [powered_from(since_start(r)[k], r, model) for r, k in zip(recordings, still, strict=True)]
    problem, nominal = nominal_of(without, model)
    found = _enabled_late(recordings, model, problem, nominal, problem.runs)
    found = tuple(late for late in found if _gains(late, recordings, model, problem, nominal))
    return _worthwhile(found, recordings, model) if found else ()


def _gains(late: LateEnable, recordings: Sequence[Recording], model: Model, problem: Problem, this: Fit) -> bool:
    """Whether a recording is far likelier with a late enable where a fit explains its beginning alone."""
    beginning = _beginning(problem, this, recordings[late.place], model, problem.runs[late.place])
    gained = beginning.cost(0.0) - beginning.cost(late.time)
    return 2.0 * DECISIVE * beginning.inflation(late.time) < gained < np.inf


def late_beside(
    recordings: Sequence[Recording], model: Model, problem: Problem, this: Fit, *, known: Sequence[LateEnable] = ()
) -> tuple[LateEnable, ...]:
    """Late enables where a recording stood still and an explanation would have moved; without those that are `known`.

    The explanation may be one of other recordings. A friction that was a little larger on that day holds a drive too,
    so a late enable has to make the recording decisively likelier also with the explanation refitted to it alone.
    """
    if model.drive.coefficients:
        return ()
    runs, enough = [run_of(r, model) for r in recordings], 2.0 * variance_inflation(problem, this) * DECISIVE
    found = _enabled_late(recordings, model, problem, this, runs, known=known)
    each = {late: _beginning(problem, this, recordings[late.place], model, runs[late.place]) for late in found}
    gained = {late: of.cost(0.0) - of.cost(late.time) for late, of in each.items()}
    return tuple(late for late in found if enough < gained[late] < np.inf)  # one that runs away tells nothing


def _enabled_late(
    recordings: Sequence[Recording], model: Model, problem: Problem, this: Fit, runs: Sequence[Run], *,
    known: Sequence[LateEnable] = (),
) -> tuple[LateEnable, ...]:  # fmt: skip
    found, places = [], {late.place for late in known}
    for k, (recording, run) in enumerate(zip(recordings, runs, strict=True)):
        samples = 0 if k in places else _standing_samples(recording, model)
        if samples and _would_move(problem, this, recording, model, run, samples):
            time = _beginning(problem, this, recording, model, run).enabling_time()
            late = _enabled_at(time, k, recording)
            if late.samples >= FEWEST:
                found.append(late)
    return tuple(found)


def powered(recordings: Sequence[Recording], found: Sequence[LateEnable], model: Model) -> list[Recording]:
    """The recordings with no input where they had no power."""
    times = {late.place: late.time for late in found}
    return [powered_from(times.get(k, 0.0), r, model) for k, r in enumerate(recordings)]


def late_under(
    found: Sequence[LateEnable], recordings: Sequence[Recording], model: Model, problem: Problem, this: Fit
) -> tuple[LateEnable, ...]:
    """Those of `found` that an explanation needs, at the times that it asks for, and what it alone shows."""
    still = retimed(needed(found, recordings, model, problem, this), recordings, model, problem, this)
    shown = late_beside(recordings, model, problem, this, known=still)
    return tuple(sorted((*still, *shown), key=attrgetter("place")))


def needed(
    found: Sequence[LateEnable], recordings: Sequence[Recording], model: Model, problem: Problem, this: Fit
) -> tuple[LateEnable, ...]:
    """Those without which an explanation would move where the recordings stand still; `problem`: of `powered` ones."""
    return tuple(
        late
        for late in found
        if _would_move(problem, this, recordings[late.place], model, problem.whole[late.place], late.samples)
    )


def retimed(
    found: Sequence[LateEnable], recordings: Sequence[Recording], model: Model, problem: Problem, this: Fit
) -> tuple[LateEnable, ...]:
    """The late enables at the times at which an explanation errs least, where that is decisively better.

    Physics that was missing when a late enable was found, such as a delay, shifts its time. The gain is weighed by what
    is left at the better time, since a wrong time leaves a position off for good. `problem`: of `powered` recordings.
    """
    made = []
    for late in found:
        recording = recordings[late.place]
        beginning = _beginning(problem, this, recording, model, problem.whole[late.place])
        time = beginning.enabling_time()
        gained = beginning.error(late.time) - beginning.error(time)
        better = gained > 2.0 * DECISIVE and gained > 2.0 * DECISIVE * _inflation(time, late, beginning, problem, this)
        made.append(_enabled_at(time, late.place, recording) if better else late)
    return tuple(late for late in made if late.samples >= FEWEST)


def _inflation(time: float, late: LateEnable, beginning: Standstill, problem: Problem, this: Fit) -> float:
    """`variance_inflation` of an explanation refitted with the power of a recording from a time [s] on."""
    on = run_powered_from(time, beginning.run)
    changed = replace(problem.whole[late.place], input=on.input, applied_input=on.applied_input)
    whole = replace(problem, runs=(*problem.whole[: late.place], changed, *problem.whole[late.place + 1 :]))
    return variance_inflation(whole, refit(this, whole, iterations=NEAR_ITS_END))


def _standing_samples(recording: Recording, model: Model) -> int:
    """Samples from the first on that stand still, of a recording with an input in them; 0 of others."""
    measured = [np.asarray(x) for name, x in recording.signals.items() if name != model.drive.input]
    samples = min(map(first_moved, measured), default=0)
    given = np.asarray(recording.signals[model.drive.input])[: max(samples - FEWEST, 0)]
    return samples if samples > FEWEST and given.any() else 0


def _worthwhile(
    found: tuple[LateEnable, ...], recordings: Sequence[Recording], model: Model
) -> tuple[LateEnable, ...]:
    """The late enables without which the recordings are decisively less likely, whatever else holds or delays a drive.

    Each is one more parameter, and with it and without the same effects may act beside the nominal model. Only the
    beginnings of the recordings are compared, in short windows from the recorded motion: physics that is missing later,
    or that bends the motion, then does not count.
    """
    weighted = nominal_of(beginnings(powered(recordings, found, model)), model)[0].in_windows()
    waits = [_waiting_time(recordings[late.place], late, model) for late in found]

    def best(kept: Sequence[LateEnable]) -> Fit:
        on = prepare(beginnings(powered(recordings, kept, model)), model).in_windows()
        return _best_held(replace(on, noise=weighted.noise, inflation=weighted.inflation), waits)

    this = best(found)
    starts = {late: replace(weighted, runs=(weighted.runs[late.place].until(2 * late.samples),)) for late in found}
    enough = {late: 2.0 * variance_inflation(start, this) * DECISIVE for late, start in starts.items()}
    while found:
        others = {late: best([other for other in found if other != late]) for late in found}
        least = min(others, key=lambda late: others[late].cost - enough[late])
        if others[least].cost - this.cost > enough[least]:
            break
        found, this = tuple(late for late in found if late != least), others[least]
    return found


def _best_held(problem: Problem, waits: Sequence[float]) -> Fit:
    """The best of the nominal model, what holds a drive by its size or at its angle, and a delay beside these.

    `waits`: delays [s] of the input to begin from.
    """
    nominal, shown = fit_nominal(problem), [e for n, e in problem.prior.table.items() if observable(n, problem)]
    by_size, by_angle = [e.name for e in shown if e.holds], [e.name for e in shown if e.turns]
    held = [nominal, *(screened[0] for names in (by_size, by_angle) if (screened := screen(problem, nominal, names)))]

    def delayed(held: Fit, effect: Effect, wait: float) -> Fit:
        (delay,) = effect.parameters
        starts = {**held.starts(held.added), effect.name: {delay.name: wait}}
        names = (*held.added, effect.name)
        return fit(problem, hypothesis(problem.prior, names, problem.scales, starts, held.motor))

    delays = [e for e in shown if e.delays and e.name not in nominal.hypothesis.effects]
    late = (delayed(this, delay, wait) for this in held for delay in delays for wait in waits)
    return min([*held, *late], key=attrgetter("cost"))


def _waiting_time(recording: Recording, late: LateEnable, model: Model) -> float:
    """From the first input to the power [s]."""
    begins = np.argmax(np.asarray(recording.signals[model.drive.input]) != 0.0)
    return float(max(late.time - since_start(recording)[begins], 0.0))


def _enabled_at(time: float, place: int, recording: Recording) -> LateEnable:
    before = int(np.searchsorted(since_start(recording)[:-1], time))
    return LateEnable(place=place, recording=recording.name, samples=before, time=time)


def _would_move(problem: Problem, this: Fit, recording: Recording, model: Model, beside: Run, samples: int) -> bool:
    """Whether a simulated fit moves by more than the noise while the recording stands still, under the recorded input.

    Where the recorded speed is not about 0 meanwhile, the drive may turn evenly or the sensor be biased: then a change
    of the input has to move the simulation both from that speed and from rest.
    """
    run = replace(run_of(recording, model).until(samples), start_unknowns=beside.start_unknowns, levels=beside.levels)
    if not run.in_motion or _stands_about_zero(run, samples):
        return _moves(problem, this, run, {s: run.signal(s) for s in run.recorded})
    # either it turns evenly under its first input, or it stands and a biased sensor shows what is not there
    even = replace(run, input=np.full(run.input.size, run.input[0]), applied_input=None)
    turning = problem.simulate(even, this.vector, this.active).signals
    still = replace(run, in_motion=False, start_unknowns=(), start=(0.0, 0.0, run.start[2]), input_before=0.0)
    standing = {s: np.full(run.time.size, still.start[2] if s == "position" else 0.0) for s in run.recorded}
    return _moves(problem, this, run, turning) and _moves(problem, this, still, standing)


def _moves(problem: Problem, this: Fit, run: Run, unmoved: Mapping[str, Array]) -> bool:
    """Whether a run of a fit leaves signals (n,) by more than their noise; not where the driving force is fitted."""
    out = problem.simulate(run, this.vector, this.active).signals
    compared = [s for s in run.recorded if s in problem.noise]
    return any(np.max(np.abs(out[s] - unmoved[s])) > CERTAIN * problem.noise[s].deviation for s in compared)


def _stands_about_zero(run: Run, samples: int) -> bool:
    """Whether the speed of the samples that stand still is 0 within their noise, whatever the first."""
    return bool((still := run.signal("speed")[:samples]).size and abs(np.mean(still)) <= CERTAIN * np.std(still))


def _beginning(problem: Problem, this: Fit, recording: Recording, model: Model, beside: Run) -> Standstill:
    run = replace(run_of(recording, model), levels=beside.levels)
    if run.in_motion or run.angle_unknown:  # else it says where it stands, and a fit may have bent that
        run = replace(run, start_unknowns=beside.start_unknowns)
    return Standstill(problem, this, recording, run, _standing_samples(recording, model))
