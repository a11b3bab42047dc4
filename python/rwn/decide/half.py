"""A half of a drive by itself: what an explanation has of it, and how near it comes to what was recorded."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.fit.residuals import CERTAINLY, loss_gained

Array = NDArray[np.float64]

PARTS = 16  # of the work of a stage, for each fit
NONE: Mapping[str, Mapping[str, float]] = MappingProxyType({})


@dataclass(frozen=True, kw_only=True)
class Half:
    """The shaft without its winding, or the winding without its shaft; what joins them was recorded."""

    name: str
    judged: tuple[str, ...]  # effects of the explanation that act in it
    explained: Array  # squared errors of the whole explanation, of every sample of what the half is judged by
    # the same of the half alone, with all of the explanation fitted but an effect, beside effects with known values
    squares_of: Callable[[str, Mapping[str, Mapping[str, float]]], Array]

    def squares(self, *, without: str = "", known: Mapping[str, Mapping[str, float]] = NONE) -> Array:
        """Squared error of every sample (n,) of the half alone, with what the explanation has of it fitted.

        `without` an effect, and with the `known` values of others.
        """
        return self.squares_of(without, known)

    def contradicts(self, name: str, values: Mapping[str, float]) -> bool:
        """Whether the half alone is as near to what was recorded without an effect as the whole explanation with it.

        And with its values, as they were found, surely farther.
        """
        without = self.squares(without=name)
        if not float(np.mean(without)) <= float(np.mean(self.explained)):
            return False
        return loss_gained(without, self.squares(without=name, known={name: values})) > CERTAINLY


def squares(problem: Problem, this: Fit, signal: str) -> Array:
    """Squared error (n,) of every sample of a signal, in SI; 0 where it is not compared."""
    return np.concatenate([np.square(left[signal]) for left in problem.residuals(this.vector, this.active)])
