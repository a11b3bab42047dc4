"""Table 7, figure 26: Levenberg-Marquardt against gradient descent, two inputs.

Open in the thesis, and chosen here: as for Table 5; 31 wavelets, 100 iterations; LM with mu 0.5, beta 8
and gradient descent with mu 0.1, momentum 0.6, as stated. The start of LM is not stated: both start from
the dyadic grid.
"""

from __future__ import annotations

from functools import partial

from rwn.networks.trainers import GradientDescent, LevenbergMarquardt, Trainer
from rwn.studies.thesis.experiment import Experiment, Outcome, Search, Settings
from rwn.studies.thesis.offline import MATLAB, MISO, SEEDS, Task, compare_trainers, descent, history_figure, train
from rwn.studies.thesis.offline_choices import TWO_INPUTS, WAYS
from rwn.studies.thesis.search import median, search

TRAINERS: dict[str, Trainer] = {
    "LM": LevenbergMarquardt(mu=0.5, beta=8.0, iterations=100),
    "gradient descent": GradientDescent(rate=0.1, momentum=0.6, iterations=100),
}
THESIS = {"LM": 2.628e-7, "gradient descent": 0.361}


def run(settings: Settings) -> Outcome:
    """Trains with both."""
    rows, runs = compare_trainers(MISO, "Table 7", TRAINERS, THESIS, 31, settings, speaking=THESIS)
    figure = history_figure(26, "MSE for LM and gradient descent, two inputs", runs, THESIS)
    return Outcome(rows=rows, figures=[figure], searches=[choices(settings)])


def choices(settings: Settings) -> Search:
    """Patterns, domain, size of w, and the start of the wavelets; the reading of (2.20) as columns."""
    seeds = settings.pick(SEEDS, 3)
    slower = descent(MATLAB, rate=0.1, momentum=0.6, iterations=100)
    trainers = {**TRAINERS, "gradient descent, mu (1 - gamma)": slower}

    def values(way: str, task: Task) -> list[float | None]:
        start = WAYS[way](linear=task.linear)
        return [median(train(task, start, one, wavelets=31, seeds=seeds).mses) for one in trainers.values()]

    tried = {
        f"{name}, {way}": partial(values, way, task) for way in WAYS for name, task in TWO_INPUTS.items()
    }
    return search(
        "Table 7: domain, patterns, size of w and start",
        {name: THESIS.get(name, THESIS["gradient descent"]) for name in trainers},
        tried,
        taken="[0, 1]^2, 21 x 21, w 0.1, dyadic grid",
        count=f"{seeds} seeds, 100 iterations",
    )


EXPERIMENT = Experiment(
    name="miso-trainers",
    title="Table 7: trainers, two inputs",
    run=run,
    tables=(7,),
    figures=(26,),
    minutes=0.7,
)
