"""Where the fits of an effect begin: at what its table scans, and at what the residual tells of it."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product

from rwn.fit.fit import Fit
from rwn.fit.hypothesis import first_unit
from rwn.fit.problem import Problem
from rwn.model.vocabulary import Effect
from rwn.name.initial_guesses import resonance, spectra, time_windows
from rwn.name.initial_guesses.guess import Guess, Read

# what the residual tells, by the `Guess` of an effect (cpp/include/rwn/model/effect.hpp)
READ: Mapping[str, Read] = {
    "spectrum": spectra.read,
    "window": time_windows.read,
    "resonance": resonance.read,
}


def initial_guesses(problem: Problem, base: Fit, effect: Effect, *, count: int) -> list[Guess]:
    """Starting values (SI) of one effect beside `base`; `count`: most that are read off the residual.

    What the residual tells is combined with what the table scans of the other parameters.
    """
    known = READ[effect.guess](problem, base, effect, count) if effect.guess in READ else None
    read_off = {name for guess in known or () for name in guess}
    motor = {**problem.prior.motor, **base.motor}
    axes = [
        [{p.name: s * first_unit(effect, p, motor, problem.scales)} for s in p.scan]
        for p in effect.parameters
        if p.scan and p.name not in read_off
    ]
    axes += [] if known is None else [[dict(guess) for guess in known]]
    return [{k: v for part in combination for k, v in part.items()} for combination in product(*axes)]
