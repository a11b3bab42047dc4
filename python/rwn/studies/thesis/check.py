"""Holds results against the archived ones: `rwn thesis check`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rwn.studies.thesis.archive import Archived, Number, numbers
from rwn.studies.thesis.formats import number
from rwn.studies.thesis.runner import Finished

FACTOR = 1.05  # two machines differ in the last digits, which training over 1e9 samples may amplify
ROUNDING = 1e-9  # below it a number is rounding error, in percent or in rad2/s2 alike


@dataclass(frozen=True, kw_only=True)
class Difference:
    """A number that is not the archive's; `changed` says that its word is another one too, or that it is missing."""

    where: str
    case: str
    archived: str
    found: str
    changed: bool


def differences(archive: Sequence[Archived], found: Mapping[str, Finished]) -> Iterator[Difference]:
    """What of the archive's numbers the results do not hold in the same count, or hold another value of."""
    for old in archive:
        done = found.get(old.name)
        alike = done is not None and (done.count, done.seeds or 1) == (old.count, old.seeds or 1)
        new = {(n.where, n.case): n for n in numbers(done)} if done is not None and alike else {}
        for n in old.numbers:
            other = new.get((n.where, n.case))
            if other is None or not _same(n.ours, other.ours):
                yield Difference(
                    where=n.where,
                    case=n.case,
                    archived=_text(n),
                    found=_missing(old, done) if other is None else _text(other),
                    changed=other is None or other.word != n.word,
                )


def _missing(old: Archived, done: Finished | None) -> str:
    if done is None or done.count != old.count or done.seeds == old.seeds:
        return "missing"
    return f"missing (--seeds {done.seeds or 1}, the archive has {old.seeds or 1})"


def _same(a: float | None, b: float | None) -> bool:
    if a is None or b is None:
        return a is b
    return abs(a - b) <= (FACTOR - 1) * max(abs(a), abs(b)) + ROUNDING


def _text(n: Number) -> str:
    return f"{number(n.ours, n.unit)} ({n.word})"
