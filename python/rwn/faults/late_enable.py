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

from rwn.faults.standstill import FEWEST, first_moved
from rwn.fit.fit import Fit, fit, fit_nominal, refit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.likelihood import DECISIVE
from rwn.fit.nominal import nominal_of
from rwn.fit.preparation import prepare
from rwn.fit.prior_weight import worth
from rwn.fit.problem import Problem
from rwn.model.initial_state import CERTAIN
from rwn.model.model import Model
from rwn.model.vocabulary import Effect
from rwn.name.observable import observable
from rwn.name.screening import screen
from rwn.recording.inspection import Finding
from rwn.recording.recording import Recording, beginnings
from rwn.simulate.run import Run, run_of

Array = NDArray[np.float64]

TRIED = 64  # instants of enabling that are compared at a time
ITERATIONS = 8  # of a fit that begins near its end
INSTANT_TOLERANCE = 0.01  # accuracy of the instant of enabling, in times between rows


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
    without = [_powered_from(_since_start(r)[k], r, model) for r, k in zip(recordings, still, strict=True)]
    problem, nominal = nominal_of(without, model)
    found = _enabled_late(recordings, model, problem, nominal, problem.runs)
    return _worthwhile(found, recordings, model) if found else ()


def late_beside(recordings: Sequence[Recording], model: Model, problem: Problem, this: Fit) -> tuple[LateEnable, ...]:
    """What stood still, of recordings that were not fitted, where an explanation `this` of others would have moved.

    A friction that is a little more on that day holds a drive too: with a late enable the recording is far likelier
    also where the explanation is fitted to it alone.
    """
    if model.drive.coefficients:
        return ()
    runs, enough = [run_of(r, model) for r in recordings], 2.0 * worth(problem, this) * DECISIVE
    found = _enabled_late(recordings, model, problem, this, runs)
    each = {late: _beginning(problem, this, recordings[late.place], model, runs[late.place]) for late in found}
    return tuple(late for late, of in each.items() if of.cost(0.0) - of.cost(late.time) > enough)


def _enabled_late(
    recordings: Sequence[Recording], model: Model, problem: Problem, this: Fit, runs: Sequence[Run]
) -> tuple[LateEnable, ...]:
    found = []
    for k, (recording, run) in enumerate(zip(recordings, runs, strict=True)):
        samples = _standing_samples(recording, model)
        if samples and _would_move(problem, this, recording, model, run, samples):
            time = _beginning(problem, this, recording, model, run).enabling_time()
            late = _enabled_at(time, k, recording)
            if late.samples >= FEWEST:
                found.append(late)
    return tuple(found)


def powered(recordings: Sequence[Recording], found: Sequence[LateEnable], model: Model) -> list[Recording]:
    """The recordings with no input where they had no power."""
    times = {late.place: late.time for late in found}
    return [_powered_from(times.get(k, 0.0), r, model) for k, r in enumerate(recordings)]


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
    """Each at the time that an explanation asks for, where the recordings are far likelier with that.

    What was missing when it was found, such as a delay, moves it. `problem`: of `powered` recordings.
    """
    enough, made = 2.0 * worth(problem, this) * DECISIVE, []
    for late in found:
        recording = recordings[late.place]
        beginning = _beginning(problem, this, recording, model, problem.whole[late.place])
        time = beginning.enabling_time()
        better = beginning.error(late.time) - beginning.error(time) > enough
        made.append(_enabled_at(time, late.place, recording) if better else late)
    return tuple(late for late in made if late.samples >= FEWEST)


def _standing_samples(recording: Recording, model: Model) -> int:
    """Samples from the first on that stand still, of a recording with an input in them; 0 of others."""
    measured = [np.asarray(x) for name, x in recording.signals.items() if name != model.drive.input]
    samples = min(map(first_moved, measured), default=0)
    given = np.asarray(recording.signals[model.drive.input])[: max(samples - FEWEST, 0)]
    return samples if samples > FEWEST and given.any() else 0


def _worthwhile(
    found: tuple[LateEnable, ...], recordings: Sequence[Recording], model: Model
) -> tuple[LateEnable, ...]:
    """The late enables with each of which the recordings are far likelier than by what else holds a drive or delays it.

    Each is a number of its own. With it and without, the same effects may act beside the nominal model; errors count as
    what the best leaves is worth while the drives stand still and begin to move: what is missing later says nothing of
    that.
    """
    weighted, _ = nominal_of(beginnings(powered(recordings, found, model)), model)
    waits = [_waiting_time(recordings[late.place], late, model) for late in found]

    def best(kept: Sequence[LateEnable]) -> Fit:
        on = prepare(beginnings(powered(recordings, kept, model)), model)
        return _best_held(replace(on, noise=weighted.noise, colour=weighted.colour), waits)

    this = best(found)
    starts = {late: replace(weighted, runs=(weighted.runs[late.place].until(2 * late.samples),)) for late in found}
    enough = {late: 2.0 * worth(start, this) * DECISIVE for late, start in starts.items()}
    while found:
        others = {late: best([other for other in found if other != late]) for late in found}
        least = min(others, key=lambda late: others[late].cost - enough[late])
        if others[least].cost - this.cost > enough[least]:
            break
        found, this = tuple(late for late in found if late != least), others[least]
    return found


