"""The rows of an experiment as text, for the terminal and for the page."""

from __future__ import annotations

from collections.abc import Sequence

from rich.table import Table

from rwn.studies.thesis.causes import cause
from rwn.studies.thesis.experiment import Row
from rwn.studies.thesis.formats import number
from rwn.studies.thesis.runner import Finished
from rwn.studies.thesis.words import word

HEADINGS = ("where", "case", "thesis", "ours", "smallest .. largest", "count", "word")
GOOD = {"reproduced", "better than printed", "reached", "holds", ""}


def cells(row: Row, rows: Sequence[Row]) -> tuple[str, ...]:
    """The cells of a line, in the order of HEADINGS."""
    spread = "" if row.spread is None else " .. ".join(number(v) for v in row.spread)
    goal = (
        ""
        if row.wanted is None
        else f" ({'at least' if row.judge == 'claim' else 'wanted'} {number(row.wanted)})"
    )
    thesis = "-" if row.thesis is None else number(row.thesis, row.unit)
    return (
        row.where,
        row.case,
        thesis + goal,
        row.missing if row.ours is None else number(row.ours, row.unit),
        spread,
        row.count,
        word(row, rows),
    )


def rich_table(results: Sequence[Finished]) -> Table:
    """The rows that speak for the thesis's numbers, and every other that has a word, for the terminal."""
    colour = {"trend": "yellow", "holds in part": "yellow"}
    table = Table(*HEADINGS, title="Zahidi 2013, beside this package")
    for result in results:
        for row in result.rows:
            *first, verdict = cells(row, result.rows)
            shade = "green" if verdict in GOOD else colour.get(verdict, "red")
            if verdict:
                table.add_row(*first, f"[{shade}]{verdict}[/]")
        table.add_section()
    return table


def markdown_table(rows: Sequence[Row]) -> str:
    """One experiment's comparison, with the reasons below it."""
    lines = ["| " + " | ".join(HEADINGS) + " |", "|" + "---|" * len(HEADINGS)]
    lines += ["| " + " | ".join(cells(row, rows)) + " |" for row in rows]
    reasons = dict.fromkeys(cause(row) for row in rows if cause(row) and word(row, rows) not in GOOD)
    return "\n".join(lines) + "".join(f"\n\n{reason}" for reason in reasons) if rows else ""
