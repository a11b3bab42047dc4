"""Witnesses against the effects of an explanation: the halves of the drive by themselves."""

from __future__ import annotations

from collections.abc import Callable

from rwn.decide.half import Half
from rwn.decide.shaft_alone import shaft_of
from rwn.decide.winding_alone import winding_of
from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.model.model import Model

WITNESSES: tuple[Callable[[Fit, Problem, Model], Half | None], ...] = (shaft_of, winding_of)


def contradicted(this: Fit, problem: Problem, model: Model) -> dict[str, str]:
    """The effects of an explanation that a half of the drive contradicts by itself, each with the name of that half."""
    found: dict[str, str] = {}
    for witness in WITNESSES if this.added else ():
        half = witness(this, problem, model)
        for name in half.judged if half is not None else ():
            if half is not None and half.contradicts(name, this.values_of(name)):
                found[name] = half.name
    return found
