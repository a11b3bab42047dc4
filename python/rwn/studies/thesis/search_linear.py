"""Choices of chapter 5 (ours): fraction of the bound and where its maxima come from, Tables 17 to 20.

The rates of the thesis lie between 0 and the bound; how far below, and whether the maxima of the signals were known
before the first sample, is not said. Every combination is tried from the thesis's starts, for its 50 cycles. For
Table 20: the fraction and when one stops, after 300 cycles of initialisation; all 200 000 cycles of one choice take 4
minutes of a core, so the choices have 10 000 at most.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Literal

import rwn
from rwn.networks.rates import Thesis
from rwn.studies.thesis import frictionless, three_parameters, viscous
from rwn.studies.thesis.drive import chirp, error_percent, friction_network, speed_with_friction
from rwn.studies.thesis.experiment import Experiment, Outcome, Search, Settings
from rwn.studies.thesis.linear import SYMBOLS, Case, thesis_rule
from rwn.studies.thesis.search import search
from rwn.studies.thesis.simultaneous import LEARN, NETWORK, WRONG

Maxima = Literal["running", "pre-pass", "pre-pass-then-running"]
MAXIMA: tuple[Maxima, ...] = ("running", "pre-pass", "pre-pass-then-running")
FRACTIONS = (0.003, 0.01, 0.1, 0.5, 0.9, 0.99)


def numbers_of(cases: Sequence[Case]) -> dict[str, float]:
    """The thesis's errors of every case."""
    return {
        f"{case.label}, {SYMBOLS[name]}": value
        for case in cases
        for name, value in case.thesis.items()
        if value is not None
    }


def errors(cases: Sequence[Case], rule: Thesis, cycles: int) -> list[float | None]:
    """Our errors of every case [%]; None where the run diverged."""
    found: list[float | None] = []
    for case in cases:
        u, y = case.recording()
        run = rwn.train_structured(case.network(), u, y, learn=case.learn, rates=rule, cycles=cycles)
        failed = run.status in ("diverged", "unstable")
        wanted = [name for name, value in case.thesis.items() if value is not None]
        found += [None if failed else error_percent(run.network, name) for name in wanted]
    return found


def linear(title: str, cases: Sequence[Case], taken: str, cycles: int) -> Search:
    """Every fraction with every kind of maxima."""
    tried: dict[str, Callable[[], Sequence[float | None]]] = {
        f"{fraction}, {maxima}": partial(
            errors, cases, Thesis(fraction=fraction, maxima=maxima, shared=False), cycles
        )
        for maxima in MAXIMA
        for fraction in FRACTIONS
    }
    tried["0.9, pre-pass, v3 as misprinted"] = partial(
        errors, cases, Thesis(fraction=0.9, maxima="pre-pass", shared=False, misprint=True), cycles
    )
    return search(title, numbers_of(cases), tried, taken=taken, count=f"{cycles} cycles", unit="%")


def simultaneous(settings: Settings) -> Search:
    """J and raw B of Table 20 by fraction, maxima and number of cycles."""
    u = chirp(1.0, 0.0, 4.0)
    y = speed_with_friction(u)
    begun = rwn.train_structured(
        friction_network(y, 15, seed=0, motor=WRONG, size=1e-3),
        u,
        y,
        learn=NETWORK,
        rates=thesis_rule(0.5),
        cycles=settings.pick(300, 5),
    ).network

    def values(fraction: float, maxima: Maxima, cycles: int) -> list[float | None]:
        rule = Thesis(fraction=fraction, maxima=maxima, shared=False)
        run = rwn.train_structured(begun, u, y, learn=LEARN, rates=rule, cycles=cycles)
        failed = run.status in ("diverged", "unstable")
        return [None if failed else error_percent(run.network, n) for n in ("inertia", "viscous_friction")]

    counts = {"running": (10, 300, 1500), "pre-pass": (10, 300, 1500, 10_000)}
    tried = {
        f"{fraction}, {maxima}, {cycles} cycles": partial(values, fraction, maxima, cycles)
        for maxima in MAXIMA[:2]
        for fraction in (0.02, 0.1, 0.5, 0.9)
        for cycles in (settings.pick(count, 1) for count in counts[maxima])
    }
    count = "1 seed; the table goes on to 200 000 cycles with 0.5 and both maxima"
    numbers = {"J": 11.0, "raw B": 22.5}
    return search("Table 20: fraction, maxima and cycles", numbers, tried, taken="", count=count, unit="%")


def run(settings: Settings) -> Outcome:
    """The linear tables, then Table 20."""
    cycles = settings.pick(50, 2)
    searches = []
    for title, cases, taken in (
        ("Table 17: fraction and maxima", frictionless.CASES, "0.01, pre-pass-then-running"),
        ("Table 18: fraction and maxima", viscous.CASES, "0.99, running"),
        ("Table 19: fraction and maxima", three_parameters.CASES, "0.9, pre-pass"),
    ):
        searches.append(linear(title, cases, taken, cycles))
        settings.progress(0.2 * len(searches))
    return Outcome(rows=[], searches=[*searches, simultaneous(settings)])


EXPERIMENT = Experiment(name="search-linear", title="Choices of chapter 5", run=run, minutes=2.0)
