"""Table 17, figures 84-87: inertia and torque constant of a motor without friction.

Open in the thesis, and chosen here: the fraction of the rate bound (it says below 1) and what the maxima start
from: 0.01, each group by itself, maxima of a pass over the first cycle and running from there. With running
maxima alone the first samples see a tiny signal and the rates are enormous; "Choices" shows both, and other
fractions. The chirp is a sine; the start of Kt in case 2 is unreadable and taken as 50 % low like J. The state
is reset at each cycle.
"""

from __future__ import annotations

from rwn.networks.rates import Thesis
from rwn.networks.trainers import RecursiveGaussNewton
from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Settings
from rwn.studies.thesis.linear import Case, as_printed, better, figures
from rwn.studies.thesis.methods import compare_methods
from rwn.studies.thesis.panels import signal_panel

ZERO: dict[str, float | None] = {"inertia": 0.0, "torque_constant": 0.0}
CASES = [
    Case(label="case 1", start={"inertia": 1.44e-4, "torque_constant": 0.044}, thesis=ZERO, viscous=0.0),
    Case(label="case 2", start={"inertia": 0.9e-4, "torque_constant": 0.0275}, thesis=ZERO, viscous=0.0),
]
BEYOND = [
    Case(
        label="J -50 %, Kt +50 %",
        start={"inertia": 0.9e-4, "torque_constant": 0.0825},
        thesis={},
        viscous=0.0,
    ),
    Case(
        label="J +50 %, Kt +50 %",
        start={"inertia": 2.7e-4, "torque_constant": 0.0825},
        thesis={},
        viscous=0.0,
    ),
]
RULE = Thesis(fraction=0.01, maxima="pre-pass-then-running", shared=False)


def run(settings: Settings) -> Outcome:
    """Trains with the thesis's rule, compares the rules, and finds the parameters in five cycles."""
    cycles = settings.pick(50, 3)
    rows, runs = [], {}
    for case in CASES:
        new, training = as_printed("Table 17", case, RULE, cycles)
        rows += new
        runs[case.label] = (case, training)
    settings.progress(0.3)
    for case in [*CASES, *BEYOND]:
        rows += better("Table 17", case, wanted=1e-3, recursive=RecursiveGaussNewton(cycles=5))
    settings.progress(0.6)
    rows += compare_methods("Table 17", [*CASES, *BEYOND], settings.pick(50, 3))
    u, y = CASES[0].recording()
    signal = Figure(number=84, title="Training signal", panels=[signal_panel(u, y)])
    drawn = figures((85, 86, 87), runs, "frictionless motor", RULE)
    return Outcome(rows=rows, figures=[signal, *drawn])


EXPERIMENT = Experiment(
    name="frictionless", title="Table 17: motor without friction", run=run, tables=(17,), figures=(84, 85, 86, 87)
)
