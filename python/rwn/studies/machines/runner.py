"""Runs machines and writes their table and a report for each diagnosis."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from rwn.errors import InputError, unrecognised
from rwn.report import write_report
from rwn.studies.machines.hand_fit import HANDS, Errors
from rwn.studies.machines.machine import Outcome
from rwn.studies.machines.registry import MACHINES
from rwn.studies.machines.table import markdown
from rwn.studies.made import made
from rwn.studies.sections import check_sections, write_section

COMMAND = "rwn evidence"


def run_machines(
    names: Sequence[str], data: Path, folder: Path, *, by_hand: bool = False, page: Path | None = None
) -> str:
    """The table of the named machines (none: all), also in `folder`.

    `by_hand`: with the error of a physical fit made by hand. `page`: a Markdown page whose sections of these machines
    are written anew. Raises InputError where the data or the sections are not there.
    """
    names = list(names) or list(MACHINES)
    for name in names:
        if name not in MACHINES:
            raise unrecognised("machine", name, MACHINES, where="rwn evidence")
    if not data.is_dir():
        raise InputError(
            "the folder of recordings is not here",
            where=data,
            expected="the folder that holds them",
            fix="give it with --data; the recordings are not part of rwn",
        )
    if page:
        check_sections(page, COMMAND, names)
    tables = []
    for name in names:
        table, took = _run(name, data, folder, by_hand=by_hand)
        tables.append(table)
        if page:
            by = f"Made on {made().date} by {made().commit}, diagnosed in {took:.0f} s."
            write_section(page, COMMAND, name, f"{table}\n{by}")
    text = "\n".join(tables)
    (folder / "table.md").write_text(text, encoding="utf-8")
    return text


def _run(name: str, data: Path, folder: Path, *, by_hand: bool) -> tuple[str, float]:
    """The table of one machine, and how long its diagnoses took [s]."""
    machine = MACHINES[name]
    outcomes = machine.run(data / machine.folder, _say)
    for outcome in outcomes:
        stem = outcome.machine.lower().replace(",", "").replace(" ", "-")
        (folder / f"{stem}.json").write_bytes(outcome.found.to_json())
        write_report(outcome.found, folder / f"{stem}.html")
    if by_hand:
        _say(f"{name}: fitted by hand")
        errors = HANDS[name](data / machine.folder)
        outcomes = tuple(_beside(outcome, errors) for outcome in outcomes)
    return markdown(outcomes), sum(outcome.found.elapsed for outcome in outcomes)


def _beside(outcome: Outcome, by_hand: Errors) -> Outcome:
    errors = (replace(e, by_hand=by_hand.get((outcome.machine, e.measure))) for e in outcome.errors)
    return replace(outcome, errors=tuple(errors))


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
