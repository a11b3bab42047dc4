"""What naming comes to: every explanation that was tried, with its probability."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.fit.residuals import Statistics
from rwn.name.measurement import Measurement
from rwn.name.not_tried import NotTried
from rwn.name.weights import RankedFit


class Fits(NamedTuple):
    """The nominal model and explanations, fitted to one problem: under the same noise."""

    problem: Problem
    nominal_fit: Fit
    fits: list[Fit]
    windowed: Sequence[Fit] = ()  # as fitted in short windows, where a free run has lost the motion


class Extensions(NamedTuple):
    """Explanations with one effect more than those that they were built on, and by fewer that windows showed."""

    fits: list[Fit]
    tried: frozenset[tuple[tuple[str, ...], str]]  # what was added to what
    not_tried: tuple[NotTried, ...] = ()


NO_EXTENSIONS = Extensions([], frozenset())


@dataclass(frozen=True, kw_only=True)
class Ranking:
    """Every explanation with its probability, best first."""

    problem: Problem  # with the noise of the best
    measurement: Measurement  # under which the recordings were explained
    nominal_fit: Fit
    fits: tuple[RankedFit, ...]
    left: Statistics  # residual of the best
    before: Statistics  # residual of the refitted nominal
    weighted: Problem  # that of the final fits: `problem`, or the same under coloured noise
    counted: Statistics  # what is left there: `left`, or what is new in each error
    alone: Fits  # every effect by itself
    extensions: Extensions  # under the noise of `alone`
    speed_steps: tuple[float, ...] = ()  # of each recording, rad/s, where a coarse converter rounds the speed
    at_a_limit: tuple[Fit, ...] = ()  # what fits better, with a law that ran into a limit of its parameters
    not_tried: tuple[NotTried, ...] = ()
    complete: bool = True  # no other effects and no more at once would have been tried, had they been allowed

    @property
    def nothing_missing(self) -> RankedFit:
        """The refitted nominal model among the explanations."""
        return next(r for r in self.fits if not r.added)

    @property
    def closest(self) -> Fit:
        """What fits best, however many effects it takes."""
        return min((r.fit for r in self.fits), key=lambda f: f.cost)
