"""Table 7, figure 26: Levenberg-Marquardt against gradient descent, two inputs.

Open in the thesis, and chosen here: as for Table 5; 31 wavelets, 100 iterations; LM with mu 0.5, beta 8
and gradient descent with mu 0.1, momentum 0.6, as stated. The start of LM is not stated: both start from
the dyadic grid.
"""

from __future__ import annotations

from rwn.thesis.experiment import Experiment, Outcome, Settings
from rwn.thesis.offline import MISO, compare_trainers, history_figure
from rwn.trainers import GradientDescent, LevenbergMarquardt

LM = LevenbergMarquardt(mu=0.5, beta=8.0, iterations=100)
GD = GradientDescent(rate=0.1, momentum=0.6, iterations=100)


def run(settings: Settings) -> Outcome:
    """Trains with both."""
    rows, runs = compare_trainers(MISO, "Table 7", LM, GD, (2.628e-7, 0.361), 31, settings)
    return Outcome(
        rows=rows, figures=[history_figure(26, "MSE for LM and gradient descent, two inputs", runs)]
    )


EXPERIMENT = Experiment(
    name="miso-trainers", title="Table 7: trainers, two inputs", run=run, tables=(7,), figures=(26,)
)
