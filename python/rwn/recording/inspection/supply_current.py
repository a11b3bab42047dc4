"""A current that is not the winding's: one of a supply, or a rectified one, rises whichever way the voltage steps.

That of a winding follows a step of its voltage in both directions, whatever load it holds.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.recording.inspection.finding import Finding
from rwn.recording.recording import Recording

LEVEL = 0.001  # chance that a current turns with its voltage by chance
BESIDE_ZERO = 0.1  # of the largest voltage, below which its direction, and a step of it, is not clear
ANSWERED = 2  # rows: a row shows what was before its own input acted


def without_supply_current(recording: Recording) -> tuple[Recording, list[Finding]]:
    """The recording without such a current, and what was found."""
    if not {"voltage", "current"} <= set(recording.signals) or not _is_of_supply(recording):
        return recording, []
    found = Finding(
        kind="supply-current", recording=recording.name, signals=("current",), count=len(recording),
        words="the current rises with the size of the voltage in either direction: it is that of a supply, or "
        "rectified, and not the winding's",
        done="left out; measure it in a lead of the motor",
    )  # fmt: skip
    return replace(recording, signals={s: v for s, v in recording.signals.items() if s != "current"}), [found]


def _is_of_supply(recording: Recording) -> bool:
    voltage, current = (np.asarray(recording.signals[name]) for name in ("voltage", "current"))
    known = ~recording.missing.get("current", np.zeros(len(recording), dtype=bool))
    step = np.diff(voltage)[: 1 - ANSWERED]
    answer = current[ANSWERED:] - current[:-ANSWERED]
    least = BESIDE_ZERO * float(np.max(np.abs(voltage)))
    usable = (np.abs(step) > least) & known[ANSWERED:] & known[:-ANSWERED]
    after, goes_with = voltage[1 : 1 - ANSWERED], answer * step > 0.0
    forward, backward = goes_with[usable & (after > least)], ~goes_with[usable & (after < -least)]
    return min(_share(forward), _share(backward)) > 0.5 and _chance(np.append(forward, backward)) < LEVEL


def _share(said: NDArray[np.bool_]) -> float:
    return float(np.mean(said)) if said.size else 0.0


def _chance(said: NDArray[np.bool_]) -> float:
    """That as many of these (n,) are so by chance (sign test)."""
    from scipy.stats import binom  # late: the command line starts without it

    return float(binom.sf(np.count_nonzero(said) - 1, said.size, 0.5))
