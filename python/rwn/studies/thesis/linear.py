"""What the experiments on the linear parameters share (Tables 17-19): one case, trained by several rules."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import rwn
from rwn.networks.arrays import Array
from rwn.networks.rates import RateRule, Thesis
from rwn.networks.trainers import RecursiveGaussNewton, StructuredLevenbergMarquardt
from rwn.studies.thesis.drive import MOTOR, SAMPLES, chirp, error_percent, linear_network
from rwn.studies.thesis.experiment import Curve, Figure, Panel, Row, curve
from rwn.studies.thesis.within_cycle import first_cycle_panel

GROUPS = {"viscous_friction": "v1", "inertia": "v2", "torque_constant": "v3"}
SYMBOLS = {"viscous_friction": "B", "inertia": "J", "torque_constant": "Kt"}


@dataclass(frozen=True, kw_only=True)
class Case:
    """A start: the wrong values by motor parameter, the thesis's final errors [%], the true B, the voltage."""

    label: str
    start: dict[str, float]
    thesis: dict[str, float | None]
    viscous: float = MOTOR.viscous_friction
    volts: float = 1.0

    @property
    def learn(self) -> tuple[str, ...]:
        """Groups that learn."""
        return tuple(GROUPS[name] for name in self.start)

    def network(self) -> rwn.StructuredNetwork:
        """The wrong network."""
        return linear_network(**{"viscous_friction": self.viscous, **self.start})

    def recording(self) -> tuple[Array, Array]:
        """Voltage (chirp 0-4 Hz, 1 s, of `volts`) and speed of the true motor."""
        u = chirp(self.volts, 0.0, 4.0)
        return u, linear_network(viscous_friction=self.viscous).simulate(u, 0 * u)

    def errors(self, network: rwn.StructuredNetwork) -> dict[str, float]:
        """Error of every parameter that learns [%]."""
        return {name: error_percent(network, name) for name in self.start}


def thesis_rule(fraction: float) -> Thesis:
    """As the thesis has it: running maxima, every group at the whole fraction of its own bound."""
    return Thesis(fraction=fraction, shared=False)


def as_printed(
    where: str, case: Case, rule: RateRule, cycles: int
) -> tuple[list[Row], rwn.OnlineTraining[rwn.StructuredNetwork]]:
    """Rows of one case trained with the thesis's rule."""
    u, y = case.recording()
    run = rwn.train_structured(case.network(), u, y, learn=case.learn, rates=rule, cycles=cycles)
    failed = run.status in ("diverged", "unstable")
    rows = [
        Row(
            where=where,
            case=f"{case.label}, {SYMBOLS[name]}",
            thesis=case.thesis.get(name),
            ours=None if failed else error,
            count=f"{cycles} cycles; {run.status}",
            judge="percentage-point" if case.thesis.get(name) is not None else "none",
            answer=case.thesis.get(name) is not None,
            group=where,
            unit="%",
        )
        for name, error in case.errors(run.network).items()
    ]
    return rows, run


def better(where: str, case: Case, *, wanted: float, recursive: RecursiveGaussNewton) -> list[Row]:
    """Rows of the recursive Gauss-Newton trainer, and of batch Levenberg-Marquardt."""
    u, y = case.recording()
    online = recursive.train(case.network(), u, y, learn=case.learn)
    batch = StructuredLevenbergMarquardt(gauge=False, iterations=100).fit(
        case.network(), u, y, learn=case.learn
    )
    found = {
        f"recursive Gauss-Newton, {recursive.cycles} cycles": online.network,
        f"Levenberg-Marquardt, {len(batch.mse) - 1} iterations": batch.network,
    }
    return [
        Row(
            where=where,
            case=f"{case.label}, {how.split(',')[0]}",
            ours=max(abs(e) for e in case.errors(network).values()),
            count=how.split(", ")[1],
            judge="wanted",
            wanted=wanted,
            unit="%",
        )
        for how, network in found.items()
    ]


def first_rates(case: Case, rule: Thesis, samples: int) -> Array:
    """Rates after so many samples of the first cycle."""
    u, y = (signal[:samples] for signal in case.recording())
    return rwn.train_structured(case.network(), u, y, learn=case.learn, rates=rule).rates


def figures(
    numbers: tuple[int, int, int],
    runs: dict[str, tuple[Case, rwn.OnlineTraining[rwn.StructuredNetwork]]],
    what: str,
    rule: Thesis,
) -> list[Figure]:
    """MSE, rates (over the first cycle too, if the rule moves them) and parameters by cycle."""
    mse = [curve(run.mse_learning, label=label) for label, (_, run) in runs.items()]
    rate_panels, value_panels = [], []
    for label, (case, run) in runs.items():
        index = {name: int(GROUPS[name][1]) - 1 for name in case.start}
        rates = [curve(run.rates[:, k], label=f"mu {SYMBOLS[name]}") for name, k in index.items()]
        if rule.maxima == "running":
            groups = {SYMBOLS[name]: k for name, k in index.items()}
            rate_panels.append(first_cycle_panel(partial(first_rates, case, rule), SAMPLES, groups, label))
        title = f"{label}, end of each cycle"
        rate_panels.append(Panel(xlabel="cycle", ylabel="rate", title=title, curves=rates, log_y=True))
        true = linear_network(viscous_friction=case.viscous).v
        values: list[Curve] = []
        for name, k in index.items():
            ratio = true[k] / run.linear[:, k] if k == 1 else run.linear[:, k] / true[k]
            values.append(curve(100 * (ratio - 1), label=SYMBOLS[name]))
        ends = {SYMBOLS[name]: value for name, value in case.thesis.items() if value is not None}
        value_panels.append(
            Panel(xlabel="cycle", ylabel="error [%]", title=label, curves=values, thesis=ends)
        )
    panel = Panel(xlabel="cycle", ylabel="MSE while learning [rad2/s2]", curves=mse, log_y=True)
    return [
        Figure(number=numbers[0], title=f"MSE, {what}", panels=[panel]),
        Figure(number=numbers[1], title=f"Learning rates, {what}", panels=rate_panels),
        Figure(number=numbers[2], title=f"Convergence, {what}", panels=value_panels),
    ]
