"""Rows of a recording that is kept back which a fitted one holds too: it is no proof on what was not fitted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rwn.recording.copies import rows_in_common
from rwn.recording.inspection.finding import Finding
from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED


def overlaps(fitted: Sequence[Recording], judged: Sequence[Recording]) -> Iterator[Finding]:
    """One finding for each pair that has rows in common. Said and not refused: simulators do repeat what they did."""
    for late in judged:
        for early in fitted:
            count = rows_in_common(late, early)
            if count:
                yield Finding(
                    kind="overlap", recording=late.name, count=count,
                    signals=tuple(s for s in MEASURED if s in late.signals and s in early.signals),
                    words=f"{count} of {len(late)} rows stand in {early.name} too, which is fitted",
                    done="the error on them is no proof on what was not fitted",
                )  # fmt: skip
