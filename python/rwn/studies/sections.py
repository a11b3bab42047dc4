"""Pages of which commands write sections, each between two comments, and people the rest."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rwn.errors import InputError

END = "<!-- end -->"


def begin_of(command: str, name: str) -> str:
    """The comment above a section, by the command that writes it: `<!-- rwn evidence emps -->`."""
    return f"<!-- {command} {name} -->"


def check_sections(page: Path, command: str, names: Sequence[str]) -> None:
    """Raises InputError where the page is not there, or has no section of one of these names."""
    text = page.read_text(encoding="utf-8") if page.is_file() else ""
    for name in names:
        begin = begin_of(command, name)
        if begin not in text or END not in text[text.index(begin) :]:
            raise InputError(
                f"there is no section for '{name}'",
                where=page,
                expected=f"a line '{begin}' and after it a line '{END}'",
                fix="write these two lines where the section is to stand",
            )


def write_section(page: Path, command: str, name: str, section: str) -> None:
    """A section in place of what stood between its two comments; `check_sections` says whether they are there."""
    text = page.read_text(encoding="utf-8")
    begin = text.index(begin_of(command, name)) + len(begin_of(command, name))
    end = text.index(END, begin)
    page.write_text(f"{text[:begin]}\n{section}\n{text[end:]}", encoding="utf-8")
