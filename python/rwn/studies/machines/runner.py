"""Runs machines and writes their table and a report for each diagnosis."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from rwn.errors import InputError, unknown
from rwn.report import write_report
from rwn.studies.machines.machine import Outcome
from rwn.studies.machines.registry import MACHINES
from rwn.studies.machines.table import markdown


def run_machines(names: Sequence[str], data: Path, folder: Path) -> str:
    """The table of the named machines (none: all), also in `folder`. Raises InputError where the data are not there."""
    for name in names:
        if name not in MACHINES:
            raise unknown("machine", name, MACHINES, where="rwn evidence")
    if not data.is_dir():
        raise InputError(
            "the folder of recordings is not here",
            where=data,
            expected="the folder that holds them",
            fix="give it with --data; the recordings are not part of rwn",
        )
    outcomes: list[Outcome] = []
    for name in names or list(MACHINES):
        machine = MACHINES[name]
        outcomes += machine.run(data / machine.folder, _say)
    for outcome in outcomes:
        stem = outcome.machine.lower().replace(",", "").replace(" ", "-")
        (folder / f"{stem}.json").write_bytes(outcome.found.to_json())
        write_report(outcome.found, folder / f"{stem}.html")
    table = markdown(outcomes)
    (folder / "table.md").write_text(table, encoding="utf-8")
    return table


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
