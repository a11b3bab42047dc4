"""Channels out of step, and gears that physics might explain as well: what undoing a fault leaves, refitted.

Such a fault is suspected where undoing it removes a good part of what the refitted model leaves. It is accepted if
the recordings without it are explained by fewer effects, and better, than as they are.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from rwn.faults.fault import SHIFT, ErrorReduction, Fault, without
from rwn.faults.scale import gears
from rwn.fit.fit import Fit, fit_nominal, refit
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.residual_noise import with_noise_of
from rwn.fit.residuals import variance
from rwn.fit.screening_part import screening_part
from rwn.measurement.known_filters import noise_before_filters
from rwn.model.model import Model
from rwn.model.recordings import LONGEST_SHIFT
from rwn.name.ranking import Ranking
from rwn.name.screening import FURTHER
from rwn.parallel import side_by_side
from rwn.recording.noise import Noise
from rwn.recording.recording import Recording, beginnings
from rwn.recording.signals import MOTION

Array = NDArray[np.float64]

LITTLE = 0.1  # squared error above the noise, in units of it, below which nothing is suspected
SUSPECT = 0.3  # share of what the refitted model leaves, that undoing a fault has to remove to be suspected
DELAY_REMOVES = 0.85  # share of what the refitted model leaves, that a fault with what is beneath it has to remove
SLIGHT = 0.02  # squared error in units of the noise, by which a fault has to be better than a pair of effects
BETTER = 0.75  # share of what physics alone leaves, that may be left with the fault undone
FIRST = 4  # explanations that may be one half of a pair
NEAR = (-3, -2, -1, 1, 2, 3)  # samples by which a delay may be off, seen through missing physics


@dataclass(frozen=True, kw_only=True)
class SuspectedFault:
    """The fault that removes most of what the refitted model leaves."""

    fault: Fault
    noise: Mapping[str, Noise]
    before: float  # squared error above the noise, in units of it, of the refitted model
    after: float  # squared error above the noise with the fault undone

    @property
    def little(self) -> float:
        """The most that one effect may leave to do in place of the fault: no more than undoing the fault leaves."""
        return min(LITTLE, self.after + SLIGHT)


def suspected(recordings: Sequence[Recording], model: Model) -> SuspectedFault | None:
    """A shift or a gear that explains a good part of what the refitted model leaves; physics may yet do better."""
    recordings = beginnings(recordings)
    problem = prepare(recordings, model)
    weighted = with_noise_of(problem, fit_nominal(problem))
    nominal = fit_nominal(weighted)
    noise = with_noise_of(weighted, nominal).noise
    before = _excess_error(problem, _refitted(problem, noise), noise)
    if before < LITTLE:
        return None
    best = None
    for fault in chain(gears(recordings, model), _shifts(recordings, problem, nominal)):
        undone = prepare(without(recordings, fault), model)
        own = fault.noise_without(noise)
        after = _excess_error(undone, _refitted(undone, own), own)
        if after < (best.after if best else (1.0 - SUSPECT) * before):
            best = SuspectedFault(fault=fault, noise=noise, before=before, after=after)
    return best


def unexplained(suspect: SuspectedFault, found: Ranking) -> float:
    """Mean squared error above the noise, in units of it, that physics leaves of the recordings, shifted or not."""
    return _excess_error(found.problem, found.closest, suspect.noise)


def removing(fault: Fault, suspect: SuspectedFault, *, left: float, physics: float) -> Fault:
    """The fault with what it removes: `left` above the noise with it undone, `physics` without."""
    shares = (1.0 - left / max(total, left, 1e-300) for total in (suspect.before, physics))
    return replace(fault, removes=ErrorReduction(*shares)) if fault.name == SHIFT else fault


def rivals(*rankings: Ranking) -> list[str]:
    """Effects of which a pair might explain what the fault explains together with one effect.

    They are those of actuators and sensors, which delay and scale signals, and the first effects of each ranking.
    """
    table = rankings[0].problem.prior.table
    ends = [name for name, effect in table.items() if effect.at_an_end]
    return list(dict.fromkeys([*ends, *first_effects(*rankings)]))


def first_effects(*rankings: Ranking) -> list[str]:
    """The effects of the best explanations of each ranking, and the single effects that cost least, however ranked."""
    first = [r.fit for of in rankings for r in of.fits[:FIRST]]
    least = [f for of in rankings for f in sorted(of.alone.fits, key=lambda f: f.cost)[:FIRST]]
    return list(dict.fromkeys(name for f in (*first, *least) for name in f.added))


def accepted(suspect: SuspectedFault, *, left: float, physics: float, little: float = LITTLE) -> bool:
    """Whether undoing the fault explains the recordings better than physics alone does.

    All are squared errors above the noise: `left` is what remains with the fault undone, with or without effects that
    were found then; `physics` is what the best explanation leaves without undoing it; up to `little` of that counts as
    nothing.
    """
    return left < BETTER * physics and left < (1.0 - DELAY_REMOVES) * suspect.before and physics > little


def refined(
    suspect: SuspectedFault, recordings: Sequence[Recording], model: Model, beneath: Ranking
) -> tuple[Fault, float]:
    """The fault with the delay at which what was found beneath it fits best, and what that leaves."""
    noise, base = suspect.fault.noise_without(suspect.noise), beneath.closest

    def undone(fault: Fault) -> Problem:
        return replace(prepare(without(recordings, fault), model), noise=noise)

    def variance_after_a_few_steps(fault: Fault) -> float:
        on = screening_part(undone(fault), base)
        return variance(on, refit(base, on, iterations=FURTHER))

    left = _excess_error(beneath.problem, base, noise)
    near = [suspect.fault.delay + off for off in NEAR] if suspect.fault.delay else []
    tried = [_shift(suspect.fault.signals, delay, suspect.fault.step) for delay in near if delay < 0]
    if not tried:
        return suspect.fault, left
    as_suspected, *soon = side_by_side(variance_after_a_few_steps, [suspect.fault, *tried])
    if min(soon) >= as_suspected:
        return suspect.fault, left
    best = tried[int(np.argmin(soon))]
    on = undone(best)
    finer = variance(on, refit(base, on)) - 1.0
    return (best, finer) if finer < left else (suspect.fault, left)


def _refitted(problem: Problem, noise: Mapping[str, Noise]) -> Fit:
    return fit_nominal(replace(problem, noise=dict(noise)))


def _excess_error(problem: Problem, this: Fit, noise: Mapping[str, Noise]) -> float:
    """Mean squared error above the noise of the recordings, in units of it."""
    return variance(replace(problem, noise=noise_before_filters(problem, noise)), this) - 1.0


# ---- delays that are worth a refit -----------------------------------------------------------------------------------


def _shifts(recordings: Sequence[Recording], problem: Problem, nominal: Fit) -> Iterator[Fault]:
    """One channel early against its simulation while another is in step; a late one is an effect of its sensor."""
    if not problem.drive.winding:
        return
    signals = [s for s in problem.runs[0].recorded if all(s in r.recorded for r in problem.runs)]
    lags = {s: _lag(problem, nominal, s) for s in signals if s != "position"}
    step = float(np.median(np.diff(recordings[0].time)))
    groups = {"speed": tuple(s for s in MOTION if any(s in r.signals for r in recordings)), "current": ("current",)}
    for signal, lag in lags.items():
        for delay in sorted({lag - 1, lag, lag + 1, *(lag - other for other in lags.values())}):
            if -LONGEST_SHIFT <= delay < 0:
                yield _shift(groups[signal], delay, step)


def _shift(signals: tuple[str, ...], delay: int, step: float) -> Fault:
    rows = f"{abs(delay)} sample{'s' if abs(delay) > 1 else ''} ({1e3 * abs(delay) * step:.3g} ms)"
    text = f"{' and '.join(signals)} {rows} early against the other channels"
    return Fault(name=SHIFT, signals=signals, delay=delay, step=step, meaning=text)


def _lag(problem: Problem, this: Fit, signal: str) -> int:
    """Samples by which a recorded signal follows its simulation, from the correlation of their changes."""
    shifts = np.arange(-LONGEST_SHIFT, LONGEST_SHIFT + 1)
    score = np.zeros(shifts.size)
    for run in problem.runs:
        simulated = np.diff(problem.simulate(run, this.vector, this.active).signals[signal])
        recorded = np.diff(run.signal(signal))
        inner = slice(LONGEST_SHIFT, simulated.size - LONGEST_SHIFT)
        for k, shift in enumerate(shifts):
            score[k] += float(np.roll(recorded, -shift)[inner] @ simulated[inner])
    return int(shifts[np.argmax(score)])
