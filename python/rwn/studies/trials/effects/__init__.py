"""The effects that the blind trials conceal. A new one is an entry in the file of its site."""

from __future__ import annotations

from rwn.studies.trials.effects import background, electrical, friction, interface, torque, unnamed
from rwn.studies.trials.effects.definition import Effect as Effect
from rwn.studies.trials.effects.definition import Situation as Situation

EFFECTS: dict[str, Effect] = {
    effect.name: effect
    for site in (friction, torque, electrical, interface, unnamed)
    for effect in site.EFFECTS
}
NAMED: tuple[str, ...] = tuple(name for name, effect in EFFECTS.items() if effect.named)
UNNAMED: tuple[str, ...] = tuple(name for name, effect in EFFECTS.items() if not effect.named)
BACKGROUND: dict[str, Effect] = {effect.name: effect for site in (unnamed, background) for effect in site.EFFECTS}


def known_as(kind: str) -> set[str]:
    """The names of the vocabulary that are right for physics which the trials conceal without one."""
    effect = BACKGROUND.get(kind)
    return {kind, effect.known_as} if effect is not None and effect.known_as else {kind}
