"""Effects that a model declares: values such as a drive of this size can have."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rwn.errors import InputError
from rwn.model.model import Model
from rwn.model.vocabulary import Effect, Parameter
from rwn.simulate.scales import LEAST

# Factor by which a value may lie beyond a bound of the table: bounds are measured by what recordings show, and another
# run of the same drive may be ten times slower or weaker, while a slip of a unit is a factor of 1000.
SLACK = 100.0
SHARP = 1e6  # factor beyond a bound for what idealises a law (`idealised`), which may be as sharp as one likes


def check_declared(
    model: Model, known: Sequence[Mapping[str, float]], *, told: str = "as the recordings show it"
) -> None:
    """Raises InputError where a parameter lies far beyond bounds that are relative to the size of the drive.

    `known`: the scales (`rwn.simulate.scales`) by which that is measured; within the bounds of one is enough. `told`:
    what measured it. Not judged: phases, what a user's own effect searches, 0: it is off, and what is measured by a
    quantity that is not shown, as the current of an axis.
    """
    for effect, p, value, units in _judged(model, known):
        if not units:
            continue
        lower, upper, slack = _bounds(p, units, model)
        if not lower <= value <= upper:
            times = f"{slack:g} times {p.lower:g} to {p.upper:g} x " if slack > 1.0 else "a part of the "
            raise InputError(
                f"{p.name} is {value:g} {p.unit}",
                where=f"{model.source or 'model'}, [effects.{effect.name}]",
                expected=f"{lower:.2g} to {upper:.2g} {p.unit}: {times}{p.scale.words} of the drive, {told}",
                fix=f"correct the value or its unit, or the unit of the recordings; see rwn effects {effect.name}",
            )


def surely_passes(model: Model, known: Sequence[Mapping[str, float]]) -> bool:
    """Whether `check_declared` passes by these scales and by whatever further ones: those widen the bounds."""
    for _, p, value, units in _judged(model, known):
        if not units:
            return False
        lower, upper, _ = _bounds(p, units, model)
        if not lower <= value <= upper:
            return False
    return True


def _judged(
    model: Model, known: Sequence[Mapping[str, float]]
) -> Iterator[tuple[Effect, Parameter, float, list[float]]]:
    """The values that are judged, each with what `known` measures it by: nothing where none shows its quantity."""
    for name, values in model.effects.items():
        effect = model.effect_table[name]
        for p in effect.parameters:
            value = values.get(p.name, 0.0)
            if effect.own or p.cyclic or p.natural or not p.scale.powers or not value:
                continue
            yield effect, p, value, [p.scale.of(s) for s in known if all(s[q] > LEAST for q in p.scale.powers)]


def _bounds(p: Parameter, units: Sequence[float], model: Model) -> tuple[float, float, float]:
    """The lowest and the highest value that passes, and by how much they lie beyond the bounds of the table."""
    slack = SHARP if p.idealised else SLACK
    if p.scale.powers == {"inertia": 1}:  # a part of a whole that the model states, which no recording makes larger
        return (-max(units) if p.lower < 0.0 else 0.0), max(units), 1.0
    lower = min(p.lower * unit for unit in units) * (slack if p.lower < 0.0 else 1.0 / slack)
    replaced = model.motor.get(p.replaces, 0.0) if p.replaces else 0.0
    return lower, slack * max(replaced, *(p.upper * unit for unit in units)), slack
