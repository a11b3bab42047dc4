"""What a bench found: tables that are printed and, with --page, written into its section of a page.

A section stands between `<!-- make bench NAME -->` and `<!-- end -->`; it has the date, commit, machine and load.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rwn.studies.made import made
from rwn.studies.sections import check_sections, write_section

COMMAND = "make bench"


@dataclass(frozen=True)
class Table:
    """Rows of cells under a heading of as many; `title` stands above it."""

    title: str
    heading: Sequence[str]
    rows: Sequence[Sequence[str]]

    def __str__(self) -> str:
        """Aligned, for a terminal."""
        widths = [max(len(row[k]) for row in (self.heading, *self.rows)) for k in range(len(self.heading))]
        rows = ([f"{cell:<{w}}" for cell, w in zip(r, widths, strict=True)] for r in (self.heading, *self.rows))
        return "\n".join([self.title, *("  ".join(row).rstrip() for row in rows)])

    @property
    def markdown(self) -> str:
        rows = [self.heading, ["---"] * len(self.heading), *self.rows]
        return "\n".join([self.title, "", *("| " + " | ".join(row) + " |" for row in rows)])


@dataclass(frozen=True)
class Bench:
    """A bench by the name of its section, and the page that it is to be written into."""

    name: str
    page: Path | None
    counts: Sequence[int]

    def show(self, *parts: Table | str) -> None:
        """Prints tables and remarks, and writes them into the section."""
        print("\n\n".join(map(str, parts)))
        if self.page is not None:
            written = [part.markdown if isinstance(part, Table) else part for part in parts]
            write_section(self.page, COMMAND, self.name, "\n\n".join([origin(), *written]))


def origin() -> str:
    """When, from what, on what and beside how much other work."""
    here = made()
    busy, cores = os.getloadavg()[0], os.cpu_count()
    return f"{here.date}, {here.commit}, {here.machine}; load {busy:.1f} on {cores} processors at the end of the run."


def asked_for(name: str, usage: str, *counts: str) -> Bench:
    """The command line of a bench: its `counts`, which it has defaults for, and --page. Wrong usage ends with 2."""
    parser = argparse.ArgumentParser(description=usage.splitlines()[0])
    for count in counts:
        parser.add_argument(count, nargs="?", type=int)
    parser.add_argument("--page", type=Path, help="page whose section of this bench is written anew")
    given = vars(parser.parse_args())
    made()  # kept from here on: the code as it is loaded, whatever is committed meanwhile
    if given["page"] is not None:
        check_sections(given["page"], COMMAND, [name])
    return Bench(name=name, page=given["page"], counts=[given[c] for c in counts if given[c] is not None])
