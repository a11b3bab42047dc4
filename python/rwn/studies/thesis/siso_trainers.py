"""Table 3, figures 17-18: Levenberg-Marquardt against gradient descent, one input.

Open in the thesis, and chosen here: as for Table 1, with both readings of (2.20); 15 wavelets, 100
iterations; LM with mu 0.1, beta 2 and gradient descent with mu 0.08, momentum 0.6, as stated. The start
of LM is not stated: both start from the dyadic grid, and LM from the heuristic start beside it. One iteration of
LM is one Jacobian, however many dampings are tried with it.
"""

from __future__ import annotations

from rwn.networks.initialisation import Heuristic
from rwn.networks.trainers import LevenbergMarquardt, Trainer
from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Search, Settings
from rwn.studies.thesis.offline import (
    MATLAB,
    PRINTED,
    SEEDS,
    SISO,
    Task,
    compare_trainers,
    descent,
    history_figure,
    output_panel,
    train,
)
from rwn.studies.thesis.offline_choices import ONE_INPUT_TAKEN, WAYS, one_input_choices
from rwn.studies.thesis.search import median, search

TRAINERS: dict[str, Trainer] = {"LM": LevenbergMarquardt(mu=0.1, beta=2.0, iterations=100)}
TRAINERS |= {
    "gradient descent" + reading: descent(reading, rate=0.08, momentum=0.6, iterations=100)
    for reading in (PRINTED, MATLAB)
}
THESIS = {label: 0.01081 if label == "LM" else 0.6716 for label in TRAINERS}


def run(settings: Settings) -> Outcome:
    """Trains with both."""
    speaking = ("LM", "gradient descent" + MATLAB)
    rows, runs = compare_trainers(SISO, "Table 3", TRAINERS, THESIS, 15, settings, speaking=speaking)
    way = Heuristic(linear=SISO.linear)
    other = train(SISO, way, TRAINERS["LM"], wavelets=15, seeds=settings.pick(SEEDS, 3))
    rows.append(other.row("Table 3", "LM, heuristic start", THESIS["LM"], iterations=100, answer=False))
    title = "Output of networks trained with LM and gradient descent"
    figures = [
        history_figure(
            17,
            "MSE for LM and gradient descent, one input",
            runs,
            {"LM": THESIS["LM"], "gradient descent": 0.6716},
        ),
        Figure(number=18, title=title, panels=[output_panel(SISO, runs)]),
    ]
    return Outcome(rows=rows, figures=figures, searches=[choices(settings)])


def choices(settings: Settings) -> Search:
    """Reading of (2.20), patterns, start of b, a and w, and of the wavelets."""
    seeds = settings.pick(SEEDS, 3)

    def values(way: str, task: Task, reading: str) -> list[float | None]:
        start, trainers = WAYS[way](linear=task.linear), (TRAINERS["LM"], TRAINERS["gradient descent" + reading])
        return [median(train(task, start, trainer, wavelets=15, seeds=seeds).mses) for trainer in trainers]

    return search(
        "Table 3: reading of (2.20), patterns and start",
        {"LM": THESIS["LM"], "gradient descent": THESIS["gradient descent"]},
        one_input_choices(values),
        taken=ONE_INPUT_TAKEN,
        count=f"{seeds} seeds, 100 iterations",
    )


EXPERIMENT = Experiment(
    name="siso-trainers", title="Table 3: trainers, one input", run=run, tables=(3,), figures=(17, 18)
)
