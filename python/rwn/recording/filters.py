"""First-order filters that a drive or logger runs its samples through: signals as they were, and as it shows them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.recording.clock import clock_of
from rwn.recording.recording import Recording

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def unfiltered(recording: Recording, filters: Mapping[str, float], *, ticks_per_row: int = 1) -> Recording:
    """A recording whose signals went through filters of these time constants [s], as they were before.

    A sample that follows a missing one is missing too: what the filter held then is not known.
    """
    passed = {name: tau for name, tau in filters.items() if name in recording.signals}
    if not passed:
        return recording
    signals, missing = dict(recording.signals), dict(recording.missing)
    for name, tau in passed.items():
        shown = np.asarray(recording.signals[name])
        signals[name], lost = before_filter(
            recording.time, shown, tau, ticks_per_row=ticks_per_row, missing=missing.get(name)
        )
        if name in missing:
            missing[name] = lost
    return replace(recording, signals=signals, missing=missing)


def before_filter(
    time: Array, shown: Array, time_constant: float, *, ticks_per_row: int = 1, missing: Flags | None = None
) -> tuple[Array, Flags]:
    """The samples (n,) at `time` (n,) [s] that a filter made `shown` (n,) of, and which of them are not known.

    The filter is y += (1 - exp(-T / tau)) (x - y), at each tick of the clock it runs by; `missing`: flags (n,).
    """
    from scipy.linalg import solve_banded  # late: the command line starts without it

    lost = np.zeros(time.size, dtype=bool) if missing is None else missing | np.append(False, missing[:-1])
    kept, before = _shares(time, time_constant, ticks_per_row)
    taken_in = np.concatenate([shown[:1], (shown[1:] - kept * shown[:-1]) / (1.0 - kept)])
    before = np.where(lost[:-1], 0.0, before)  # beside one that is not known a sample counts as its own alone
    if not before.any():
        return taken_in, lost
    samples: Array = solve_banded((1, 0), [np.append(1.0, 1.0 - before), np.append(before, 0.0)], taken_in)
    return samples, lost


def as_filtered(time: Array, values: Array, time_constant: float, *, ticks_per_row: int = 1) -> Array:
    """What the filter shows of samples (n,) at `time` (n,) [s]; it begins at the first of them."""
    shown = np.array(values)
    for k, (kept, before) in enumerate(zip(*_shares(time, time_constant, ticks_per_row), strict=True), start=1):
        taken_in = values[k] + before * (values[k - 1] - values[k])
        shown[k] = kept * shown[k - 1] + (1.0 - kept) * taken_in
    return shown


def share_before(share: float, ticks: int) -> float:
    """Of what a filter takes in from one row to the next, the share that the sample of the row before stands for.

    `share`: of what it shows that is still in its next row, `ticks` of its clock later. The samples at the ticks in
    between lie on the line between those of the rows.
    """
    pole = share ** (1.0 / ticks)
    weights = pole ** np.arange(ticks)
    return float(weights @ np.arange(ticks) / (ticks * np.sum(weights)))


def _shares(time: Array, time_constant: float, ticks_per_row: int) -> tuple[Array, Array]:
    """Share of what the filter shows that is still in its next row, and `share_before` of that row, (n - 1,) each.

    A program filters sample by sample, however late each is taken: what counts is the ticks of its clock.
    """
    if time.size < 2:
        return np.zeros(0), np.zeros(0)
    clock = clock_of(time)
    ticks = np.diff(clock.ticks)
    kept = np.exp(-clock.period * ticks / time_constant)
    different, which = np.unique(ticks, return_inverse=True)
    of = [np.exp(-clock.period * t / time_constant) for t in different]
    before = np.array([share_before(float(k), int(t) * ticks_per_row) for k, t in zip(of, different, strict=True)])
    return np.asarray(kept), before[which]
