"""Table 2, figures 15-16: MSE against the learning rate, one input.

Open in the thesis, and chosen here: as for Table 1 (201 points, mean over patterns, both readings of
(2.20), least squares for b and a, w uniform in [-0.1, 0.1], 20 seeds); 15 wavelets, momentum 0.6, 10 000
iterations, as stated.
"""

from __future__ import annotations

from rwn.studies.thesis.experiment import Experiment, Outcome, Settings
from rwn.studies.thesis.offline import MATLAB, PRINTED, SISO, Case, compare_initialisers

THESIS = {0.01: (0.7853, 0.0232), 0.02: (0.2841, 0.0190), 0.04: (0.0983, 0.0170), 0.08: (0.0198, 0.0103)}
CASES = [
    Case(label=f"mu {rate}", wavelets=15, rate=rate, momentum=0.6, heuristic=heuristic, dyadic=dyadic)
    for rate, (heuristic, dyadic) in THESIS.items()
]
READINGS = (MATLAB, PRINTED)
TITLE = "MSE for varying mu, one input"


def run(settings: Settings) -> Outcome:
    """Trains every case with both initialisations."""
    return compare_initialisers(SISO, "Table 2", CASES, {15: TITLE, 16: TITLE}, settings, readings=READINGS)


EXPERIMENT = Experiment(
    name="siso-rate",
    title="Table 2: learning rate, one input",
    run=run,
    tables=(2,),
    figures=(15, 16),
    minutes=1.5,
)
