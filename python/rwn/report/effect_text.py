"""Effects as a terminal lists them: one line each, or one in detail."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence

from rwn.model.vocabulary import Effect

_MEANING = 39  # column at which the meaning begins


def lines(effects: Sequence[Effect], *, width: int | None = None) -> Iterator[str]:
    """A line for each of several effects, broken between words at `width` columns; a lone one in detail."""
    if len(effects) == 1:
        yield from _detail(effects[0])
        return
    for effect in effects:
        text = f"{effect.name:<28} {effect.site:<9} {effect.meaning}"
        if width:
            text = textwrap.fill(text, width=max(width, _MEANING + 20), subsequent_indent=" " * _MEANING)
        yield text


def _detail(effect: Effect) -> Iterator[str]:
    yield f"{effect.name}: {effect.meaning}"
    yield f"site: {effect.site}"
    yield f"equation: {effect.equation}"
    for p in effect.parameters:
        scale = f" x {p.scale.words} of the drive" if p.scale.powers else ""
        symbol = f" {p.symbol}".rstrip()
        yield f"  {p.name}{symbol} [{p.unit}]: {p.meaning}; {p.lower:g} to {p.upper:g}{scale}"
    if effect.further:
        names = ", ".join(p.name for p in effect.further if p.strength)
        yield f"  further lines, each with the parameters of its number: {names}"
    yield f"source: {effect.source}"
