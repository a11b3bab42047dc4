"""Sections 3.5.1 and 3.5.2, figures 44-54: the motor as a black box, inputs from the bilinear and the Euler
rule.

Open in the thesis, and chosen here: Coulomb friction 0.044 N m without stiction and B = 0.06 ("viscous
and Coulomb"); T = 0.1 ms; 3 wavelets over the range of every input, w small random, c = 0; a and b start
from least squares (from random a the Euler inputs never converge); running maxima at 0.05 of the bound
of each group by itself; all 10 000 cycles. The wanted line is the plain least-squares network (w =
0), and its free run, which the thesis does not give.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

import rwn
from rwn.networks.arrays import Array
from rwn.studies.thesis.drive import MOTOR, SAMPLES, T, chirp, sine
from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Panel, Row, Settings, curve
from rwn.studies.thesis.linear import thesis_rule
from rwn.studies.thesis.within_cycle import SHAPES, first_cycle_panel, rates_figure

PAGES = {"bilinear": (6.4572e-6, 1.2912e-5), "euler": (6.8587e-6, 1.6747e-5)}
RULE = thesis_rule(0.05)
FIGURES = {"bilinear": (46, 47, 49), "euler": (51, 52, 54)}


def friction(speed: float) -> float:
    """Coulomb and viscous friction [N m]."""
    return float(0.044 * np.tanh(10 * speed) + MOTOR.viscous_friction * speed)


def speed_of(voltage: Array) -> Array:
    """Speed [rad/s] by Euler's rule."""
    out, speed, current = np.empty(len(voltage)), 0.0, 0.0
    for n, volts in enumerate(voltage):
        out[n] = speed
        torque = MOTOR.torque_constant * current - friction(speed)
        current += T / MOTOR.inductance * (volts - MOTOR.resistance * current - MOTOR.torque_constant * speed)
        speed += T / MOTOR.inertia * torque
    return out


def inputs(kind: str, u: Array, y: Array) -> tuple[Array, Array]:
    """Inputs (3.95) or (3.98) and output from the third sample on."""
    past = [u[:-2], y[1:-1], y[:-2]]
    return np.column_stack([u[2:], u[1:-1], *past] if kind == "bilinear" else past), y[2:]


def least_squares(x: Array, y: Array, seed: int) -> rwn.RecurrentNetwork:
    """a and b by least squares, 3 wavelets over every input's range."""
    solution = np.linalg.lstsq(np.column_stack([np.ones(len(x)), x]), y, rcond=None)[0]
    low, high = x.min(axis=0), x.max(axis=0)
    m = low + (high - low) * np.array([0.5, 0.25, 0.75])[:, None]
    d = np.tile(0.5 * (high - low), (3, 1))
    w = np.random.default_rng(seed).normal(0, 1e-3, 3)
    return rwn.RecurrentNetwork(
        b=float(solution[0]), a=np.asarray(solution[1:], dtype=np.float64), w=w, m=m, d=d, c=0 * d
    )


def free_run(net: rwn.RecurrentNetwork, kind: str, u: Array, y: Array) -> float:
    """MSE when the linear part runs on its own past outputs."""
    out = y.copy()
    for n in range(2, len(u)):
        past = [u[n - 2], out[n - 1], out[n - 2]]
        row = np.array([u[n], u[n - 1], *past] if kind == "bilinear" else past)
        out[n] = net.b + float(net.a @ row)
    return float(np.mean((out - y) ** 2))


@dataclass(frozen=True, eq=False, kw_only=True)
class Trained:
    """One set of inputs: what was learned from the chirp, and the sine that it is tested on."""

    kind: str
    cycles: int
    x: Array
    target: Array
    test_x: Array
    test: Array
    test_voltage: Array
    test_speed: Array
    start: rwn.RecurrentNetwork
    training: rwn.OnlineTraining[rwn.RecurrentNetwork]


