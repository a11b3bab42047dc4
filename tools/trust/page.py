"""Figures of the tests: printed, and with --page written into the section of the command that found them.

A section stands between `<!-- make NAME -->` and `<!-- end -->` of docs/testing.md; it has date, commit and machine.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from rwn.studies.made import TESTS, Made, made
from rwn.studies.sections import check_sections, write_section

COMMAND = "make"


def parsed(parser: argparse.ArgumentParser, name: str) -> argparse.Namespace:
    """The command line with --page, of which `name` is the section. Raises InputError where the page has none."""
    parser.add_argument("--page", type=Path, help=f"page whose section '{name}' is written anew")
    given = parser.parse_args()
    _made()  # kept from here on: the code as it is loaded, whatever is committed meanwhile
    if given.page is not None:
        check_sections(given.page, COMMAND, [name])
    return given


def show(name: str, page: Path | None, *parts: str) -> None:
    """Prints what was found, and writes it into its section."""
    print("\n\n".join(parts), flush=True)
    if page is not None:
        here = _made()
        write_section(page, COMMAND, name, "\n\n".join((f"{here.date}, {here.commit}, {here.machine}.", *parts)))


def _made() -> Made:
    return made(Path(__file__), also=TESTS)


def table(heading: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """Markdown."""
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in (heading, ["---"] * len(heading), *rows))
