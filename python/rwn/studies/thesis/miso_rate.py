"""Table 6, figures 24-25: MSE against the learning rate, two inputs.

Open in the thesis, and chosen here: as for Table 5 ([0, 1]^2, 21 x 21 patterns, mean over patterns,
weights uniform in [-0.1, 0.1], 20 seeds); 31 wavelets, momentum 0.6, 10 000 iterations, as stated.
"""

from __future__ import annotations

from rwn.studies.thesis.experiment import Experiment, Outcome, Settings
from rwn.studies.thesis.offline import MISO, Case, compare_initialisers

THESIS = {0.02: (0.0028, 7.4482e-4), 0.05: (0.0013, 3.3013e-4), 0.08: (7.5450e-4, 4.0521e-4)}
CASES = [
    Case(label=f"mu {rate}", wavelets=31, rate=rate, momentum=0.6, heuristic=heuristic, dyadic=dyadic)
    for rate, (heuristic, dyadic) in THESIS.items()
]
TITLE = "MSE for varying mu, two inputs"


def run(settings: Settings) -> Outcome:
    """Trains every case with both initialisations."""
    return compare_initialisers(MISO, "Table 6", CASES, {24: TITLE, 25: TITLE}, settings)


EXPERIMENT = Experiment(
    name="miso-rate",
    title="Table 6: learning rate, two inputs",
    run=run,
    tables=(6,),
    figures=(24, 25),
    minutes=3.0,
)
