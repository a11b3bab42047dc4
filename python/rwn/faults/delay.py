"""Channels out of step, and gears that physics might explain as well: what undoing a mistake leaves, refitted.

Such a mistake is suspected where undoing it removes a good part of what the refitted model leaves. It is believed if
the recordings without it are explained by fewer effects, and better, than as they are.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from rwn.faults.fault import MOTION, SHIFT, Mistake, without
from rwn.faults.scale import gears
from rwn.fit import residuals as evidence
from rwn.fit.fit import Fitted
from rwn.fit.preparation import Setup, prepare
from rwn.fit.problem import OutputError
from rwn.model.model import Model
from rwn.name.forward import Explanation, with_noise
from rwn.name.screening import IN_PASSING, Search
from rwn.parallel import side_by_side
from rwn.recording.recording import Recording

Array = NDArray[np.float64]

LITTLE = 0.1  # squared error above the noise, in units of it, below which nothing is suspected
SUSPECT = 0.3  # share of what the refitted model leaves, that undoing a mistake has to remove to be suspected
REMOVED = 0.85  # the same to be believed, with what is found beneath it
CLEAR = 0.01  # share that is left where a mistake and one effect explain all: more pairs of effects need not be tried
SLIGHT = 0.02  # squared error in units of the noise, by which a mistake has to be better than such a pair
BETTER = 0.75  # share of what physics alone leaves, that may be left with the mistake undone
FIRST = 4  # explanations that may be one half of a pair
LONGEST_SHIFT = 40  # samples
NEAR = (-3, -2, -1, 1, 2, 3)  # samples by which a delay may be off, seen through missing physics


@dataclass(frozen=True, kw_only=True)
class Suspicion:
    """The mistake that removes most of what the refitted model leaves."""

    mistake: Mistake
    noise: Mapping[str, float]
    before: float  # squared error above the noise, in units of it, of the refitted model
    after: float  # the same with the mistake undone

    @property
    def little(self) -> float:
        """What a single effect may leave if it is to do in place of the mistake: no more than that by itself leaves."""
        return min(LITTLE, self.after + SLIGHT)


def suspected(recordings: Sequence[Recording], model: Model) -> Suspicion | None:
    """A shift or a gear that explains a good part of what the refitted model leaves; physics may yet do better."""
    setup = prepare(recordings, model)
    search = Search.of(setup)
    search = with_noise(search, search.fit_nominal())
    fitted = search.fit_nominal()
    noise = with_noise(search, fitted).problem.noise
    before = _left(setup, _refitted(setup, noise), noise)
    if before < LITTLE:
        return None
    best = None
    for mistake in chain(gears(recordings, model), _shifts(recordings, setup, fitted)):
        undone = prepare(without(recordings, mistake), model)
        own = mistake.levels(noise)
        after = _left(undone, _refitted(undone, own), own)
        if after < (best.after if best else (1.0 - SUSPECT) * before):
            best = Suspicion(mistake=mistake, noise=noise, before=before, after=after)
    return best


def unexplained(doubt: Suspicion, found: Explanation) -> float:
    """Mean squared error above the noise, in units of it, that physics leaves of the recordings, shifted or not."""
    return _left(found.setup, found.closest, doubt.noise)


def rivals(*explanations: Explanation) -> list[str]:
    """Effects of which two might do what the mistake does with one beneath it.

    They are those of the drive's ends, which delay and scale, and the first ones with the mistake and without.
    """
    table = explanations[0].setup.nominal.table
    ends = [name for name, effect in table.items() if effect.at_an_end]
    return list(dict.fromkeys([*ends, *first_effects(*explanations)]))


def first_effects(*explanations: Explanation) -> list[str]:
    """The effects of the first hypotheses of each, and those that by themselves leave least, strained or not."""
    first = [h.fitted for of in explanations for h in of.hypotheses[:FIRST]]
    least = [f for of in explanations for f in sorted(of.alone.fits, key=lambda f: f.cost)[:FIRST]]
    return list(dict.fromkeys(name for f in (*first, *least) for name in f.added))


def believed(doubt: Suspicion, *, left: float, physics: float, little: float = LITTLE) -> bool:
    """Whether the mistake, which leaves `left` by itself or with what is beneath it, explains more than physics.

    `little`: what physics may leave so that nothing is left to explain.
    """
    return left < BETTER * physics and left < (1.0 - REMOVED) * doubt.before and physics > little


def sharpened(
    doubt: Suspicion, recordings: Sequence[Recording], model: Model, beneath: Explanation
) -> tuple[Mistake, float]:
    """The mistake with the delay at which what was found beneath it fits best, and what that leaves."""
    noise, base = doubt.mistake.levels(doubt.noise), beneath.closest

    def undone(mistake: Mistake) -> Search:
        setup = prepare(without(recordings, mistake), model)
        return Search.of(setup, problem=replace(setup.problem, noise=noise))

    def in_passing(mistake: Mistake) -> float:
        search = undone(mistake)
        look = search.look(base)
        return evidence.variance(look, search.refit(base, look, iterations=IN_PASSING))

    left = _left(beneath.setup, base, noise)
    near = [doubt.mistake.delay + off for off in NEAR] if doubt.mistake.delay else []
    tried = [_shift(doubt.mistake.signals, delay, doubt.mistake.step) for delay in near if delay]
    if not tried:
        return doubt.mistake, left
    as_doubted, *soon = side_by_side(in_passing, [doubt.mistake, *tried])
    if min(soon) >= as_doubted:
        return doubt.mistake, left
    best = tried[int(np.argmin(soon))]
    search = undone(best)
    sharper = evidence.variance(search.problem, search.refit(base, search.problem)) - 1.0
    return (best, sharper) if sharper < left else (doubt.mistake, left)


def _refitted(setup: Setup, noise: Mapping[str, float]) -> Fitted:
    return Search.of(setup, problem=replace(setup.problem, noise=dict(noise))).fit_nominal()


def _left(setup: Setup, fitted: Fitted, noise: Mapping[str, float]) -> float:
    """Mean squared error above the noise, in units of it."""
    return evidence.variance(replace(setup.problem, noise=dict(noise)), fitted) - 1.0


# ---- delays that are worth a refit -----------------------------------------------------------------------------------


def _shifts(recordings: Sequence[Recording], setup: Setup, fitted: Fitted) -> Iterator[Mistake]:
    """One channel late or early against its simulation while another is in step."""
    if setup.problem.kind != "dc":
        return
    problem, active = setup.problem, fitted.candidate.active
    lags = {s: _lag(problem, fitted.vector, active, s) for s in problem.targets[0].recorded if s != "position"}
    step = float(np.median(np.diff(recordings[0].time)))
    groups = {"speed": tuple(s for s in MOTION if s in recordings[0].signals), "current": ("current",)}
    alone = "current" not in lags  # late against the input alone: as well a delay of the drive, which is physics
    for signal, lag in lags.items():
        for delay in sorted({lag - 1, lag, lag + 1, *(lag - other for other in lags.values())}):
            if delay != 0 and abs(delay) <= LONGEST_SHIFT and not (alone and delay > 0):
                yield _shift(groups[signal], delay, step)


def _shift(signals: tuple[str, ...], delay: int, step: float) -> Mistake:
    late = "late" if delay > 0 else "early"
    text = f"{' and '.join(signals)} {abs(delay)} samples {late} against the other channels"
    return Mistake(name=SHIFT, signals=signals, delay=delay, step=step, meaning=text)


def _lag(problem: OutputError, vector: Array, active: Sequence[int], signal: str) -> int:
    """Samples by which a recorded signal follows its simulation, from the correlation of their changes."""
    shifts = np.arange(-LONGEST_SHIFT, LONGEST_SHIFT + 1)
    score = np.zeros(shifts.size)
    for target in problem.targets:
        simulated = np.diff(problem.simulate(target, vector, active).signals[signal])
        recorded = np.diff(target.signal(signal))
        inner = slice(LONGEST_SHIFT, simulated.size - LONGEST_SHIFT)
        for k, shift in enumerate(shifts):
            score[k] += float(np.roll(recorded, -shift)[inner] @ simulated[inner])
    return int(shifts[np.argmax(score)])
