"""Effects that a model declares: values such as a drive of this size can have."""

from __future__ import annotations

from rwn.errors import InputError
from rwn.fit.problem import Problem
from rwn.model.model import Model

# Beyond a bound of the table. Bounds are measured by what recordings show, and another run of the same drive may be
# ten times slower or weaker; a slip of a unit is a factor of 1000.
SLACK = 100.0
SHARP = 1e6  # the same of what makes a law sharper, which may be as sharp as one likes but is a number of that drive


def check_declared(problem: Problem, model: Model) -> None:
    """Raises InputError where a parameter lies far beyond bounds that are relative to what the recordings show.

    Not judged: phases, what a user's own effect searches, and 0: it is off.
    """
    for name, values in model.effects.items():
        effect = model.effect_table[name]
        for p in effect.parameters:
            value = values.get(p.name, 0.0)
            if effect.own or p.cyclic or p.natural or not p.scale.powers or not value:
                continue
            unit = p.scale.of(problem.scales)
            slack = SHARP if p.idealised else SLACK
            lower = p.lower * unit * (slack if p.lower < 0.0 else 1.0 / slack)
            upper = slack * max(p.upper * unit, problem.prior.motor.get(p.replaces, 0.0) if p.replaces else 0.0)
            if not lower <= value <= upper:
                raise InputError(
                    f"{p.name} is {value:g} {p.unit}",
                    where=f"{model.source or 'model'}, [effects.{name}]",
                    expected=f"{lower:.2g} to {upper:.2g} {p.unit}: {slack:g} times {p.lower:g} to {p.upper:g} x "
                    f"{p.scale.words} of the drive, as the recordings show it",
                    fix=f"correct the value or its unit, or the unit of the recordings; see rwn effects {name}",
                )
