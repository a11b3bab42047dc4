"""How far what a fit does not explain moves its parameters, from trials whose answers are known."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rwn.decide.account import Remainder
from rwn.decide.calibration import calibration
from rwn.errors import InputError
from rwn.fit.intervals import HALF_WIDTH, Estimate, Widening
from rwn.studies.trials.diagnosed import diagnosed
from rwn.studies.trials.grade import nearest_turn
from rwn.studies.trials.said import TIMING, timing_of

Array = NDArray[np.float64]

FARTHEST = 100.0  # no factor is looked for beyond it


@dataclass(frozen=True, kw_only=True)
class Errors:
    """Of the parameters of rightly named effects, in deviations that do not count what is not explained."""

    errors: Array  # (n,)
    misfits: Array  # (n,) share of the squared error of their fit that is no noise
    weights: Array  # (n,) of one trial together 1: its parameters err together

    def likeliest(self) -> float:
        """The factor f under which the errors are likeliest, as normal ones of deviation sqrt(1 + f^2 misfit).

        Those of fits that leave noise alone say nothing of it, whatever they miss by; 0 where there are no others.
        """
        from scipy.optimize import minimize_scalar  # late: the command line starts without it

        telling = self.misfits > 0.0
        squares, misfits, weights = self.errors[telling] ** 2, self.misfits[telling], self.weights[telling]
        if not squares.size:
            return 0.0

        def unlikely(factor: float) -> float:
            variances = 1.0 + factor**2 * misfits
            return float(weights @ (squares / variances + np.log(variances)))

        found = float(minimize_scalar(unlikely, bounds=(0.0, FARTHEST), method="bounded").x)
        return found if unlikely(found) < unlikely(0.0) else 0.0

    def covered(self, factor: float) -> int:
        """How many 95 % intervals hold the truth with a factor."""
        return int(np.sum(self.errors <= HALF_WIDTH * np.hypot(1.0, factor * np.sqrt(self.misfits))))

    def words(self, factor: float) -> str:
        """The factor for people."""
        telling, all_of_them = int(np.sum(self.misfits > 0.0)), self.errors.size
        return (
            f"misfit factor: what is not explained moves a parameter {factor:.2f} times as far as noise of its size,\n"
            f"by {telling} parameters beside which something is left; with it {self.covered(factor)} of {all_of_them} "
            "intervals cover"
        )


def errors_of(folders: Sequence[Path], *, results: Path | None = None, check: Collection[str] = ()) -> Errors:
    """The errors of every right name of all trials that have a diagnosis. `check`: names of sets that do not count.

    Raises InputError where timing.json does not say by which factor the intervals were made.
    """
    errors, misfits, weights = list[float](), list[float](), list[float]()
    for answer, diagnosis, place in diagnosed(folders, results, check):
        known = [
            (estimate, nearest_turn(name, float(answered["value"]), estimate.value))
            for effect in diagnosis.effects
            for true in (e.get("parameters", {}) for e in answer["effects"] if e["name"] == effect.name)
            for name, estimate in effect.parameters.items()
            if estimate.interval and estimate.value and (answered := true.get(name)) and answered["value"]
        ]
        left = diagnosis.remainder
        errors += [_error(estimate, true, left, misfit_factor=_factor_in(place)) for estimate, true in known]
        misfits += [left.misfit] * len(known)
        weights += [1.0 / max(len(known), 1)] * len(known)
    return Errors(errors=np.array(errors), misfits=np.array(misfits), weights=np.array(weights))


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


def _error(estimate: Estimate, true: float, left: Remainder, *, misfit_factor: float) -> float:
    """How many deviations off a value is.

    `misfit_factor`: what its interval counts with, which is taken out of it.
    """
    low, high = np.array(estimate.interval or (np.nan, np.nan)) / estimate.value
    ratio = true / estimate.value
    if low > 0.0 and ratio > 0.0 and abs(np.log(high * low)) < abs(high + low - 2.0):  # even about its logarithm
        low, high, ratio = 1.0 + np.log(low), 1.0 + np.log(high), 1.0 + np.log(ratio)
    half = 0.5 * abs(high - low) / Widening(misfit_factor=misfit_factor).factor(left)
    return float(HALF_WIDTH * abs(ratio - 1.0) / half)
