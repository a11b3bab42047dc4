"""The report: one HTML file that opens offline. It computes nothing; it draws a Diagnosis."""

from __future__ import annotations

from pathlib import Path

from rwn.report.diagnosis import Diagnosis
from rwn.report.page import page

__all__ = ["write_report"]


def write_report(diagnosis: Diagnosis, path: str | Path) -> None:
    """Write the report of `diagnosis` to `path` (about 5 MB, most of it the plotting library)."""
    Path(path).write_text(page(diagnosis), encoding="utf-8")
