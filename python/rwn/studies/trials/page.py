"""The section of a page that `rwn trials score --page` writes: every table of a score, and what it was made from."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from rich.table import Table

from rwn.studies.made import made
from rwn.studies.sections import check_sections, write_section
from rwn.studies.trials.origins import diagnosed_by, results_of
from rwn.studies.trials.seal import HASH

COMMAND = "rwn trials score"


def name_of(folders: Sequence[Path]) -> str:
    """Name of the section: that of the folders of trials."""
    return " ".join(folder.name for folder in folders)


def check_page(page: Path, folders: Sequence[Path]) -> None:
    """Raises InputError where the page has no section for these sets."""
    check_sections(page, COMMAND, [name_of(folders)])


def write_page(page: Path, folders: Sequence[Path], tables: Iterable[str | Table], *, results: Path | None) -> None:
    """A score in place of what stood in its section; `tables` and `results` as for the score itself."""
    parts = [markdown(part) if isinstance(part, Table) else f"{part}." for part in tables]
    parts += [*_origins(folders, results), f"Scored on {made().date} by {made().commit}."]
    write_section(page, COMMAND, name_of(folders), "\n\n".join(parts))


def markdown(table: Table) -> str:
    """A table of rich, its title above it; its cells are text."""
    columns = [[str(column.header), *map(str, column.cells)] for column in table.columns]
    lines = ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in zip(*columns, strict=True)]
    lines.insert(1, "|" + "---|" * len(columns))
    return "\n".join([f"{table.title}:", "", *lines])


def _origins(folders: Sequence[Path], results: Path | None) -> list[str]:
    """For each set its seal, and by which code, when and where it was diagnosed."""
    lines = []
    for folder in folders:
        seal = (folder / HASH).read_text().split()[0] if (folder / HASH).exists() else "none: open answers"
        by = "; ".join(diagnosed_by(folder, results_of(folder, folders, results)))
        lines.append(f"`{folder.name}`: SHA-256 of the answers {seal}; diagnosed by {by}.")
    return lines

