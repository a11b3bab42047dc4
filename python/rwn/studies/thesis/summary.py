"""Tables over all experiments: claims of the thesis, and what was wanted beyond it."""

from __future__ import annotations

from collections.abc import Sequence

from rwn.studies.thesis.formats import number
from rwn.studies.thesis.runner import Finished
from rwn.studies.thesis.words import word

WANTED = ("wanted", "coverage")


def claims_table(results: Sequence[Finished]) -> str:
    """The thesis's claims, each with the share of cases in which it is true; empty without any."""
    lines = []
    for result in results:
        for row in result.rows:
            if row.judge == "claim":
                share = row.missing if row.ours is None else number(row.ours)
                what = row.case.removeprefix("claim: ")
                lines.append(f"| {row.where} | {what} | {share} | {row.count} | {word(row, result.rows)} |")
    heading = ["| where | claim | share | of | word |", "|---|---|---|---|---|"]
    return "\n".join([*heading, *lines]) if lines else ""


def wanted_table(results: Sequence[Finished]) -> str:
    """One line per row for which this package set itself a goal; empty without any."""
    lines = []
    for result in results:
        for row in result.rows:
            if row.judge in WANTED:
                goal = "0.90 .. 0.98" if row.judge == "coverage" else f"at most {number(row.wanted, row.unit)}"
                ours = row.missing if row.ours is None else number(row.ours, row.unit)
                lines.append(f"| {row.where} | {row.case} | {goal} | {ours} | {word(row, result.rows)} |")
    heading = ["| where | what | goal of this package | ours | word |", "|---|---|---|---|---|"]
    return "\n".join([*heading, *lines]) if lines else ""
