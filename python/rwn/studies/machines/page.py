"""The page of real machines: `rwn evidence` writes the section of each, people write the rest."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rwn.errors import InputError
from rwn.studies.made import made

BEGIN, END = "<!-- rwn evidence {} -->", "<!-- end -->"


def check_sections(page: Path, names: Sequence[str]) -> None:
    """Raises InputError where the page is not there, or has no section for one of the machines."""
    text = page.read_text(encoding="utf-8") if page.is_file() else ""
    for name in names:
        begin = BEGIN.format(name)
        if begin not in text or END not in text[text.index(begin) :]:
            raise InputError(
                f"there is no section for '{name}'",
                where=page,
                expected=f"a line '{begin}' and after it a line '{END}'",
                fix="write these two lines where the section is to stand",
            )


def write_section(page: Path, name: str, table: str, took: float) -> None:
    """The section of one machine in place of what stood there, with the date and the commit that made it."""
    text = page.read_text(encoding="utf-8")
    begin = text.index(BEGIN.format(name)) + len(BEGIN.format(name))
    end = text.index(END, begin)
    by = f"Made on {made().date} by {made().commit}, diagnosed in {took:.0f} s."
    page.write_text(f"{text[:begin]}\n{table}\n{by}\n{text[end:]}", encoding="utf-8")
