"""All experiments, in the order of the thesis."""

from __future__ import annotations

from rwn.thesis import (
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
    online_miso,
    online_siso,
    simultaneous,
    siso_rate,
    siso_size,
    siso_trainers,
    siso_wavelets,
    structured_friction,
    three_parameters,
    viscous,
)
from rwn.thesis.experiment import Experiment

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
        noise,
        electrical,
    )
)


def select(*, table: int | None = None, figure: int | None = None) -> list[Experiment]:
    """The experiments that make a table or figure of the thesis; all of them if neither is given.

    Raises ValueError if no experiment makes it.
    """
    chosen = [
        e
        for e in EXPERIMENTS
        if (table is None and figure is None) or table in e.tables or figure in e.figures
    ]
    if not chosen:
        known_tables = sorted({t for e in EXPERIMENTS for t in e.tables})
        known_figures = sorted({f for e in EXPERIMENTS for f in e.figures})
        what = f"table {table}" if table is not None else f"figure {figure}"
        raise ValueError(
            f"no experiment makes {what}; tables: {_list(known_tables)}; figures: {_list(known_figures)}"
        )
    return chosen


def _list(numbers: list[int]) -> str:
    return ", ".join(map(str, numbers)) or "none"
