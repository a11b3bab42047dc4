"""The report: one HTML file that opens offline. It computes nothing; it draws a Diagnosis."""

from __future__ import annotations

from pathlib import Path

from rwn.report.diagnosis_data import DiagnosisData
from rwn.report.page import page

__all__ = ["write_report"]


def write_report(diagnosis: DiagnosisData, path: str | Path) -> None:
    """Write the report of `diagnosis` to `path` (at most 1.5 MB, a third of it the plotting library)."""
    Path(path).write_text(page(diagnosis), encoding="utf-8")
