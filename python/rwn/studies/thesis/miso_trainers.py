"""Table 7, figure 26: Levenberg-Marquardt against gradient descent, two inputs.

Open in the thesis, and chosen here: as for Table 5; 31 wavelets, 100 iterations; LM with mu 0.5, beta 8
and gradient descent with mu 0.1, momentum 0.6, as stated. The start of LM is not stated: both start from
the dyadic grid.
"""

from __future__ import annotations

from rwn.networks.trainers import GradientDescent, LevenbergMarquardt, Trainer
from rwn.studies.thesis.experiment import Experiment, Outcome, Settings
from rwn.studies.thesis.offline import MISO, compare_trainers, history_figure

TRAINERS: dict[str, Trainer] = {
    "LM": LevenbergMarquardt(mu=0.5, beta=8.0, iterations=100),
    "gradient descent": GradientDescent(rate=0.1, momentum=0.6, iterations=100),
}
THESIS = {"LM": 2.628e-7, "gradient descent": 0.361}
CAUSES = {"LM": "the start decides by more than 100: the best seed is within 2 of the thesis's", "gradient descent": ""}


def run(settings: Settings) -> Outcome:
    """Trains with both."""
    rows, runs = compare_trainers(MISO, "Table 7", TRAINERS, THESIS, 31, settings, causes=CAUSES)
    return Outcome(
        rows=rows, figures=[history_figure(26, "MSE for LM and gradient descent, two inputs", runs, THESIS)]
    )


EXPERIMENT = Experiment(
    name="miso-trainers",
    title="Table 7: trainers, two inputs",
    run=run,
    tables=(7,),
    figures=(26,),
    minutes=0.7,
)
