"""What the tests of the thesis's experiments share: a made-up row, and the page of the repository."""

from __future__ import annotations

from pathlib import Path

from rwn.studies.thesis.experiment import Row

PAGE = Path(__file__).resolve().parents[1] / "docs" / "thesis.md"


def row(thesis: float | None, ours: float | None, **rest: object) -> Row:
    return Row(where="Table 0", case="c", thesis=thesis, ours=ours, **rest)  # type: ignore[arg-type]
