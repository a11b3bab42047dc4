"""Table 3, figures 17-18: Levenberg-Marquardt against gradient descent, one input.

Open in the thesis, and chosen here: as for Table 1; 15 wavelets, 100 iterations; LM with mu 0.1, beta 2
and gradient descent with mu 0.08, momentum 0.6, as stated. The start of LM is not stated: both start from
the dyadic grid. One iteration of LM is one Jacobian, however many dampings are tried with it.
"""

from __future__ import annotations

from rwn.thesis.experiment import Experiment, Outcome, Settings
from rwn.thesis.offline import SISO, compare_trainers, history_figure, output_figure
from rwn.trainers import GradientDescent, LevenbergMarquardt

LM = LevenbergMarquardt(mu=0.1, beta=2.0, iterations=100)
GD = GradientDescent(rate=0.08, momentum=0.6, iterations=100)


def run(settings: Settings) -> Outcome:
    """Trains with both."""
    rows, runs = compare_trainers(SISO, "Table 3", LM, GD, (0.01081, 0.6716), 15, settings)
    figures = [
        history_figure(17, "MSE for LM and gradient descent, one input", runs),
        output_figure(18, "Output of networks trained with LM and gradient descent", SISO, runs),
    ]
    return Outcome(rows=rows, figures=figures)


EXPERIMENT = Experiment(
    name="siso-trainers", title="Table 3: trainers, one input", run=run, tables=(3,), figures=(17, 18)
)