def _best_held(problem: Problem, waits: Sequence[float]) -> Fit:
    """The best of the nominal model, what holds a drive, and a delay of the input beside either.

    `waits`: delays [s] to begin from.
    """
    nominal, shown = fit_nominal(problem), [e for n, e in problem.prior.table.items() if observable(n, problem)]
    held = min([nominal, *screen(problem, nominal, [e.name for e in shown if e.holds])], key=attrgetter("cost"))
    if any(problem.prior.table[name].delays for name in held.hypothesis.effects):
        return held

    def delayed(effect: Effect, wait: float) -> Fit:
        (delay,) = effect.parameters
        starts = {**held.starts(held.added), effect.name: {delay.name: wait}}
        names = (*held.added, effect.name)
        return fit(problem, hypothesis(problem.prior, names, problem.scales, starts, held.motor))

    return min([held, *(delayed(e, wait) for e in shown if e.delays for wait in waits)], key=attrgetter("cost"))


def _waiting_time(recording: Recording, late: LateEnable, model: Model) -> float:
    """From the first input to the power [s]."""
    begins = np.argmax(np.asarray(recording.signals[model.drive.input]) != 0.0)
    return float(max(late.time - _since_start(recording)[begins], 0.0))


def _since_start(recording: Recording) -> Array:
    """Time [s] of each sample after the first, (n + 1,): the last is the end of the last one's step."""
    time = recording.time - recording.time[0]
    return np.append(time, 2.0 * time[-1] - time[-2])


def _enabled_at(time: float, place: int, recording: Recording) -> LateEnable:
    before = int(np.searchsorted(_since_start(recording)[:-1], time))
    return LateEnable(place=place, recording=recording.name, samples=before, time=time)


def _powered_from(time: float, recording: Recording, model: Model) -> Recording:
    """The recording with no input before a time [s]; in the step in which it comes the input acts for a part."""
    if time == 0.0:
        return recording
    given = _acting(_since_start(recording), time) * np.asarray(recording.signals[model.drive.input])
    return replace(recording, signals={**recording.signals, model.drive.input: given})


def _run_powered_from(time: float, run: Run) -> Run:
    """The same of a recording as it is simulated."""
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


def _would_move(problem: Problem, this: Fit, recording: Recording, model: Model, beside: Run, samples: int) -> bool:
    """Whether a fit leaves the noise of the samples that stand still, under the input as it was recorded.

    Where these are not about 0, whether a change of the input moves it, and would from rest.
    """
    run = replace(run_of(recording, model).until(samples), own=beside.own, levels=beside.levels)
    if not run.in_motion or _stands_about_zero(run, samples):
        return _moves(problem, this, run, {s: run.signal(s) for s in run.recorded})
    even = replace(run, input=np.full(run.input.size, run.input[0]), applied_input=None)  # it turns evenly,
    turning = problem.simulate(even, this.vector, this.active).signals
    still = replace(run, in_motion=False, own=(), start=(0.0, 0.0, run.start[2]), input_before=0.0)  # or has a bias
    standing = {s: np.full(run.time.size, still.start[2] if s == "position" else 0.0) for s in run.recorded}
    return _moves(problem, this, run, turning) and _moves(problem, this, still, standing)


def _moves(problem: Problem, this: Fit, run: Run, unmoved: Mapping[str, Array]) -> bool:
    """Whether a run of a fit leaves signals (n,) by more than their noise; not where the driving force is fitted."""
    out = problem.simulate(run, this.vector, this.active).signals
    compared = [s for s in run.recorded if s in problem.noise]
    return any(np.max(np.abs(out[s] - unmoved[s])) > CERTAIN * problem.noise[s].deviation for s in compared)


def _stands_about_zero(run: Run, samples: int) -> bool:
    """Whether the speed of the samples that stand still is 0 within their noise, be the first of them as it may."""
    still = run.signal("speed")[:samples]
    return bool(still.size and abs(np.mean(still)) <= CERTAIN * np.std(still))


def _beginning(problem: Problem, this: Fit, recording: Recording, model: Model, beside: Run) -> _Beginning:
    run = replace(run_of(recording, model), own=beside.own, levels=beside.levels)
    return _Beginning(problem, this, recording, run, _standing_samples(recording, model))


@dataclass(frozen=True)
class _Beginning:
    """A recording until twice the time that it stood still, and a fit that would move under its input."""

    problem: Problem
    this: Fit
    recording: Recording
    run: Run  # the same as it is simulated, with power from the first sample on
    samples: int  # that stand still

    def error(self, time: float) -> float:
        """Weighted squared error of the fit with power from a time [s] on."""
        return self._with_power_from(time).error(self.this.vector, self.this.active)

    def cost(self, time: float) -> float:
        """The same, fitted to this alone, with priors."""
        return refit(self.this, self._with_power_from(time), iterations=ITERATIONS).cost

    def _with_power_from(self, time: float) -> Problem:
        return replace(self.problem, runs=(_run_powered_from(time, self.run).until(2 * self.samples),))

    def enabling_time(self) -> float:
        """When power came [s]: where the fit errs least."""
        from scipy.optimize import minimize_scalar  # late: the command line starts without it

        times, low, high = _since_start(self.recording), 0, self.samples
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
