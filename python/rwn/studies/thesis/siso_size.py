"""Table 1, figures 12-14: MSE against the number of wavelets, one input.

Open in the thesis, and chosen here:
- patterns: 201 points, evenly spaced on [-10, 10]; 101 give the same. x is not scaled.
- (2.20) uses the mean over patterns of (2.12): the sum diverges at every rate of the tables.
- (2.20) is read twice: with mu (1 - gamma) in place of mu, as MATLAB's own gradient descent with momentum
  (`traingdm`) has it, which speaks for the thesis's numbers with one input, and as printed, which does with
  two (Table 5). "Choices" shows both, and other patterns and starts.
- b and a by least squares (2.7). w too is said to be initialised so, but then the equal wavelets of the
  heuristic start stay equal for ever; w is uniform in [-0.1, 0.1], a new draw for each of 20 seeds.
- mu 0.01, momentum 0.4, 10 000 iterations, as stated.
"""

from __future__ import annotations

from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Settings, curve
from rwn.studies.thesis.offline import MATLAB, PRINTED, SISO, Case, compare_initialisers, lines

CASES = [
    Case(label="Nw 7", wavelets=7, rate=0.01, momentum=0.4, heuristic=0.6208, dyadic=0.3019),
    Case(label="Nw 15", wavelets=15, rate=0.01, momentum=0.4, heuristic=1.0511, dyadic=0.0828),
    Case(label="Nw 31", wavelets=31, rate=0.01, momentum=0.4, heuristic=1.1262, dyadic=0.1292),
]
READINGS = (MATLAB, PRINTED)
TITLE = "MSE for varying Nw, one input"


def run(settings: Settings) -> Outcome:
    """Trains every case with both initialisations."""
    outcome = compare_initialisers(
        SISO, "Table 1", CASES, {13: TITLE, 14: TITLE}, settings, readings=READINGS
    )
    function = curve(SISO.y_test[:, 0], SISO.x_test[:, 0])
    shown = Figure(number=12, title="Function of one input (2.25)", panels=[lines(function)])
    return Outcome(rows=outcome.rows, figures=[shown, *outcome.figures])


EXPERIMENT = Experiment(
    name="siso-size",
    title="Table 1: number of wavelets, one input",
    run=run,
    tables=(1,),
    figures=(12, 13, 14),
    minutes=1.2,
)
