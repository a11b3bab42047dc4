"""The thesis's own algorithm on its future work (section 6.2, ours): with noise, and with the rates of Appendix E.

Chosen here: white noise on the speed at the stated signal-to-noise ratio [dB], one draw for all cycles as a
recording has it; the starts of case 1 of Tables 17 and 18 with the rule of each; for Appendix E a 12 V chirp
0.1-60 Hz and R, L (and J) 20 % off, Kt and B known, since R, L, Kt, J and B scaled together leave the speed as it
is. The rule of Appendix E has the largest fraction of 0.001 to 0.5 (maxima of a pass, then running) that has not
diverged after 500 cycles without noise. The number is the largest relative error of a parameter, median over
seeds. Recursive Gauss-Newton has 5 cycles, Levenberg-Marquardt comes to rest. Time is processor time of one run on
this machine.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import rwn
from rwn.networks.arrays import Array
from rwn.networks.rates import Thesis
from rwn.networks.trainers import RecursiveGaussNewton, StructuredLevenbergMarquardt
from rwn.studies.thesis import frictionless, viscous
from rwn.studies.thesis.drive import chirp, linear_network
from rwn.studies.thesis.experiment import Experiment, Outcome, Row, Settings, median_row
from rwn.studies.thesis.linear import Case, thesis_rule
from rwn.studies.thesis.noisy import noisy

RATIOS = (None, 60.0, 40.0, 20.0)  # signal to noise [dB]; None: no noise
FRACTIONS = (0.5, 0.1, 0.03, 0.01, 0.003, 0.001)


@dataclass(frozen=True, eq=False, kw_only=True)
class Problem:
    """A start, the truth, what learns and from what."""

    label: str
    start: rwn.StructuredNetwork
    true: rwn.StructuredNetwork
    learn: tuple[str, ...]
    voltage: Array
    rule: Thesis
    cycles: int

    def speed(self, decibel: float | None, seed: int) -> Array:
        """The recorded speed [rad/s]."""
        clean = self.true.simulate(self.voltage, 0 * self.voltage)
        return clean if decibel is None else noisy(clean, decibel, np.random.default_rng(seed))[0]

    def error(self, network: rwn.StructuredNetwork) -> float:
        """Largest relative error of what learns [%]: of 1 - v5 = R T/L for v5."""
        index = [int(group[1]) - 1 for group in self.learn]
        got, true = (np.append(n.v[:4], 1 - n.v[4])[index] for n in (network, self.true))
        return 100 * float(np.max(np.abs(got / true - 1)))


Method = Callable[[Problem, Array], tuple[rwn.StructuredNetwork, bool]]  # network, diverged


def online(problem: Problem, speed: Array) -> tuple[rwn.StructuredNetwork, bool]:
    """The thesis's algorithm."""
    run = rwn.train_structured(
        problem.start, problem.voltage, speed, learn=problem.learn, rates=problem.rule, cycles=problem.cycles
    )
    return run.network, run.status in ("diverged", "unstable")


def recursive(problem: Problem, speed: Array) -> tuple[rwn.StructuredNetwork, bool]:
    """Recursive Gauss-Newton."""
    fit = RecursiveGaussNewton(cycles=5).train(problem.start, problem.voltage, speed, learn=problem.learn)
    return fit.network, fit.training.status in ("diverged", "unstable")


def batch(problem: Problem, speed: Array) -> tuple[rwn.StructuredNetwork, bool]:
    """Levenberg-Marquardt."""
    trainer = StructuredLevenbergMarquardt(gauge=False, iterations=100, tolerance=1e-8)
    return trainer.fit(problem.start, problem.voltage, speed, learn=problem.learn).network, False


METHODS: dict[str, Method] = {
    "the thesis's online rule": online,
    "recursive Gauss-Newton": recursive,
    "Levenberg-Marquardt": batch,
}


def of_table(where: str, case: Case, rule: Thesis, cycles: int) -> Problem:
    """A case of Tables 17 and 18."""
    voltage, _ = case.recording()
    true = linear_network(viscous_friction=case.viscous)
    return Problem(
        label=f"{where}, {case.label}",
        start=case.network(),
        true=true,
        learn=case.learn,
        voltage=voltage,
        rule=rule,
        cycles=cycles,
    )


def electrical(label: str, learn: tuple[str, ...], cycles: int) -> Problem:
    """R and L, and with v2 J, 20 % off; the largest fraction that works."""
    wrong = {"resistance": 0.48, "inductance": 0.64e-3} | ({"inertia": 2.16e-4} if "v2" in learn else {})
    voltage = chirp(12.0, 0.1, 60.0)

    def problem(fraction: float) -> Problem:
        rule = Thesis(fraction=fraction, maxima="pre-pass-then-running", shared=False)
        return Problem(
            label=label,
            start=linear_network(**wrong),
            true=linear_network(),
            learn=learn,
            voltage=voltage,
            rule=rule,
            cycles=cycles,
        )

    tried = [problem(fraction) for fraction in FRACTIONS]
    return next((p for p in tried if not online(p, p.speed(None, 0))[1]), tried[-1])


def rows_of(problem: Problem, seeds: int) -> list[Row]:
    """Every method at every ratio, and its time without noise."""
    rows = []
    for name, method in METHODS.items():
        for decibel in RATIOS:
            level = "no noise" if decibel is None else f"{decibel:.0f} dB"
            errors, begin = [], time.thread_time()
            draws = range(1 if decibel is None else seeds)
            for seed in draws:
                network, diverged = method(problem, problem.speed(decibel, seed))
                errors.append(np.inf if diverged else problem.error(network))
            seconds = (time.thread_time() - begin) / len(draws)
            case = f"{problem.label}, {level}, {name}"
            asked = f"{problem.cycles} cycles at {problem.rule.fraction}, " if method is online else ""
            count = f"{asked}{len(draws)} seeds"
            rows.append(median_row("Section 6.2", case, None, errors, judge="none", unit="%", count=count))
            if decibel is None:
                took = f"{problem.label}, time, {name}"
                rows.append(Row(where="Section 6.2", case=took, ours=seconds, judge="none", unit="s", count="1 run"))
    return rows


def run(settings: Settings) -> Outcome:
    """Four problems."""
    short, long, seeds = settings.pick(50, 2), settings.pick(500, 2), settings.pick(20, 1)
    problems = [
        of_table("Table 17", frictionless.CASES[0], frictionless.RULE, short),
        of_table("Table 18", viscous.CASES[0], thesis_rule(0.99), short),
        electrical("Appendix E, R and L", ("v4", "v5"), long),
        electrical("Appendix E, J, R and L", ("v2", "v4", "v5"), long),
    ]
    rows: list[Row] = []
    for k, problem in enumerate(problems):
        rows += rows_of(problem, seeds)
        settings.progress((k + 1) / len(problems))
    return Outcome(rows=rows)


EXPERIMENT = Experiment(
    name="online-beyond",
    title="Section 6.2: the thesis's algorithm with noise and with Appendix E",
    run=run,
    minutes=1.5,
)
