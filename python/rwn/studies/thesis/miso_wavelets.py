"""Table 8, figure 27: the three wavelets, two inputs.

Open in the thesis, and chosen here: as for Table 5; 31 wavelets, dyadic grid, mu 0.1, momentum 0.6, 1000
iterations, as stated. omega0 of Morlet is not stated: 5 and 1.75 are both shown; the order of the three
is judged with 5.
"""

from __future__ import annotations

from rwn.studies.thesis.experiment import Experiment, Outcome, Settings
from rwn.studies.thesis.offline import MISO, compare_wavelets, history_figure


def run(settings: Settings) -> Outcome:
    """Trains with every wavelet."""
    rows, runs = compare_wavelets(MISO, "Table 8", (0.0027, 0.0060, 0.0077), 0.1, 31, settings)
    return Outcome(rows=rows, figures=[history_figure(27, "MSE with different wavelets, two inputs", runs)])


EXPERIMENT = Experiment(
    name="miso-wavelets", title="Table 8: wavelets, two inputs", run=run, tables=(8,), figures=(27,)
)
