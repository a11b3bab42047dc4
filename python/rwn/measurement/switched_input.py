"""An input of stairs where no row shows it: between two rows of different values it switched once, or moved on a line.

At which of the ticks between them the motion that followed tells: of the few ways that each gap may have gone, those
that leave least of the errors are found one after the other, the others as they are thought to be, until none changes
(iterated conditional modes, Besag 1986).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.recording.intersample import PiecewiseInput

if TYPE_CHECKING:
    from scipy.sparse import csc_array, csr_array

Array = NDArray[np.float64]
Places = NDArray[np.intp]

SWEEPS = 10  # over all gaps; most need three


def is_of_stairs(given: PiecewiseInput) -> bool:
    """Whether most changes from one row to the next come alone: before and after them the input rests."""
    changes = np.diff(given.values[given.spread == 0.0]) != 0.0
    rests = np.concatenate([[True], ~changes, [True]])
    alone = changes & rests[:-2] & rests[2:]
    return 2 * int(np.count_nonzero(alone)) > int(np.count_nonzero(changes))


def switched(given: PiecewiseInput, responses: Mapping[str, csr_array], errors: Mapping[str, Array]) -> PiecewiseInput:
    """`given` with its unknown values as a switch in each gap between known ones leaves least of the errors.

    Args:
        given: an input of stairs.
        responses: of each signal (n, m), in units of its noise, to 1 more at each of the m unknown values.
        errors: of each signal (n,), in these units, under `given`.
    """
    from scipy.sparse import vstack  # late: the command line starts without it

    unknown = np.flatnonzero(given.spread > 0.0)
    response = vstack(list(responses.values())).tocsc()
    flat, moved = _gaps(given, unknown)
    levelled = replace(given, values=_at_their_level(given, flat))
    left = np.concatenate(list(errors.values())) - response @ (levelled.values - given.values)[unknown]
    given = levelled
    gaps = [_gap(given, ticks, response, int(np.searchsorted(unknown, ticks[0]))) for ticks in moved]
    chosen = np.full(len(gaps), -1)
    for _ in range(SWEEPS):
        before = chosen.copy()
        for k, gap in enumerate(gaps):
            here = left[gap.rows]
            if chosen[k] >= 0:
                here = here + gap.adds[:, chosen[k]]
            chosen[k] = int(np.argmin(gap.size - 2.0 * (here @ gap.adds)))
            left[gap.rows] = here - gap.adds[:, chosen[k]]
        if np.array_equal(chosen, before):
            break
    values = given.values.copy()
    for gap, way in zip(gaps, chosen, strict=True):
        values[gap.ticks] = gap.ways[way]
    return replace(given, values=values, log_ways=float(sum(np.log(len(gap.ways)) for gap in gaps)))


class _Gap(NamedTuple):
    """Ticks (u,) that no row shows, the ways (k, u) their values may go, and what each adds to some rows, (r, k)."""

    ticks: Places
    ways: Array
    rows: Places
    adds: Array
    size: Array  # (k,) sums of squares of what they add


def _gap(given: PiecewiseInput, ticks: Places, response: csc_array, column: int) -> _Gap:
    """That of `ticks` between values that differ, the first of which is `column` of the unknown ones."""
    beside = _beside(given, ticks)
    before, after = given.values[beside]
    late = np.arange(ticks.size)[None, :] < np.arange(ticks.size + 1)[:, None]  # before the switch
    ways = np.where(late, before, after)
    if given.ramps:
        ways = np.vstack([ways, np.interp(given.instants[ticks], given.instants[beside], [before, after])])
    ends = response.indptr[column : column + ticks.size + 1]
    rows, at = np.unique(response.indices[ends[0] : ends[-1]], return_inverse=True)
    block = np.zeros((rows.size, ticks.size))
    block[at, np.repeat(np.arange(ticks.size), np.diff(ends))] = response.data[ends[0] : ends[-1]]
    adds = block @ (ways - given.values[ticks]).T
    return _Gap(ticks, ways, rows, adds, np.sum(adds**2, axis=0))


def _gaps(given: PiecewiseInput, unknown: Places) -> tuple[list[Places], list[Places]]:
    """Unknown ticks (m,) of each gap between known ones: of those beside which the values are one, and of the rest."""
    gaps = np.split(unknown, np.flatnonzero(np.diff(unknown) > 1) + 1)
    flat, moved = list[Places](), list[Places]()
    for ticks in gaps:
        before, after = given.values[_beside(given, ticks)]
        (flat if before == after else moved).append(ticks)
    return flat, moved


def _at_their_level(given: PiecewiseInput, gaps: list[Places]) -> Array:
    """The values with gaps (m,) as the known values before them."""
    values = given.values.copy()
    for ticks in gaps:
        values[ticks] = values[_beside(given, ticks)[0]]
    return values


def _beside(given: PiecewiseInput, ticks: Places) -> list[int]:
    """The known ticks before and after those of a gap; its own at an end of the recording."""
    return [max(int(ticks[0]) - 1, 0), min(int(ticks[-1]) + 1, given.values.size - 1)]
