"""What tells an effect that acts from a mimic: what it removes, also unseen, and whether a free curve removes more.

A mimic absorbs what has another cause: it removes little beside the other effects, or on the samples that it was fitted
to alone, and a curve over the right state, in its place, leaves less than it does. The features are those that
cross-validation of the calibration kept (docs/method-details.md).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rwn.decide.innovations import Innovations, innovations
from rwn.decide.other_law import curve_instead
from rwn.fit.budget import one_stage
from rwn.fit.fit import NEAR_ITS_END, Fit, refit
from rwn.fit.intervals import deviations
from rwn.fit.problem import Problem
from rwn.fit.refitting import fitted_without
from rwn.fit.residuals import statistics, variances
from rwn.model.model import Model
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit, weighed_beside
from rwn.parallel import side_by_side
from rwn.simulate.run import Run
from rwn.simulate.simulator import RAN_AWAY

Array = NDArray[np.float64]

PARTS = 16  # of the work of a stage, for each of these fits


@dataclass(frozen=True, kw_only=True)
class Evidence:
    """Features of one effect of an explanation."""

    share: float  # of what the nominal model leaves above the noise, that goes without the effect; mean of signals
    unseen: float  # that share on the halves that were not fitted, and on recordings kept back
    part: float  # of what the other effects leave above the noise, that goes with it; mean of signals but the position
    odds: float  # log evidence for its explanation against the best without it and its rivals, by all recordings; no
    # more than the log evidence that the innovations of the errors give against the same explanation without it
    curve: float  # squared error with the best curve over one state in its place, in units of that with it; at most 1


@dataclass(frozen=True, kw_only=True)
class _Fold:
    """One half of what was recorded, and the explanation fitted to it alone."""

    problem: Problem
    fit: Fit


class CrossValidation:
    """An explanation fitted to all that was recorded and to each half of it, which evidence for its effects goes by."""

    def __init__(self, ranking: Ranking, leading: RankedFit, heldout: Sequence[Run], model: Model) -> None:
        """`heldout`: recordings that were kept back."""
        self._ranking, self._leading, self._model = ranking, leading, model
        problem = ranking.weighted
        self._after = variances(problem, leading.final)
        self._nothing = variances(problem, ranking.nothing_missing.final)
        # deviation of a mean square
        self._chance = float(np.sqrt(2.0 / max(statistics(problem, leading.final).effective, 2.0)))
        self._halves = _halves(problem)
        self._seen = side_by_side(lambda half: _Fold(problem=half, fit=_refit(leading.final, half)), self._halves)
        self._heldout = [problem.on(heldout)] if heldout else []
        self._innovations = _innovations(problem, leading.final)

    def evidence(self, name: str, rivals: Collection[str], *, instead: RankedFit | None = None) -> Evidence:
        """Features of one effect of the explanation.

        Args:
            name: of the effect.
            rivals: names that may act in its place.
            instead: the one explanation that it is compared with. None: the same without the effect, and for the odds
                the best with neither it nor its rivals.
        """
        ranking, this = self._ranking, self._leading.final
        less = _without(ranking, self._leading, name) if instead is None else instead.final
        before = variances(ranking.weighted, less)
        others = self._halves[::-1]
        pairs = [(o, _refit(less, h), s.fit) for o, h, s in zip(others, self._halves, self._seen, strict=True)]
        pairs += [(judge, less, this) for judge in self._heldout]
        unseen = [_share(variances(on, a), variances(on, b), self._nothing, self._chance) for on, a, b in pairs]
        beside = _without_drift(before)
        return Evidence(
            share=_share(before, self._after, self._nothing, self._chance),
            unseen=float(np.mean(unseen)),
            part=_share(beside, self._after, beside, self._chance),
            odds=min(
                self._odds(instead or self._best_without({name, *rivals}, less)),
                self._innovations.log_odds(_innovations(ranking.weighted, less), ranking.counted.count),
            ),
            curve=curve_instead(ranking.problem, self._leading.fit, less, self._model),
        )

    def _best_without(self, names: set[str], less: Fit) -> RankedFit:
        """The best explanation without effects; the leading one without the first of them need not be ranked."""
        weighed = weighed_beside(less, self._leading, self._ranking.counted)
        ranked = (r for r in self._ranking.fits if not names & set(r.added))
        return max((weighed, *ranked), key=lambda r: r.score)

    def _odds(self, other: RankedFit) -> float:
        """Against another explanation: by what was fitted, and by what was kept back."""
        found = self._leading.score - other.score
        return found + sum(_predicted(judge, self._leading.final, other.final) for judge in self._heldout)

    @property
    def birge(self) -> float:
        """How much farther than their deviations the halves' parameters lie apart, at least 1."""
        return _birge(self._seen)


