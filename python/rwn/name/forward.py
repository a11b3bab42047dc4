"""Fits the nominal model, every effect alone, and what still helps beside the best: hypotheses with probabilities."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rwn.fit import residuals as evidence
from rwn.fit.angle import retracked
from rwn.fit.budget import affords_more, one_stage
from rwn.fit.coarse_speed import as_shown, steps_shown, unrounded_fits
from rwn.fit.coloured_noise import final_fits
from rwn.fit.fit import Fitted
from rwn.fit.polish import polished
from rwn.fit.preparation import Setup, noise_levels, windowed
from rwn.fit.prior_weight import tempered
from rwn.fit.problem import OutputError
from rwn.fit.residuals import Hypothesis, Statistics
from rwn.name.backward import distinct, replaced, with_simpler
from rwn.name.observable import applicable
from rwn.name.screening import Search, foremost

Progress = Callable[[str, float], None]

MOST_EFFECTS = 3  # at once
WORTH = 0.2  # share of what is left that another effect has to remove
FAR_OFF = 100.0  # squared error in units of the noise, from which short windows are tried too,
LOST = 0.2  # where the error of some signal is more than this share of its own spread
PATIENCE = 4  # in short windows, where the misfit is large and the first steps of a fit are short
DRIFT = 1.0  # most that the error of a drifting position may weigh against that of the other signals
WHOLE = 0.99  # share of the time from which a window is none
OFFSET = "constant-load"
BRIEF = 10  # samples that a load acts for at least


class Settled(NamedTuple):
    """The nominal model and explanations under the noise that the best of them makes probable."""

    search: Search
    nominal: Fitted
    fits: list[Fitted]


class Layer(NamedTuple):
    """Explanations with one effect more than the last ones."""

    fits: list[Fitted]
    tried: frozenset[tuple[tuple[str, ...], str]]  # what was added to what


NOTHING = Layer([], frozenset())


@dataclass(frozen=True, kw_only=True)
class Explanation:
    """What the search came to: every hypothesis with its probability, best first."""

    setup: Setup
    nominal: Fitted
    hypotheses: tuple[Hypothesis, ...]
    left: Statistics  # residual of the best
    before: Statistics  # residual of the refitted nominal
    weighted: OutputError  # the problem of the final fits: that of `setup`, or the same under coloured noise
    counted: Statistics  # what is left there: `left`, or what is new in each error
    alone: Settled  # every effect by itself
    pairs: Layer  # under the noise of `alone`
    speed_steps: tuple[float, ...] = ()  # of each recording, rad/s, where a coarse converter rounds the speed
    strained: tuple[Fitted, ...] = ()  # what fits better, with a law that ran into a limit of its parameters
    cut_short: bool = False  # more effects at once would have been tried, but for what that costs
    complete: bool = True  # no other effects and no more at once would have been tried, had they been allowed

    @property
    def nothing_missing(self) -> Hypothesis:
        """The refitted nominal model among the hypotheses."""
        return next(h for h in self.hypotheses if not h.fitted.added)

    @property
    def closest(self) -> Fitted:
        """What fits best, however many effects it takes."""
        return min((h.fitted for h in self.hypotheses), key=lambda f: f.cost)


def explain(
    setup: Setup, *, progress: Progress, names: Sequence[str] | None = None, at_once: int = MOST_EFFECTS,
    after: Explanation | None = None,
) -> Explanation:  # fmt: skip
    """Fits the nominal model, every single effect, and what still helps beside the best ones, `at_once` at most.

    `names`: of the effects that are tried; such an explanation is for comparison, simpler ones than its best are not.
    `after`: an explanation of the same recordings by fewer effects, or by some of them, to go on from.
    """
    wanted = [n for n in names or setup.nominal.table if applicable(n, setup)]
    alone = after.alone if after else _each_alone(setup, wanted, progress)
    search, nominal, fits = alone.search, alone.nominal, [f for f in alone.fits if _made_of(f, wanted)]
    before = evidence.statistics(search.problem, nominal)
    _, left = _best_of(search, [nominal, *fits])
    layer = _varied(fits)
    complete, paired, cut_short = left.at_the_floor or not layer, False, False
    pairs = after.pairs if after else NOTHING
    for size in range(2, at_once + 1):
        if complete:
            break
        known = pairs if size == 2 else NOTHING
        cut_short = not affords_more(search.problem.work)
        if cut_short and not known.fits:
            break
        progress(f"trying {size} effects at once", 0.1 + 0.25 * size)
        found = _beside(search, layer, wanted, fits, known)
        more, pairs = found.fits, found if size == 2 else pairs
        gained = left.variance - min(f.cost for f in more) / left.count if more else 0.0
        complete = gained < WORTH * left.variance
        if complete:
            break
        fits, paired = [*fits, *more], True
        best, left = _best_of(search, fits)
        layer = sorted(more, key=lambda f: f.cost)[:2]
        complete = left.at_the_floor or _at_its_floor(search, best)
    if paired:
        search, nominal, fits = _settled(search, nominal, fits, setup)
    fits = with_simpler(search, nominal, fits) if names is None else fits
    strained = [f for f in fits if f.limits_met]
    fits = [f for f in fits if not (f.limits_met or f.idle or _no_window(f, setup))]
    best, left = _best_of(search, [nominal, *fits])
    weighted, finals, counted = final_fits(search, [nominal, *fits], left)
    hypotheses = evidence.weigh([nominal, *fits], counted, rivals=len(wanted), prior=_prior(setup), finals=finals)
    # disturbances are no account of what the nominal model lacks: it is shown as plainly fitted
    hypotheses = [h if h.fitted.added else replace(h, final=nominal) for h in hypotheses]
    return Explanation(
        setup=replace(setup, problem=search.problem, whole=replace(setup.whole, noise=search.problem.noise)),
        nominal=nominal,
        hypotheses=tuple(hypotheses),
        left=left,
        before=before,
        weighted=weighted,
        counted=counted,
        alone=alone,
        pairs=pairs,
        speed_steps=steps_shown(search.problem, setup.problem, best),
        complete=names is None and (complete or at_once >= MOST_EFFECTS),
        cut_short=cut_short and not left.at_the_floor,
        strained=tuple(f for f in strained if f.cost < best.cost),
    )


def _best_of(search: Search, fits: Sequence[Fitted]) -> tuple[Fitted, Statistics]:
    """The explanation that fits best, and what it leaves."""
    best = min(fits, key=lambda f: f.cost)
    return best, evidence.statistics(search.problem, best)


def _begun(setup: Setup) -> tuple[Search, Fitted]:
    """The search, weighted by the noise that the refitted nominal model leaves, and that model."""
    search = Search.of(setup)
    search = with_noise(search, search.fit_nominal())
    nominal = search.fit_nominal()
    within, _ = tempered(search, nominal)
    return (search, nominal) if within is search else (within, within.fit_nominal())


def _each_alone(setup: Setup, wanted: Sequence[str], progress: Progress) -> Settled:
    """The nominal model and every single effect."""
    search, nominal = _begun(setup)
    progress("trying every effect", 0.1)
    fits = search.explain(nominal, wanted)
    if setup.problem.kind == "axis":  # the rule on a machine axis: gravity, or an offset of the drive
        offset = next(f for f in search.explain(nominal, [OFFSET]))
        fits = distinct([*fits, *search.explain(offset, wanted)])
    if affords_more(search.problem.work) and _far_off(search, min([nominal, *fits], key=lambda f: f.cost)):
        fits = distinct([*fits, *_by_windows(search, nominal, wanted)])
    return _settled(search, nominal, fits, setup)


def _made_of(fitted: Fitted, wanted: Sequence[str]) -> bool:
    return all(name in wanted or name == OFFSET for name in fitted.added)


def _settled(search: Search, nominal: Fitted, fits: list[Fitted], setup: Setup) -> Settled:
    """The fits under the noise, along the angle and to the speed that the best of them makes probable."""
    search = replace(search, problem=as_shown(search.problem, setup.problem))
    tracked = retracked(*_reweighted(search, nominal, fits))
    return Settled(*unrounded_fits(*polished(*tracked), setup.problem))


def _at_its_floor(search: Search, best: Fitted) -> bool:
    """Whether the best explanation leaves but noise under the noise and the weight of priors that go with itself.

    Those of the search go with what was best before it: under them a right pair is held off its minimum.
    """
    own, best = tempered(with_noise(search, best), best)
    again = own.refit(best, own.problem, share=one_stage(own.problem.work))
    return evidence.statistics(own.problem, again).at_the_floor


def _far_off(search: Search, best: Fitted) -> bool:
    """Whether free run has lost the motion, so that its error no longer says where the fit should go."""
    problem = search.problem
    turning = all(t.angle.size and not t.restart_every for t in problem.targets)
    if not turning or problem.kind == "lti":
        return False
    errors = evidence.join(problem, problem.residuals(best.vector, best.candidate.active))
    if evidence.statistics_of(errors).variance <= FAR_OFF:
        return False
    signals = evidence.join(problem, [{s: t.signal(s) for s in t.recorded} for t in problem.targets])
    return any(np.sqrt(np.nanmean(errors[s] ** 2)) > LOST * np.nanstd(signals[s]) for s in errors)


def _by_windows(search: Search, nominal: Fitted, wanted: Sequence[str]) -> list[Fitted]:
    """Every effect fitted in short windows, each from the recorded motion, and from there in free run."""
    targets = tuple(map(windowed, search.look(nominal).targets))
    windows = replace(search, problem=replace(search.problem, targets=targets), patience=PATIENCE)
    windows = with_noise(windows, windows.refit(nominal, windows.problem))
    fits = windows.explain(windows.refit(nominal, windows.problem), wanted)
    return search.refit_all(fits)


def _beside(
    search: Search, layer: Sequence[Fitted], wanted: Sequence[str], fits: Sequence[Fitted], known: Layer
) -> Layer:
    """What helps beside each explanation of `layer`: any effect beside the best, promising ones beside the others.

    Once the best found leaves noise alone, one that has no part in it is tried beside its parts: it may rival one.
    """
    found, tried, names = [f for f in known.fits if _made_of(f, wanted)], known.tried, list(wanted)
    for place, base in enumerate(layer):
        if (place or known.fits) and not affords_more(search.problem.work):
            break
        parts = _all_there_is(search, found)
        beside = [n for n in names if n in parts] if parts and not parts & set(base.added) else names
        new = [name for name in beside if (base.added, name) not in tried]
        found += search.explain(base, new, keep=1, best=min((f.cost for f in found), default=np.inf))
        tried |= {(base.added, name) for name in new}
        met = {name for f in (*fits, *found) for name in f.added}
        names = [name for name in wanted if name in met]
    return Layer(distinct(found), tried)


def _all_there_is(search: Search, found: Sequence[Fitted]) -> frozenset[str]:
    """The effects of the best that was found if it leaves but noise; none otherwise."""
    best = min(found, key=lambda f: f.cost, default=None)
    done = best and evidence.statistics(search.problem, best).at_the_floor
    return frozenset(best.added) if best and done else frozenset()


def _varied(fits: Sequence[Fitted]) -> list[Fitted]:
    """The three best explanations, at most two of them with a law in place of the same nominal parameters."""
    kept: list[Fitted] = []
    for f in fits:
        alike = [k for k in kept if replaced(k) and replaced(k) == replaced(f)]
        if len(alike) < 2:
            kept.append(f)
    return kept[:3]


def _prior(setup: Setup) -> dict[str, float]:
    """Log prior odds that differ from uniform: a steady load is rare on a bench motor, common on a machine axis."""
    return {OFFSET: np.log(len(setup.nominal.table)) + 1.0 if setup.problem.kind == "axis" else -5.0}


def with_noise(search: Search, fitted: Fitted) -> Search:
    """`search` weighted by the noise that `fitted` leaves."""
    problem = search.problem
    residuals = problem.residuals(fitted.vector, fitted.candidate.active)
    levels = noise_levels(problem.targets, residuals)
    errors = evidence.join(replace(problem, noise=levels), residuals)
    variances = {s: float(np.nanmean(r**2)) for s, r in errors.items()}
    others = [v for s, v in variances.items() if s != "position"]
    if "position" in variances and others:
        excess = variances["position"] / (DRIFT * max(*others, 1.0))
        levels["position"] *= np.sqrt(max(excess, 1.0))
    return replace(search, problem=replace(problem, noise=levels))


def _reweighted(search: Search, nominal: Fitted, fits: list[Fitted]) -> tuple[Search, Fitted, list[Fitted]]:
    """The same fits under the noise levels that the best one leaves, where they differ."""
    best = min([nominal, *fits], key=lambda f: f.cost)
    other, free = tempered(with_noise(search, best), best)
    change = max(abs(np.log(v / search.problem.noise[s])) for s, v in other.problem.noise.items())
    change = max(change, abs(np.log(other.problem.colour / search.problem.colour)) / 30.0)
    if change < 0.03:
        return search, nominal, fits
    # each by the cost that it raced with: the others may gain as much once priors weigh less
    begun = replace(best, minimum=replace(best.minimum, values=free.minimum.values))
    first, *rest = other.refit_all([begun if f is best else f for f in (nominal, *foremost(fits))])
    return other, first, sorted(rest, key=lambda f: f.cost)


def _no_window(fitted: Fitted, setup: Setup) -> bool:
    """Whether a load is said to act from end to end of the recordings, which has a name of its own, or for a moment.

    A stray sample is no load.
    """
    brief = BRIEF / max(t.time.size for t in setup.problem.targets)
    return any(not brief < end - begin < WHOLE for begin, end in fitted.windows)
