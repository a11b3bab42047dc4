"""Files with several runs: `log.json#slow-forward` is the part of it whose names begin so."""

from __future__ import annotations

from collections.abc import Callable, Collection
from pathlib import Path
from typing import Self

from rwn.errors import InputError, plain
from rwn.recording.formats.table import Table
from rwn.recording.signals import TIME

_MARK = "#"


def file_and_part(path: Path) -> tuple[Path, str]:
    """The file, and the part that is named after it ("": all of it); what exists by that name is a file."""
    text, mark, part = str(path).partition(_MARK)
    if mark and Path(text).suffix and not path.exists() and not Path(text).is_dir():
        return Path(text), part
    return path, ""


def name_of(path: Path) -> str:
    """The file's name, with its part; a part may hold slashes, as the topics of a bag do.

    As a terminal may show it: a name may hold control characters.
    """
    file, part = file_and_part(path)
    return plain(f"{file.name}{_MARK}{part}" if part else file.name)


class Within(frozenset[str]):
    """The wanted names with the part's before them."""

    wanted: Collection[str]

    def __new__(cls, part: str, wanted: Collection[str]) -> Self:
        made = super().__new__(cls, (f"{part}.{name}" for name in wanted))
        made.part, made.wanted = part, wanted
        return made

    part: str

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name.startswith(f"{self.part}.") and name[len(self.part) + 1 :] in self.wanted


def part_of(
    read: Callable[[Path, Collection[str]], Table], path: Path, part: str, wanted: Collection[str]
) -> Table:
    """The table of a part, its names without the part's. Raises InputError where no name begins so."""
    table = read(path, Within(part, wanted))
    begins = f"{part}."
    units = {name.removeprefix(begins): unit for name, unit in table.units.items() if name.startswith(begins)}
    if not units:
        parts = dict.fromkeys(name.rsplit(".", 1)[0] for name in table.units if "." in name)
        raise InputError(
            f"there is no part '{part}'",
            where=path,
            expected="one of " + ", ".join(parts) if parts else "a file with parts",
            fix=f"write the file alone, or one of its parts: {path.name}#{next(iter(parts), 'NAME')}",
        )
    columns = {name.removeprefix(begins): values for name, values in table.columns.items()}
    if TIME.name in columns:
        units.setdefault(TIME.name, TIME.unit)  # of all parts
    same = {name.removeprefix(begins): own.removeprefix(begins) for name, own in table.same.items()}
    where = f"{path}{_MARK}{part}"
    return Table(where=where, columns=columns, units=units, row=table.row, same=same, notes=table.notes)
