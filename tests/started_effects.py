"""Effects at the values that a search for them starts from, for drives of a size."""

from __future__ import annotations

from collections.abc import Mapping

from rwn.model.vocabulary import Effect


def started(effect: Effect, quantities: Mapping[str, float]) -> dict[str, float]:
    """Parameters (SI) of an effect where the drive has these `quantities`, a tenth into its range where none is stated.

    Also of what is a choice, as the speed at which a drag is stated.
    """
    return {p.name: (p.start or 0.1 * min(p.upper, 1.0)) * p.scale.of(quantities) for p in effect.parameters}
