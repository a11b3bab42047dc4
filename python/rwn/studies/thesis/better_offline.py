"""Better than Tables 1-3 and 5-7 on the same task and the same patterns.

Chosen here:
- patterns, functions and sizes as in Tables 1 and 5 (their files say which); 31 wavelets, the largest of
  Tables 1 and 5, and 15 for Table 3.
- start by selection (orthogonal least squares over a library of wavelets), then 100 iterations of
  variable projection: both are deterministic, so no seed enters. Time is processor time of start
  and training together, on the machine that ran this.
- Levenberg-Marquardt as printed from the same start is given beside it.
- a low error on the patterns is worth little if the network swings between them: every network is tested
  on a grid ten times (one input) or four times (two inputs) finer, beside the thesis's own training
  (dyadic grid, gradient descent) there.
- wanted: MSE 100 times below the best of Tables 1-2 (0.0103) and 5-6 (2.3e-4) in under 1 s; at or below
  Tables 3 and 7.
"""

from __future__ import annotations

import time

from rwn.networks.initialisation import DyadicGrid, Initialiser, Selection
from rwn.networks.trainers import GradientDescent, LevenbergMarquardt, Trainer, VariableProjection
from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Panel, Row, Settings, curve
from rwn.studies.thesis.offline import MISO, SISO, Runs, Task, output_panel, train


def run(settings: Settings) -> Outcome:
    """Trains on both tasks."""
    iterations = settings.pick(100, 5)
    gd = GradientDescent(rate=0.08, momentum=0.6, iterations=settings.pick(10_000, 20), stall=-1)
    one = _compare(SISO, 31, iterations, gd)
    settings.progress(0.3)
    two = _compare(MISO, 31, iterations, gd)
    settings.progress(0.6)
    rows = [*_rows(one, "Tables 1-2", 0.0103, iterations), *_rows(two, "Tables 5-6", 2.3128e-4, iterations)]
    for where, task, thesis, size, levels in (
        ("Table 3", SISO, 0.01081, 15, 5),
        ("Table 7", MISO, 2.628e-7, 31, 5),
    ):
        timed = _timed(task, Selection(levels=levels), VariableProjection(iterations=iterations), size)
        rows.append(
            _wanted(where, f"selection + variable projection, Nw {size}", thesis, thesis, timed, iterations)
        )
    settings.progress(1.0)
    labels = ["selection + variable projection", "dyadic grid + gradient descent"]
    shown = [output_panel(SISO, {label: one[label][0] for label in labels})]
    histories = [
        Panel(
            title=title,
            xlabel="iteration",
            ylabel="MSE",
            curves=[curve(runs.median.mse, label=label) for label, (runs, _) in by_label.items()],
            log_x=True,
            log_y=True,
        )
        for title, by_label in {"one input": one, "two inputs": two}.items()
    ]
    figures = [
        Figure(
            number=None, name="better_offline", title="Second-order training from selection", panels=histories
        ),
        Figure(number=None, name="better_output", title="Output, one input, 31 wavelets", panels=shown),
    ]
    return Outcome(rows=rows, figures=figures)


Timed = tuple[Runs, float]


def _timed(task: Task, way: Initialiser, trainer: Trainer, wavelets: int) -> Timed:
    start = time.thread_time()
    runs = train(task, way, trainer, wavelets=wavelets, seeds=1)
    return runs, time.thread_time() - start


def _compare(task: Task, wavelets: int, iterations: int, gd: Trainer) -> dict[str, Timed]:
    selection = Selection(levels=4)
    ways: dict[str, tuple[Initialiser, Trainer]] = {
        "selection + variable projection": (selection, VariableProjection(iterations=iterations)),
        "selection + LM": (selection, LevenbergMarquardt(iterations=iterations)),
        "dyadic grid + gradient descent": (DyadicGrid(linear=task.linear), gd),
    }
    return {label: _timed(task, way, trainer, wavelets) for label, (way, trainer) in ways.items()}


def _rows(compared: dict[str, Timed], where: str, thesis: float, iterations: int) -> list[Row]:
    task = SISO if where == "Tables 1-2" else MISO
    best = compared["selection + variable projection"]
    rows = [_wanted(where, "selection + variable projection", thesis, thesis / 100, best, iterations)]
    rows.append(
        Row(
            where=where,
            case="time of selection + variable projection",
            ours=best[1],
            wanted=1.0,
            judge="wanted",
            unit="s",
            count="1 core",
        )
    )
    for label, (runs, _) in compared.items():
        training = runs.median
        rows.append(
            Row(
                where=where,
                case=f"{label}, tested on the finer grid",
                ours=training.network.mse(task.x_test, task.y_test),
                judge="none",
                count=f"{len(training.mse) - 1} iterations, trained to {training.frozen_mse:.2g}",
            )
        )
    return rows


def _wanted(where: str, case: str, thesis: float, wanted: float, timed: Timed, iterations: int) -> Row:
    return Row(
        where=where,
        case=case,
        thesis=thesis,
        ours=timed[0].median.frozen_mse,
        wanted=wanted,
        judge="wanted",
        count=f"{iterations} iterations, {timed[1]:.2g} s",
        reason=f"{where}: {timed[0].median.status} after {len(timed[0].median.mse) - 1} iterations.",
    )


EXPERIMENT = Experiment(name="better-offline", title="Better than Tables 1-3 and 5-7", run=run, minutes=0.4)
