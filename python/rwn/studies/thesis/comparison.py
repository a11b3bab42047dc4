"""The comparison as text: one line per row, for the terminal and for the page."""

from __future__ import annotations

from collections.abc import Sequence

from rich.table import Table

from rwn.studies.thesis.experiment import Row
from rwn.studies.thesis.runner import Finished
from rwn.studies.thesis.words import word

HEADINGS = ("where", "case", "thesis", "ours", "smallest .. largest", "count", "word")
GOOD = {"reproduced", "reached", "holds", ""}


def number(value: float | None, unit: str = "") -> str:
    """Three digits, plain or as a power of ten."""
    if value is None:
        return "diverged"
    plain = value == 0 or 1e-3 <= abs(value) < 1e5
    text = f"{value:.3g}" if plain else f"{value:.2e}".replace("e-0", "e-").replace("e+0", "e+")
    return text + (f" {unit}" if unit else "")


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
    """The whole comparison for the terminal."""
    colour = {"trend": "yellow", "holds in part": "yellow"}
    table = Table(*HEADINGS, title="Zahidi 2013, beside this package")
    for result in results:
        for row in result.rows:
            *first, verdict = cells(row, result.rows)
            shade = "green" if verdict in GOOD else colour.get(verdict, "red")
            table.add_row(*first, f"[{shade}]{verdict}[/]")
        table.add_section()
    return table


def markdown_table(rows: Sequence[Row]) -> str:
    """One experiment's comparison, with the reasons below it."""
    lines = ["| " + " | ".join(HEADINGS) + " |", "|" + "---|" * len(HEADINGS)]
    lines += ["| " + " | ".join(cells(row, rows)) + " |" for row in rows]
    reasons = dict.fromkeys(row.reason for row in rows if row.reason and word(row, rows) not in GOOD)
    return "\n".join(lines) + "".join(f"\n\n{reason}" for reason in reasons)


def tally(results: Sequence[Finished]) -> dict[str, int]:
    """How many rows got each word."""
    words = [word(row, result.rows) for result in results for row in result.rows]
    return {w: words.count(w) for w in dict.fromkeys(words) if w}
