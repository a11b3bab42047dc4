"""A first guess: starting values (SI) of some or all parameters of an effect."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.model.vocabulary import Effect

Guess = Mapping[str, float]
Read = Callable[[Problem, Fit, Effect, int], list[Guess] | None]  # (problem, base, effect, how many)
"""What the residual of a fit shows of an effect beside it: some parameters each; None: nothing, so all is scanned."""
