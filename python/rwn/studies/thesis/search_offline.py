"""Choices of chapter 2, offline (ours): patterns, domain, reading of (2.20) and start, Tables 1, 2, 5 and 6.

One number per size or rate and initialisation. Of Tables 1 and 2 one seed: the range over 20 seeds is in the tables.
Of Tables 5 and 6, where the draw of the first weights moves an error by 3 to 20, the median of five, and each of 20
draws for the two numbers that no table reproduces. The heuristic start with w by least squares is not among the
choices: its equal wavelets stay equal.
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
from rwn.studies.thesis.offline import MISO, PRINTED, SEEDS, Case, Task, descent, kept, train
from rwn.studies.thesis.offline_choices import ONE_INPUT, READINGS, TWICE, TWO_INPUTS, two_inputs
from rwn.studies.thesis.search import median, search

Choices = dict[str, Callable[[], Sequence[float | None]]]
DRAWS = 5


def numbers_of(tables: dict[str, list[Case]]) -> dict[str, float]:
    """The thesis's MSEs."""
    found = {}
    for table, cases in tables.items():
        for case in cases:
            found[f"{table} {case.label} heuristic"] = case.heuristic
            found[f"{table} {case.label} dyadic"] = case.dyadic
    return found


def errors(
    tables: dict[str, list[Case]], task: Task, reading: str, iterations: int, seeds: int = 1
) -> list[float | None]:
    """Our MSEs, medians over seeds."""
    found: list[float | None] = []
    for cases in tables.values():
        for case in cases:
            trainer = descent(reading, rate=case.rate, momentum=case.momentum, iterations=iterations)
            for way in (Heuristic, DyadicGrid):
                runs = train(task, way(linear=task.linear), trainer, wavelets=case.wavelets, seeds=seeds)
                found.append(median(runs.mses))
    return found


def whole_bracket(x: Array) -> Array:
    """(2.26) read with 1.335 before all of it."""
    first = 1.335 * (1.5 - 1.5 * x[:, 0])
    return np.asarray(first + 1.335 * (miso(x) - first))


def one_input(settings: Settings) -> Search:
    """Tables 1 and 2."""
    iterations = settings.pick(10_000, 20)
    tables = {"T1": siso_size.CASES, "T2": siso_rate.CASES}
    tried: Choices = {
        f"{reading}, {name}": partial(errors, tables, task, value, iterations)
        for reading, value in READINGS.items()
        for name, task in ONE_INPUT.items()
    }
    return search(
        "Tables 1 and 2: reading of (2.20), patterns and start",
        numbers_of(tables),
        tried,
        taken="mu (1 - gamma), 201 points, b, a least squares, w 0.1",
        count=f"{iterations} iterations, 1 seed",
        progress=lambda share: settings.progress(0.1 * share),
    )


def two_input(settings: Settings) -> Search:
    """Tables 5 and 6."""
    iterations, seeds = settings.pick(10_000, 20), settings.pick(DRAWS, 1)
    tables = {"T5": miso_size.CASES, "T6": miso_rate.CASES}
    whole = two_inputs(0.0, 11, 0.1, whole_bracket)
    tasks = {**TWO_INPUTS, "[0, 1]^2, 11 x 11, w 0.1, 1.335 before all of (2.26)": whole}
    tried: Choices = {
        f"{reading}, {name}": partial(errors, tables, task, value, iterations, seeds)
        for name, task in tasks.items()
        for reading, value in {**READINGS, **TWICE}.items()
    }
    return search(
        "Tables 5 and 6: reading of (2.20), domain, patterns and start",
        numbers_of(tables),
        tried,
        taken="mu, [0, 1]^2, 21 x 21, w 0.1",
        count=f"{iterations} iterations, {seeds} seeds",
        progress=lambda share: settings.progress(0.1 + 0.8 * share),
    )


def draws(settings: Settings) -> Search:
    """The two numbers of Tables 5 and 6 that no median reproduces, draw by draw of the first weights."""
    iterations, seeds = kept(settings, 10_000, 20), settings.pick(SEEDS, 2)
    five, six = miso_size.CASES[1], miso_rate.CASES[0]
    errors = []
    for case, way in ((five, Heuristic), (six, DyadicGrid)):
        trainer = descent(PRINTED, rate=case.rate, momentum=case.momentum, iterations=iterations)
        runs = train(MISO, way(linear=MISO.linear), trainer, wavelets=case.wavelets, seeds=seeds)
        errors.append([float(mse) if np.isfinite(mse) else None for mse in runs.mses])
    settings.progress(1.0)
    return Search(
        title="Table 5, 15 wavelets, and Table 6, mu 0.02: the draw of the first weights",
        numbers={f"T5 {five.label} heuristic": five.heuristic, f"T6 {six.label} dyadic": six.dyadic},
        lines={f"seed {seed}": [mse[seed] for mse in errors] for seed in range(seeds)},
        taken="",
        count=f"{iterations} iterations",
    )


def run(settings: Settings) -> Outcome:
    """One input, two, and two draw by draw."""
    return Outcome(rows=[], searches=[one_input(settings), two_input(settings), draws(settings)])


EXPERIMENT = Experiment(name="search-offline", title="Choices of chapter 2", run=run, minutes=3.5)
