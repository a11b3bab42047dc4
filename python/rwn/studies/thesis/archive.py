"""The archived result set: the thesis's 85 numbers as they were found, with seeds, hashes, date, commit and machine.

`archive.json` beside this file holds it; `rwn thesis archive` writes it from results, `rwn thesis check` holds others
against it.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec

from rwn.errors import InputError
from rwn.studies.made import Made
from rwn.studies.thesis.experiment import Count
from rwn.studies.thesis.overview import NUMBERS
from rwn.studies.thesis.runner import Finished, read
from rwn.studies.thesis.words import word

ARCHIVE = Path(__file__).with_name("archive.json")


@dataclass(frozen=True, kw_only=True)
class Number:
    """One of the thesis's numbers and ours (None: diverged), the median over the seeds where there are several.

    word: reproduced, better than printed, trend or not reproducible.  count: iterations or cycles, and seeds, from 0.
    """

    where: str
    case: str
    thesis: float
    ours: float | None
    unit: str
    spread: tuple[float, float] | None
    count: str
    word: str


@dataclass(frozen=True, kw_only=True)
class Archived:
    """What an experiment said of the thesis's numbers, in full counts or shortened, its longest trainings from so many
    `seeds` where it has such; `fingerprint` is of the code that said it."""

    name: str
    count: Count
    fingerprint: str
    made: Made
    seconds: float
    numbers: list[Number]
    seeds: int | None = None


def numbers(done: Finished) -> list[Number]:
    """The thesis's numbers that a result speaks for."""
    return [
        Number(
            where=row.where,
            case=row.case,
            thesis=row.thesis,
            ours=row.ours,
            unit=row.unit,
            spread=row.spread,
            count=row.count,
            word=word(row, done.rows),
        )
        for row in done.rows
        if row.answer and row.thesis is not None
    ]


def results(folder: Path) -> dict[str, Finished]:
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


def write_archive(found: Collection[Finished], path: Path = ARCHIVE) -> list[Archived]:
    """Writes the archive. Raises InputError where one of the 85 numbers is missing."""
    archived = [
        Archived(
            name=done.name,
            count=done.count,
            fingerprint=done.fingerprint,
            made=done.made,
            seconds=round(done.seconds, 1),
            numbers=numbers(done),
            seeds=done.seeds,
        )
        for done in found
    ]
    missing = sum(NUMBERS.values()) - sum(len(a.numbers) for a in archived)
    if missing:
        raise InputError(
            "these results are not all of the thesis",
            where=f"{missing} of {sum(NUMBERS.values())} numbers missing",
            expected="results of every experiment",
            fix="`rwn thesis run --all` makes them",
        )
    kept = [a for a in archived if a.numbers]
    path.write_bytes(msgspec.json.format(msgspec.json.encode(kept), indent=1) + b"\n")
    return kept


def read_archive(path: Path = ARCHIVE) -> Sequence[Archived]:
    """The archive in a file. Raises InputError where it is none."""
    try:
        return msgspec.json.decode(path.read_bytes(), type=list[Archived])
    except (FileNotFoundError, IsADirectoryError, msgspec.DecodeError) as why:
        raise InputError(
            "no archive of the thesis's numbers",
            where=str(path),
            expected="a file that `rwn thesis archive` has written",
            fix="leave --archive out to take the one of this package",
        ) from why
