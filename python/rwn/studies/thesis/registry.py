"""All experiments, in the order of the thesis."""

from __future__ import annotations

from collections.abc import Iterable

from rwn.errors import InputError
from rwn.studies.thesis import (
    better_offline,
    black_box,
    claims,
    claims_rates,
    convergence_map,
    electrical,
    frictionless,
    measured_friction,
    miso_rate,
    miso_size,
    miso_trainers,
    miso_wavelets,
    noise,
    online_beyond,
    online_miso,
    online_siso,
    search_friction,
    search_linear,
    search_offline,
    simultaneous,
    siso_rate,
    siso_size,
    siso_trainers,
    siso_wavelets,
    structured_friction,
    three_parameters,
    viscous,
)
from rwn.studies.thesis.experiment import Experiment

EXPERIMENTS: tuple[Experiment, ...] = tuple(
    chapter.EXPERIMENT
    for chapter in (
        siso_size,
        siso_rate,
        siso_trainers,
        siso_wavelets,
        miso_size,
        miso_rate,
        miso_trainers,
        miso_wavelets,
        online_siso,
        online_miso,
        better_offline,
        claims,
        black_box,
        measured_friction,
        structured_friction,
        frictionless,
        viscous,
        three_parameters,
        simultaneous,
        claims_rates,
        convergence_map,
        online_beyond,
        noise,
        electrical,
        search_offline,
        search_friction,
        search_linear,
    )
)


def select(*, table: int | None = None, figure: int | None = None) -> list[Experiment]:
    """The experiments that make a table or figure of the thesis; all of them if neither is given.

    Raises InputError if no experiment makes it.
    """
    chosen = [
        e
        for e in EXPERIMENTS
        if (table is None and figure is None) or table in e.tables or figure in e.figures
    ]
    if not chosen:
        what, number = ("table", table) if table is not None else ("figure", figure)
        known = {n for e in EXPERIMENTS for n in (e.tables if what == "table" else e.figures)}
        raise InputError(
            f"no experiment makes {what} {number}",
            where="rwn thesis run",
            expected=f"one of {what}s {ranges(known)}",
            fix="`rwn thesis list` shows what makes which",
        )
    return chosen


def ranges(numbers: Iterable[int]) -> str:
    """Numbers in words, neighbours together: 1-3, 7; - for none."""
    runs: list[list[int]] = []
    for n in sorted(numbers):
        if runs and n == runs[-1][-1] + 1:
            runs[-1].append(n)
        else:
            runs.append([n])
    return ", ".join(str(r[0]) if len(r) == 1 else f"{r[0]}-{r[-1]}" for r in runs) or "-"
