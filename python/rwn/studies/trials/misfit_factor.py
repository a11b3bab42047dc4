"""How far what a fit does not explain moves its parameters, from trials whose answers are known."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rwn.decide.calibration import calibration
from rwn.errors import InputError
from rwn.fit.intervals import HALF_WIDTH, Estimate, Widening, least_deviation
from rwn.model.vocabulary import Effect, Parameter, table
from rwn.report.diagnosis import Diagnosis
from rwn.studies.trials.diagnosed import diagnosed
from rwn.studies.trials.grade import nearest_turn
from rwn.studies.trials.said import TIMING, timing_of

Array = NDArray[np.float64]

FARTHEST = 100.0  # no factor is looked for beyond it


@dataclass(frozen=True, kw_only=True)
class ParameterErrors:
    """Of the parameters of rightly named effects, relative to their values (or of their logarithms)."""

    off: Array  # (n,) from the truth
    noise: Array  # (n,) deviation by noise of the size and correlation of what is left
    least: Array  # (n,) deviation that no noise shows, see `least_deviation`
    misfits: Array  # (n,) share of what is left that is no noise
    trials: NDArray[np.int64]  # (n,) the parameters of one trial err together: every trial counts alike

    def deviations(self, factor: float) -> Array:
        """Deviations (n,) where misfit moves a parameter `factor` times as far as noise of its size."""
        widened: Array = self.noise * np.hypot(1.0, factor * np.sqrt(self.misfits))
        return np.hypot(widened, self.least)

    @cached_property
    def with_misfit(self) -> ParameterErrors:
        """Those beside which something is left: the others say nothing of the factor, whatever they miss by."""
        return self._where(self.misfits > 0.0)

    @property
    def counted(self) -> str:
        """How many tell the factor, in words."""
        return f"{self.with_misfit.off.size} parameters of {np.unique(self.with_misfit.trials).size} trials"

    def likeliest(self) -> float:
        """The factor under which the errors are likeliest, as normal ones; 0 where none tells.

        Raises InputError where no factor is.
        """
        from scipy.optimize import minimize_scalar  # late: the command line starts without it

        telling = self.with_misfit
        if not telling.off.size:
            return 0.0
        if not np.all(telling.deviations(0.0) > 0.0):
            raise InputError(
                "an interval has no width", expected="values known to some deviation", fix="diagnose the set anew"
            )
        weights = 1.0 / np.bincount(telling.trials)[telling.trials]

        def deviance(factor: float) -> float:
            deviations = telling.deviations(factor)
            return float(weights @ ((telling.off / deviations) ** 2 + 2.0 * np.log(deviations)))

        found = float(minimize_scalar(deviance, bounds=(0.0, FARTHEST), method="bounded").x)
        if deviance(FARTHEST) <= deviance(found):
            raise InputError(
                f"no misfit factor below {FARTHEST:g} explains how far values miss the truth",
                expected="values that miss it by some deviations",
                fix="look at the trials whose values are farthest off",
            )
        return found if deviance(found) < deviance(0.0) else 0.0

    def without_one(self) -> tuple[float, float]:
        """The least and the largest factor where any one trial is left out."""
        each = [self._where(self.trials != trial).likeliest() for trial in np.unique(self.with_misfit.trials)]
        return min(each, default=0.0), max(each, default=0.0)

    def covered(self, factor: float) -> int:
        """How many 95 % intervals hold the truth with a factor."""
        return int(np.sum(self.off <= HALF_WIDTH * self.deviations(factor)))

    def words(self, factor: float) -> str:
        """The factor for people."""
        least, most = self.without_one()
        beside_noise = self._where(self.misfits == 0.0)
        return (
            f"misfit factor: what is not explained moves a parameter {factor:.2f} times as far as noise of its size\n"
            f"({least:.2f} to {most:.2f} where any one trial is left out), by {self.counted}; with it cover "
            f"{self.with_misfit.covered(factor)} of {self.with_misfit.off.size} of their intervals,\n"
            f"and {beside_noise.covered(factor)} of {beside_noise.off.size} where noise alone is left"
        )

    def _where(self, chosen: NDArray[np.bool_]) -> ParameterErrors:
        return replace(self, **{f.name: getattr(self, f.name)[chosen] for f in fields(self)})


def errors_of(
    folders: Sequence[Path], *, results: Path | None = None, check: Collection[str] = ()
) -> ParameterErrors:  # fmt: skip
    """The errors of every right name of all trials that have a diagnosis. `check`: names of sets that do not count.

    Raises InputError where timing.json does not say by which factor the intervals were made.
    """
    rows = list[tuple[float, float, float, float]]()
    trials = list[int]()
    for count, (answer, diagnosis, place) in enumerate(diagnosed(folders, results, check)):
        known, left = list(_known(answer, diagnosis)), diagnosis.remainder
        widened = Widening(misfit_factor=_factor_in(place)).factor(left) if known else 1.0
        for law, p, estimate, true in known:
            least = least_deviation(law, p, estimate.value) / abs(estimate.value)
            off, deviation = _error(estimate, true, least=least, logarithmic=p.logarithmic)
            rows.append((off, deviation / widened, least, left.misfit))
            trials.append(count)
    columns = np.array(rows).reshape(-1, 4).T
    return ParameterErrors(
        off=columns[0], noise=columns[1], least=columns[2], misfits=columns[3], trials=np.array(trials, dtype=np.int64)
    )


def _known(
    answer: Mapping[str, Any], diagnosis: Diagnosis
) -> Iterator[tuple[Effect, Parameter, Estimate, float]]:  # fmt: skip
    """The parameters of right names that have an interval: of which effect, what was said, and the truth."""
    true = {e["name"]: e.get("parameters", {}) for e in answer["effects"]}
    for effect in (e for e in diagnosis.effects if e.name in true):
        law = table()[effect.name]
        for p in law.every:
            estimate, answered = effect.parameters.get(p.name), true[effect.name].get(p.name, {}).get("value")
            if estimate and estimate.interval and estimate.value and answered:
                yield law, p, estimate, nearest_turn(p.name, float(answered), estimate.value)


def _factor_in(place: Path) -> float:
    """The misfit factor that the intervals of a diagnosis count with.

    Raises InputError where timing.json does not say it.
    """
    timing = timing_of(place)
    if timing.misfit_factor is None:
        raise InputError(
            "nothing says which misfit factor these intervals count with",
            where=place / TIMING,
            expected=f'a "misfit_factor" as `rwn trials run` writes it ({calibration().misfit_factor:.3g} today)',
            fix="diagnose the set anew, or leave it out of the misfit factor by --check",
        )
    return timing.misfit_factor


def _error(estimate: Estimate, true: float, *, least: float, logarithmic: bool) -> tuple[float, float]:
    """How far a value is off, and its deviation by noise and misfit, relative to it or of its logarithm.

    `least`: what no deviation is below, beside these. An end may be cut at a bound, so the farther one counts.
    """
    low, high = np.array(estimate.interval or (np.nan, np.nan)) / estimate.value
    ratio = true / estimate.value
    if logarithmic:
        low, high, ratio = 1.0 + np.log(low), 1.0 + np.log(high), 1.0 + np.log(ratio)
    deviation = max(abs(high - 1.0), abs(1.0 - low)) / HALF_WIDTH
    return abs(float(ratio) - 1.0), float(np.sqrt(max(deviation**2 - least**2, 0.0)))
