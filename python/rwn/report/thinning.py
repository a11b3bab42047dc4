"""Fewer points for the eye: lines keep the extremes of every stretch, clouds their outermost points."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Places = NDArray[np.intp]

MOST_POINTS = 1500  # of one picture


def thin_line(lines: list[Array], *, whole: tuple[int, int] = (0, 0), most: int = MOST_POINTS) -> Places:
    """Samples (k,) to draw of lines (n,) over one axis: the extremes of every stretch, so that no spike is lost.

    Between the samples `whole` (first, end) it is the same again, so that this part can be looked at closely.
    """
    n = lines[0].size
    kept = _extremes(lines, 0, n, most)
    begin, end = whole
    if end > begin:
        kept = np.union1d(kept, _extremes(lines, begin, end, most // 2))
    return kept


def _extremes(lines: list[Array], begin: int, end: int, most: int) -> Places:
    if end - begin <= most:
        return np.arange(begin, end)
    edges = np.linspace(begin, end, most // (2 * len(lines)) + 1).astype(np.intp)
    kept = {begin, end - 1}
    for y in lines:
        filled = np.where(np.isfinite(y), y, 0.0)
        for a, b in pairwise(edges):
            kept |= {int(a + np.argmin(filled[a:b])), int(a + np.argmax(filled[a:b]))}
    return np.array(sorted(kept), dtype=np.intp)


def thin_cloud(y: Array, *, most: int = MOST_POINTS) -> Places:
    """Points (k,) to draw of a cloud with values y (n,): evenly spaced in their order, and the farthest out."""
    if y.size <= most:
        return np.arange(y.size)
    far = np.argsort(np.abs(y - np.median(y)))[-most // 20 :]
    return np.union1d(np.arange(0, y.size, 1 + y.size // most), far)


def worth_seeing(points: Array, line: Array) -> tuple[float, float] | None:
    """The range of y that shows a law (m,) and the bulk of its points (n,); None where that is all of them.

    One outlier far above must not press the rest into a flat line: the ends are those of 98 of 100 points and of the
    line, with a margin of a sixth.
    """
    points, line = points[np.isfinite(points)], line[np.isfinite(line)]
    if not points.size:
        return None
    low, high = np.percentile(points, [1.0, 99.0])
    if line.size:
        low, high = min(low, float(line.min())), max(high, float(line.max()))
    margin = (high - low) / 6.0
    low, high = float(low - margin), float(high + margin)
    return None if (low <= points.min() and points.max() <= high) or high <= low else (low, high)
