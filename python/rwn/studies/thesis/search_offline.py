"""Choices of chapter 2, offline (ours): patterns, domain, reading of (2.20) and start, Tables 1 to 6.

One number each of Tables 1, 2, 5 and 6 per size or rate and initialisation, one seed: the range over 20 seeds is in
the tables. The heuristic start with w by least squares is not among them: its equal wavelets stay equal.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from rwn.networks.arrays import Array
from rwn.networks.initialisation import DyadicGrid, Heuristic
from rwn.studies.thesis import miso_rate, miso_size, siso_rate, siso_size
from rwn.studies.thesis.experiment import Experiment, Outcome, Search, Settings
from rwn.studies.thesis.functions import miso
from rwn.studies.thesis.offline import Case, Task, descent, train
from rwn.studies.thesis.offline_choices import ONE_INPUT, READINGS, TWO_INPUTS, two_inputs
from rwn.studies.thesis.search import median, search

Choices = dict[str, Callable[[], Sequence[float | None]]]


def numbers_of(tables: dict[str, list[Case]]) -> dict[str, float]:
    """The thesis's MSEs."""
    found = {}
    for table, cases in tables.items():
        for case in cases:
            found[f"{table} {case.label} heuristic"] = case.heuristic
            found[f"{table} {case.label} dyadic"] = case.dyadic
    return found


def errors(tables: dict[str, list[Case]], task: Task, reading: str, iterations: int) -> list[float | None]:
    """Our MSEs."""
    found: list[float | None] = []
    for cases in tables.values():
        for case in cases:
            trainer = descent(reading, rate=case.rate, momentum=case.momentum, iterations=iterations)
            for way in (Heuristic, DyadicGrid):
                runs = train(task, way(linear=task.linear), trainer, wavelets=case.wavelets, seeds=1)
                found.append(median(runs.mses))
    return found


def whole_bracket(x: Array) -> Array:
    """(2.26) read with 1.335 before all of it."""
    first = 1.335 * (1.5 - 1.5 * x[:, 0])
    return np.asarray(first + 1.335 * (miso(x) - first))


def run(settings: Settings) -> Outcome:
    """One input, then two."""
    iterations = settings.pick(10_000, 20)
    tables = {"T1": siso_size.CASES, "T2": siso_rate.CASES}
    tried: Choices = {
        f"{reading}, {name}": partial(errors, tables, task, value, iterations)
        for reading, value in READINGS.items()
        for name, task in ONE_INPUT.items()
    }
    taken = "mu (1 - gamma), 201 points, b, a least squares, w 0.1"
    found: list[Search] = []
    title = "Tables 1 and 2: reading of (2.20), patterns and start"
    found.append(
        search(
            title,
            numbers_of(tables),
            tried,
            taken=taken,
            count=f"{iterations} iterations, 1 seed",
            progress=lambda share: settings.progress(0.3 * share),
        )
    )
    tables = {"T5": miso_size.CASES, "T6": miso_rate.CASES}
    whole = two_inputs(0.0, 11, 0.1, whole_bracket)
    tasks = {**TWO_INPUTS, "[0, 1]^2, 11 x 11, w 0.1, 1.335 before all of (2.26)": whole}
    tried = {
        f"{reading}, {name}": partial(errors, tables, task, value, iterations)
        for name, task in tasks.items()
        for reading, value in READINGS.items()
    }
    found.append(
        search(
            "Tables 5 and 6: reading of (2.20), domain, patterns and start",
            numbers_of(tables),
            tried,
            taken="mu, [0, 1]^2, 21 x 21, w 0.1",
            count=f"{iterations} iterations, 1 seed",
            progress=lambda share: settings.progress(0.3 + 0.7 * share),
        )
    )
    return Outcome(rows=[], searches=found)


EXPERIMENT = Experiment(name="search-offline", title="Choices of chapter 2", run=run, minutes=2.5)