def learn(kind: str, cycles: int) -> Trained:
    """Trains with one set of inputs, from least squares on."""
    u, test_u = chirp(12.0, 0.1, 4.0), sine(3.0, 1.0)
    y, test_y = speed_of(u), speed_of(test_u)
    x, target = inputs(kind, u, y)
    test_x, test = inputs(kind, test_u, test_y)
    start = least_squares(x, target, 0)
    return Trained(
        kind=kind,
        cycles=cycles,
        x=x,
        target=target,
        test_x=test_x,
        test=test,
        test_voltage=test_u,
        test_speed=test_y,
        start=start,
        training=rwn.train_recurrent(start, x, target, rates=RULE, cycles=cycles),
    )


def without_wavelets(net: rwn.RecurrentNetwork) -> rwn.RecurrentNetwork:
    """Its linear part."""
    none = np.zeros((0, len(net.a)))
    return rwn.RecurrentNetwork(b=net.b, a=net.a, w=np.zeros(0), m=none, d=none, c=none)


def rows(case: Trained) -> list[Row]:
    """The thesis's numbers, and what plain least squares reaches."""
    run, net = case.training, case.training.network
    linear = without_wavelets(case.start)
    going_on = rwn.train_recurrent(net, case.test_x, case.test, rates=RULE, cycles=1)
    trained, tested = PAGES[case.kind]
    number, _, test_number = FIGURES[case.kind]

    def row(number: int, what: str, thesis: float, ours: float) -> Row:
        return Row(
            where=f"Figure {number}",
            case=f"{case.kind}, {what}",
            thesis=thesis,
            ours=float(ours),
            count=f"{case.cycles} cycles; {run.status}",
            reason="the thesis's numbers are tracking errors",
        )

    def plain(what: str, ours: float, wanted: float | None) -> Row:
        judge: Literal["wanted", "none"] = "none" if wanted is None else "wanted"
        return Row(
            where=f"Figure {test_number}",
            case=f"{case.kind}, least squares, {what}",
            ours=float(ours),
            judge=judge,
            wanted=wanted,
            count="one solve",
        )

    return [
        row(number, "trained, while learning", trained, run.mse_learning[-1]),
        row(number, "trained, frozen", trained, run.mse_frozen[-1]),
        row(test_number, "tested, learning on", tested, going_on.mse_learning[0]),
        row(test_number, "tested, frozen", tested, net.mse(case.test_x, case.test)),
        plain("frozen", linear.mse(case.test_x, case.test), 4e-9),
        plain("free run", free_run(linear, case.kind, case.test_voltage, case.test_speed), None),
    ]


def figures(case: Trained) -> list[Figure]:
    """Error and rates while learning, and the test."""
    t = T * np.arange(2, SAMPLES)
    shown = [
        curve(case.test, t, label="motor", style="k-"),
        curve(case.training.network.simulate(case.test_x), t, label="network", style="--"),
    ]

    def first_rates(samples: int) -> Array:
        return rwn.train_recurrent(case.start, case.x[:samples], case.target[:samples], rates=RULE).rates

    first = first_cycle_panel(first_rates, len(case.target), SHAPES)
    number, rate_number, test_number = FIGURES[case.kind]
    return [
        Figure(
            number=number,
            title=f"MSE, {case.kind}",
            panels=[Panel(xlabel="cycle", curves=[curve(case.training.mse_learning)], log_y=True)],
        ),
        rates_figure(rate_number, f"Learning rates, {case.kind}", case.training, first),
        Figure(
            number=test_number,
            title=f"Test, {case.kind}, frozen weights",
            panels=[Panel(xlabel="time [s]", ylabel="speed [rad/s]", curves=shown)],
        ),
    ]


def run(settings: Settings) -> Outcome:
    """Both sets of inputs."""
    speed = np.linspace(-80, 80, 401)
    level = curve([friction(w) for w in speed], speed)
    all_rows: list[Row] = []
    all_figures = [
        Figure(
            number=44,
            title="Friction",
            panels=[Panel(xlabel="speed [rad/s]", ylabel="torque [N m]", curves=[level])],
        )
    ]
    for k, kind in enumerate(PAGES):
        case = learn(kind, settings.pick(10_000, 2))
        all_rows += rows(case)
        all_figures += figures(case)
        settings.progress((k + 1) / 2)
    return Outcome(rows=all_rows, figures=all_figures)


EXPERIMENT = Experiment(
    name="black-box", title="Sections 3.5.1-3.5.2: black box", run=run, figures=(44, 46, 47, 49, 51, 52, 54)
)
