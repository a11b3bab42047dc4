"""Table 5, figures 21-23: MSE against the number of wavelets, two inputs.

Open in the thesis, and chosen here:
- domain [0, 1]^2, on which gradient descent's MSE after 100 iterations is nearest to the thesis's 0.361
  (Table 7); on [-0.5, 0.5]^2, stated for the online case, it is lower.
- patterns: a grid of 21 x 21. On 11 x 11 there would be fewer patterns (121) than parameters of 31
  wavelets (158), and the MSE would say nothing of the function.
- (2.20) as printed, on the mean over patterns of (2.12); with mu (1 - gamma) (see Table 1) most MSEs are 2
  to 5 times larger, further from the thesis. All weights uniform in [-0.1, 0.1] ("small random values"),
  20 seeds.
- the dyadic grid puts a wavelet on the same node of both inputs.
- mu 0.1, momentum 0.6, 10 000 iterations, as stated. The function is (2.26) as printed.
"""

from __future__ import annotations

import numpy as np

from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Panel, Settings, Surface
from rwn.studies.thesis.functions import grid, miso
from rwn.studies.thesis.offline import MISO, Case, compare_initialisers

CASES = [
    Case(label="Nw 7", wavelets=7, rate=0.1, momentum=0.6, heuristic=0.0136, dyadic=0.0104),
    Case(label="Nw 15", wavelets=15, rate=0.1, momentum=0.6, heuristic=5.0251e-4, dyadic=4.4011e-4),
    Case(label="Nw 31", wavelets=31, rate=0.1, momentum=0.6, heuristic=7.6238e-4, dyadic=2.3128e-4),
]
TITLE = "MSE for varying Nw, two inputs"


def function_panel(low: float, high: float, z: np.ndarray | None = None, title: str = "") -> Panel:
    """The function of two inputs, or other values on the same 41 x 41 grid, as a surface."""
    axis = np.linspace(low, high, 41)
    values = miso(grid(low, high, 41)) if z is None else z
    surface = Surface(
        x=axis.tolist(), y=axis.tolist(), z=values.reshape(41, 41).T.tolist(), label="f(x1, x2)"
    )
    return Panel(xlabel="x1", ylabel="x2", title=title, surface=surface)


def run(settings: Settings) -> Outcome:
    """Trains every case with both initialisations."""
    outcome = compare_initialisers(MISO, "Table 5", CASES, {22: TITLE, 23: TITLE}, settings)
    shown = Figure(number=21, title="Function of two inputs (2.26)", panels=[function_panel(0, 1)])
    return Outcome(rows=outcome.rows, figures=[shown, *outcome.figures])


EXPERIMENT = Experiment(
    name="miso-size",
    title="Table 5: number of wavelets, two inputs",
    run=run,
    tables=(5,),
    figures=(21, 22, 23),
    minutes=2.0,
)
