"""Holds results against an archived set of them: `rwn thesis check ARCHIVE`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from rwn.errors import InputError
from rwn.studies.thesis.experiment import Row
from rwn.studies.thesis.formats import number
from rwn.studies.thesis.runner import Finished, read
from rwn.studies.thesis.words import word

FACTOR = 1.05  # two machines differ in the last digits, which training over 1e9 samples may amplify
ROUNDING = 1e-9  # below it a number is rounding error, in percent or in rad2/s2 alike


@dataclass(frozen=True, kw_only=True)
class Difference:
    """A number that is not the archive's; `changed` says that its word is another one too."""

    experiment: str
    where: str
    case: str
    archived: str
    found: str
    changed: bool


def read_archive(folder: Path) -> dict[str, Finished]:
    """The results in a folder by name. Raises InputError where there is none."""
    found = {path.stem: done for path in sorted(folder.glob("*.json")) if (done := read(path)) is not None}
    if not found:
        raise InputError(
            "no results here",
            where=str(folder),
            expected="a folder that `rwn thesis run --out` has written",
            fix="name another one",
        )
    return found


def differences(archive: Sequence[Finished], found: dict[str, Finished]) -> Iterator[Difference]:
    """What of the archive's rows is missing from the results, or another number. Times are not compared."""
    for old in archive:
        new = found.get(old.name)
        rows = {(r.where, r.case): r for r in new.rows} if new is not None else {}
        for row in old.rows:
            other = rows.get((row.where, row.case))
            if row.unit != "s" and (other is None or not _same(row.ours, other.ours)):
                yield Difference(
                    experiment=old.name,
                    where=row.where,
                    case=row.case,
                    archived=_text(row),
                    found="missing" if other is None else _text(other),
                    changed=other is None or new is None or word(row, old.rows) != word(other, new.rows),
                )


def _same(a: float | None, b: float | None) -> bool:
    if a is None or b is None:
        return a is b
    return abs(a - b) <= (FACTOR - 1) * max(abs(a), abs(b)) + ROUNDING


def _text(row: Row) -> str:
    return row.missing if row.ours is None else number(row.ours, row.unit)
