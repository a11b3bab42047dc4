"""Whether one recording is a piece of another: a copy, a cut of it, or one with a column left out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED

_PROBES = 64  # rows by which most places are ruled out before whole stretches are compared


def is_piece(part: Recording, whole: Recording) -> bool:
    """Whether the samples of `part`, whatever its time starts at, are successive samples of `whole` in every signal
    that both have, and these include a measured one."""
    shared = [name for name in part.signals if name in whole.signals]
    if not 0 < len(part) <= len(whole) or not any(name in MEASURED for name in shared):
        return False
    places: NDArray[np.intp] = np.arange(len(whole) - len(part) + 1)
    for row in np.unique(np.linspace(0, len(part) - 1, _PROBES).astype(np.intp)):
        for name in shared:
            places = places[whole.signals[name][places + row] == part.signals[name][row]]
    return any(
        all(np.array_equal(whole.signals[name][k : k + len(part)], part.signals[name]) for name in shared)
        for k in places
    )
