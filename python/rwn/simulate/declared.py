"""Effects that a model declares: values such as a drive of this size can have."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from rwn.errors import InputError
from rwn.model.model import Model
from rwn.model.vocabulary import Effect, Parameter
from rwn.simulate.scales import LEAST

# Factor by which a value may lie beyond a bound of the table: bounds are measured by what recordings show, and another
# run of the same drive may be ten times slower or weaker, while a slip of a unit is a factor of 1000.
SLACK = 100.0
USUAL = 10.0  # factor beyond a bound in the units of a usual recording: a motor of 24 V may be one of 2.4 or 240 V
SHARP = 1e6  # factor beyond a bound for what idealises a law (`idealised`), which may be as sharp as one likes


def check_declared(
    model: Model,
    known: Sequence[Mapping[str, float]],
    usual: Sequence[Mapping[str, float]] = (),
    *,
    told: str = "as the recordings show it",
) -> None:
    """Raises InputError where a parameter lies far beyond bounds that are relative to the size of the drive.

    `known`: the scales (`rwn.simulate.scales`) by which that is measured, `usual`: those of recordings that might have
    been instead; within the bounds of one is enough. `told`: what measured it. Not judged: phases, what a user's own
    effect searches, 0: it is off, and what is measured by a quantity that is not shown, as the current of an axis.
    """
    for effect, p, value in _judged(model):
        lower, upper = _bounds(p, known, usual, model)
        if not lower <= value <= upper:
            beyond = "a part of the " if _is_a_part(p) else f"far beyond {p.lower:g} to {p.upper:g} x "
            unit = model.drive.unit_of(effect, p.unit)
            raise InputError(
                f"{p.name} is {value:g} {unit}",
                where=f"{model.source or 'model'}, [effects.{effect.name}]",
                expected=f"{lower:.2g} to {upper:.2g} {unit}: {beyond}{p.scale.words} of the drive, {told}",
                fix=f"correct the value or its unit, or the unit of the recordings; see rwn effects {effect.name}",
            )


def surely_passes(model: Model, known: Sequence[Mapping[str, float]]) -> bool:
    """Whether `check_declared` passes by these scales and by whatever further ones: those widen the bounds."""
    for _, p, value in _judged(model):
        if not _shown(p, known):
            return False
        lower, upper = _bounds(p, known, (), model)
        if not lower <= value <= upper:
            return False
    return True


def _judged(model: Model) -> Iterator[tuple[Effect, Parameter, float]]:
    """The values that are judged."""
    for name, values in model.effects.items():
        effect = model.effect_table[name]
        for p in effect.every:
            value = values.get(p.name, 0.0)
            if not effect.own and not p.cyclic and not p.natural and p.scale.powers and value:
                yield effect, p, value


def _shown(p: Parameter, known: Sequence[Mapping[str, float]]) -> list[float]:
    """What a parameter is measured by (SI), by each of the scales that show its quantity."""
    return [p.scale.of(s) for s in known if all(s[q] > LEAST for q in p.scale.powers)]


def _is_a_part(p: Parameter) -> bool:
    """Whether it is part of a whole that the model states, which no recording makes larger."""
    return dict(p.scale.powers) == {"inertia": 1}


def _bounds(
    p: Parameter, known: Sequence[Mapping[str, float]], usual: Sequence[Mapping[str, float]], model: Model
) -> tuple[float, float]:
    """The lowest and the highest value (SI) that passes; all do where nothing shows its quantity."""
    measures = [(unit, SLACK) for unit in _shown(p, known)] + [(unit, USUAL) for unit in _shown(p, usual)]
    if not measures:
        return -math.inf, math.inf
    if _is_a_part(p):
        whole = max(unit for unit, _ in measures)
        return (-whole if p.lower < 0.0 else 0.0), whole
    if p.idealised:
        measures = [(unit, SHARP) for unit, _ in measures]
    lower = min(p.lower * unit * (slack if p.lower < 0.0 else 1.0 / slack) for unit, slack in measures)
    replaced = model.motor.get(p.replaces, 0.0) if p.replaces else 0.0
    return lower, max(slack * max(replaced, p.upper * unit) for unit, slack in measures)
