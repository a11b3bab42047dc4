"""Where the learning-rate rules converge, stall or diverge (ours; beside sections 5.2 and 5.3).

Cases and excitation of Tables 17 and 18: for every fraction of the bound and every initial error of J
(the other parameter off by the same, the other way), 50 cycles of each rule; "converged" is within 1 %
at the end, "stalled" finite but not there. The guarded trainer begins with the fraction and steers it;
recursive Gauss-Newton has 5 cycles. Picture: log10 of the largest error at the end, in percent, cut to
[-6, 3]; diverged is 3.
"""

from __future__ import annotations

import numpy as np

import rwn
from rwn.networks.rates import ImpulseResponse, Normalised, RateRule, Thesis
from rwn.networks.trainers import GuardedDescent, RecursiveGaussNewton
from rwn.studies.thesis.drive import MOTOR
from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Panel, Row, Settings, Surface
from rwn.studies.thesis.linear import Case

FRACTIONS = [0.003, 0.01, 0.03, 0.1, 0.3, 0.95]
ERRORS = [-0.5, -0.2, -0.05, 0.05, 0.2, 0.5]
OTHER = {"frictionless": ("torque_constant", 0.0), "viscous": ("viscous_friction", MOTOR.viscous_friction)}


def rules(fraction: float) -> dict[str, tuple[RateRule, bool]]:
    """Rules at a fraction, and whether the state follows its parameters."""
    return {
        "thesis, running maxima": (Thesis(fraction=fraction, shared=False), False),
        "thesis, pre-pass": (Thesis(fraction=fraction, maxima="pre-pass", shared=False), False),
        "normalised, state follows": (Normalised(fraction=fraction), True),
    }


def case(kind: str, error: float) -> Case:
    """J off by `error`, the other parameter by as much the other way."""
    name, viscous = OTHER[kind]
    start = {"inertia": MOTOR.inertia * (1 + error), name: float(getattr(MOTOR, name)) * (1 - error)}
    return Case(label=f"{kind} {error:+.0%}", start=start, thesis={}, viscous=viscous)


def worst(one: Case, network: rwn.StructuredNetwork, failed: bool) -> float:
    """log10 of the largest error [%]."""
    largest = max(abs(e) for e in one.errors(network).values())
    return 3.0 if failed else float(np.clip(np.log10(max(largest, 1e-9)), -6, 3))


def trained(one: Case, rule: RateRule, follow: bool, cycles: int) -> float:
    """Error after training with a rule."""
    u, y = one.recording()
    run = rwn.train_structured(
        one.network(), u, y, learn=one.learn, rates=rule, cycles=cycles, follow_state=follow
    )
    return worst(one, run.network, run.status in ("diverged", "unstable"))


def guarded(one: Case, fraction: float, cycles: int) -> float:
    """Error after training with the guard; the fraction is the first one."""
    u, y = one.recording()
    trainer = GuardedDescent(rates=ImpulseResponse(fraction=fraction), cycles=cycles)
    return worst(one, trainer.train(one.network(), u, y, learn=one.learn).network, failed=False)


def recursive(one: Case) -> float:
    """Error after 5 cycles of recursive Gauss-Newton."""
    u, y = one.recording()
    fit = RecursiveGaussNewton(cycles=5).train(one.network(), u, y, learn=one.learn)
    return worst(one, fit.network, fit.training.status in ("diverged", "unstable"))


def run(settings: Settings) -> Outcome:
    """One map per rule and motor."""
    fractions, errors = FRACTIONS[:: settings.pick(1, 5)], ERRORS[:: settings.pick(1, 5)]
    cycles, rows, figures = settings.pick(50, 2), [], []
    for kind in OTHER:
        maps = {
            name: [[trained(case(kind, e), *rules(f)[name], cycles) for e in errors] for f in fractions]
            for name in rules(0.1)
        }
        maps["guarded, impulse response"] = [
            [guarded(case(kind, e), f, cycles) for e in errors] for f in fractions
        ]
        maps["recursive Gauss-Newton"] = [[recursive(case(kind, e)) for e in errors]] * len(fractions)
        panels = [
            Panel(
                xlabel="initial error of J",
                ylabel="log10 fraction",
                title=name,
                surface=Surface(
                    x=errors,
                    y=np.log10(fractions).tolist(),
                    z=z,
                    flat=True,
                    label="log10 error [%]",
                    limits=(-6.0, 3.0),
                ),
            )
            for name, z in maps.items()
        ]
        title = f"Convergence of the learning-rate rules, {kind} motor"
        figures.append(Figure(number=None, name=f"convergence_{kind}", title=title, panels=panels))
        for name, z in maps.items():
            share = float(np.mean(np.array(z) < 0))
            rows.append(
                Row(
                    where="Convergence",
                    case=f"{kind}: share of starts and fractions within 1 %, {name}",
                    ours=share,
                    judge="none",
                    count=f"{len(fractions)} x {len(errors)}, {cycles} cycles",
                )
            )
        settings.progress(0.5 if kind == "frictionless" else 1.0)
    return Outcome(rows=rows, figures=figures)


EXPERIMENT = Experiment(
    name="convergence-map",
    title="Where the learning-rate rules converge",
    run=run,
    minutes=0.3,
)
