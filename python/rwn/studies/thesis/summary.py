"""What the page says first: what was wanted and reached, and what is not reproduced and why."""

from __future__ import annotations

from collections.abc import Sequence

from rwn.studies.thesis.comparison import GOOD, number
from rwn.studies.thesis.experiment import Row
from rwn.studies.thesis.runner import Finished
from rwn.studies.thesis.words import word

WANTED = ("wanted", "coverage")


def wanted_table(results: Sequence[Finished]) -> str:
    """One line per row for which a better value was wanted."""
    lines = ["| where | what | wanted | ours | word |", "|---|---|---|---|---|"]
    for result in results:
        for row in result.rows:
            if row.judge in WANTED:
                goal = "0.90 .. 0.98" if row.judge == "coverage" else f"at most {number(row.wanted, row.unit)}"
                ours = row.missing if row.ours is None else number(row.ours, row.unit)
                lines.append(f"| {row.where} | {row.case} | {goal} | {ours} | {word(row, result.rows)} |")
    return "\n".join(lines)


def causes(results: Sequence[Finished]) -> str:
    """The rows that are not `reproduced`, with their causes: one line per row."""
    lines = ["| where | case | thesis | ours | word | cause |", "|---|---|---|---|---|---|"]
    for result in results:
        for row in result.rows:
            verdict = word(row, result.rows)
            if row.judge not in WANTED and verdict not in GOOD:
                lines.append(f"| {row.where} | {row.case} | {_beside(row)} | {verdict} | {row.reason or '-'} |")
    return "\n".join(lines)


def _beside(row: Row) -> str:
    thesis = "-" if row.thesis is None else number(row.thesis, row.unit)
    return f"{thesis} | {row.missing if row.ours is None else number(row.ours, row.unit)}"