def _share(
    before: Mapping[str, float], after: Mapping[str, float], whole: Mapping[str, float], chance: float
) -> float:
    """Squared error that goes from `before` to `after`, of what `whole` has above the noise; mean of signals.

    Signals in which nothing is off say nothing, unless that is all of them. A position that drifts in free run is one
    signal among others, however far it drifts.
    """
    off = [s for s in whole if whole[s] > 1.0 + 2.0 * chance and s in before] or [s for s in whole if s in before]
    shares = [
        (before[s] - after[s]) / max(whole[s] - 1.0, before[s] - 1.0, chance) if np.isfinite(after[s]) else -1.0
        for s in off
    ]
    return float(np.mean([np.clip(x, -1.0, 1.0) if np.isfinite(x) else 1.0 for x in shares]))


def _predicted(judge: Problem, this: Fit, without: Fit) -> float:
    """Log evidence for a fit against another, of recordings that neither saw.

    Of normal errors whose variance is unknown, mean of signals, in as many samples as the better one's errors are
    worth.
    """
    after, before = (_without_drift(variances(judge, f)) for f in (this, without))
    logs = [np.log(np.clip(before[s], 1.0, RAN_AWAY) / np.clip(after[s], 1.0, RAN_AWAY)) for s in after]
    gain = float(np.mean(logs))
    return 0.5 * statistics(judge, this if gain > 0.0 else without).independent * gain if gain else 0.0


def _without_drift(variances: Mapping[str, float]) -> Mapping[str, float]:
    """Without the position where other signals tell the motion too: it adds up what the speed shows already."""
    return {s: v for s, v in variances.items() if s != "position"} or variances


def _without(ranking: Ranking, leading: RankedFit, name: str) -> Fit:
    """The explanation without one of its effects."""
    problem, known = ranking.weighted, (r.final for r in ranking.fits)
    share = one_stage(problem.work) / PARTS
    return fitted_without(problem, leading.final, name, known, iterations=NEAR_ITS_END, share=share)


def _refit(this: Fit, half: Problem) -> Fit:
    return refit(this, half, iterations=NEAR_ITS_END, share=one_stage(half.work) / PARTS)


def _innovations(problem: Problem, this: Fit) -> Innovations:
    return innovations(problem, this, share=one_stage(problem.work) / PARTS)


def _birge(halves: Sequence[_Fold]) -> float:
    """Rms difference of the unknowns from half to half in units of its standard deviation (Birge 1932), at least 1."""
    a, b = (half.fit.minimum.values for half in halves)
    of_a, of_b = (deviations(half.fit, statistics(half.problem, half.fit)) for half in halves)
    spread = np.hypot(of_a, of_b)
    physics = [not u.nuisance for u in halves[0].fit.hypothesis.unknowns]
    seen = (of_a > 0.0) & (of_b > 0.0)  # what a half does not show has no deviation there, and any value
    comparable = physics & seen & (spread < np.abs(a) + np.abs(b))
    apart = (a - b)[comparable] / spread[comparable]
    return max(float(np.sqrt(np.mean(apart**2))), 1.0) if apart.size else 1.0


def _halves(problem: Problem) -> list[Problem]:
    """Every second recording and the others; of a lone one its earlier and its later half."""
    runs = problem.runs
    if len(runs) > 1:
        return [replace(problem, runs=runs[k::2]) for k in range(2)]
    (run,) = runs
    middle = run.time.size // 2
    return [replace(problem, runs=(_compared(run, part),)) for part in (slice(0, middle), slice(middle, None))]


def _compared(run: Run, part: slice) -> Run:
    """The whole run, compared in one part alone: the motion there goes on from what was before."""
    outside = np.full(run.time.size, True)
    outside[part] = False
    missing = {s: outside | run.missing.get(s, np.zeros(outside.size, dtype=bool)) for s in run.recorded}
    return replace(run, missing=missing)
