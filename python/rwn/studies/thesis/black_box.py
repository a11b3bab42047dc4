"""Sections 3.5.1 and 3.5.2, figures 44-54: the motor as a black box, inputs from the bilinear and the Euler
rule.

Open in the thesis, and chosen here: Coulomb friction 0.044 N m without stiction and B = 0.06 ("viscous
and Coulomb"); T = 0.1 ms; 3 wavelets over the range of every input, w uniform in [-1, 1], c = 0; a and b start
from least squares (from random a the Euler inputs never converge); running maxima at 0.2 of the bound of each
group by itself; an iteration is a cycle: all 10 000 from one seed or from as many as `--seeds` says, 300 from 20.
The thesis's errors are those met while learning, in the test too: with frozen weights they are a hundred times
larger and more. "Choices" shows them after fewer cycles, from a smaller start and at other fractions. The last
lines are the plain least-squares network (w = 0), and its free run, which the thesis does not give.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np

import rwn
from rwn.networks.arrays import Array
from rwn.studies.thesis.drive import MOTOR, SAMPLES, T, chirp, sine
from rwn.studies.thesis.experiment import (
    Experiment,
    Figure,
    Outcome,
    Panel,
    Row,
    Search,
    Settings,
    curve,
    median_row,
)
from rwn.studies.thesis.linear import thesis_rule
from rwn.studies.thesis.search import median, search
from rwn.studies.thesis.starts import in_words
from rwn.studies.thesis.within_cycle import SHAPES, first_cycle_panel, rates_figure

PAGES = {"bilinear": (6.4572e-6, 1.2912e-5), "euler": (6.8587e-6, 1.6747e-5)}
FRACTION, CYCLES = 0.2, 10_000
RULE = thesis_rule(FRACTION)
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


def least_squares(x: Array, y: Array, seed: int, size: float = 1.0) -> rwn.RecurrentNetwork:
    """a and b by least squares, 3 wavelets over every input's range, w uniform in [-size, size]."""
    solution = np.linalg.lstsq(np.column_stack([np.ones(len(x)), x]), y, rcond=None)[0]
    low, high = x.min(axis=0), x.max(axis=0)
    m = low + (high - low) * np.array([0.5, 0.25, 0.75])[:, None]
    d = np.tile(0.5 * (high - low), (3, 1))
    w = np.random.default_rng(seed).uniform(-size, size, 3)
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
class Data:
    """One set of inputs: the chirp that is learned from, and the sine that is tested on."""

    kind: str
    x: Array
    target: Array
    test_x: Array
    test: Array
    test_voltage: Array
    test_speed: Array


def data(kind: str) -> Data:
    """The thesis's signals."""
    u, test_u = chirp(12.0, 0.1, 4.0), sine(3.0, 1.0)
    test_y = speed_of(test_u)
    x, target = inputs(kind, u, speed_of(u))
    test_x, test = inputs(kind, test_u, test_y)
    return Data(
        kind=kind, x=x, target=target, test_x=test_x, test=test, test_voltage=test_u, test_speed=test_y
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class Trained:
    """One training, and its error on the test signal with learning on."""

    start: rwn.RecurrentNetwork
    training: rwn.OnlineTraining[rwn.RecurrentNetwork]
    tested: float


def learn(d: Data, cycles: int, seed: int, *, size: float = 1.0, fraction: float = FRACTION) -> Trained:
    """Trains with one set of inputs, from least squares on."""
    start, rule = least_squares(d.x, d.target, seed, size), thesis_rule(fraction)
    training = rwn.train_recurrent(start, d.x, d.target, rates=rule, cycles=cycles)
    going_on = rwn.train_recurrent(training.network, d.test_x, d.test, rates=rule, cycles=1)
    tested = np.inf if training.status == "diverged" else float(going_on.mse_learning[0])
    return Trained(start=start, training=training, tested=tested)


def without_wavelets(net: rwn.RecurrentNetwork) -> rwn.RecurrentNetwork:
    """Its linear part."""
    none = np.zeros((0, len(net.a)))
    return rwn.RecurrentNetwork(b=net.b, a=net.a, w=np.zeros(0), m=none, d=none, c=none)


def rows(d: Data, full: list[Trained], short: list[Trained]) -> list[Row]:
    """The thesis's numbers, and what plain least squares reaches."""
    trained, tested = PAGES[d.kind]
    number, _, test_number = FIGURES[d.kind]
    found = []
    for runs in (full, short):
        cycles = len(runs[0].training.mse_learning)
        count = in_words([r.training for r in runs])
        suffix = "" if runs is full else f", {cycles} cycles"
        for where, what, thesis, values in (
            (number, "trained, while learning", trained, [r.training.mse_learning[-1] for r in runs]),
            (number, "trained, frozen", None, [r.training.mse_frozen[-1] for r in runs]),
            (test_number, "tested, learning on", tested, [r.tested for r in runs]),
            (test_number, "tested, frozen", None, [r.training.network.mse(d.test_x, d.test) for r in runs]),
        ):
            answer = runs is full and thesis is not None
            found.append(
                median_row(
                    f"Figure {where}",
                    f"{d.kind}, {what}{suffix}",
                    thesis,
                    values,
                    count=count,
                    answer=answer,
                    judge="factor-2" if answer else "none",
                )
            )
    linear = without_wavelets(full[0].start)
    for what, ours, wanted in (
        ("frozen", linear.mse(d.test_x, d.test), 4e-9),
        ("free run", free_run(linear, d.kind, d.test_voltage, d.test_speed), None),
    ):
        judge: Literal["wanted", "none"] = "none" if wanted is None else "wanted"
        case = f"{d.kind}, least squares, {what}"
        place = f"Figure {test_number}"
        found.append(Row(where=place, case=case, ours=float(ours), judge=judge, wanted=wanted, count="one solve"))
    return found


def choice(size: float, fraction: float, cycles: int) -> str:
    """Its name in the search."""
    return f"w {size}, fraction {fraction}, {cycles} cycles"


def choices(d: Data, settings: Settings) -> Search:
    """Size of w, fraction and cycles."""
    trained, tested = PAGES[d.kind]

    def values(size: float, fraction: float, cycles: int, seeds: int) -> list[float | None]:
        runs = [learn(d, cycles, s, size=size, fraction=fraction) for s in range(seeds)]
        return [median([r.training.mse_learning[-1] for r in runs]), median([r.tested for r in runs])]

    tried = {
        choice(size, fraction, settings.pick(cycles, 1)): partial(
            values, size, fraction, settings.pick(cycles, 1), settings.pick(seeds, 1)
        )
        for size in (0.001, 1.0)
        for fraction in (0.05, FRACTION, 0.5, 0.95)
        for cycles, seeds in ((1, 10), (30, 10), (300, 10), (CYCLES, 1))
    }
    return search(
        f"Figures {FIGURES[d.kind][0]} and {FIGURES[d.kind][2]}, {d.kind}: size of w, fraction and cycles",
        {"trained, while learning": trained, "tested, learning on": tested},
        tried,
        taken=choice(1.0, FRACTION, settings.pick(CYCLES, 1)),
        count=f"{settings.pick(10, 1)} seeds, with most cycles one",
    )


def figures(d: Data, case: Trained) -> list[Figure]:
    """Error and rates while learning, and the test."""
    t = T * np.arange(2, SAMPLES)
    shown = [
        curve(d.test, t, label="motor", style="k-"),
        curve(case.training.network.simulate(d.test_x), t, label="network", style="--"),
    ]

    def first_rates(samples: int) -> Array:
        return rwn.train_recurrent(case.start, d.x[:samples], d.target[:samples], rates=RULE).rates

    first = first_cycle_panel(first_rates, len(d.target), SHAPES)
    number, rate_number, test_number = FIGURES[d.kind]
    ends, mse = {"after 10 000": PAGES[d.kind][0]}, [curve(case.training.mse_learning)]
    return [
        Figure(
            number=number,
            title=f"MSE, {d.kind}",
            panels=[Panel(xlabel="cycle", curves=mse, thesis=ends, log_x=True, log_y=True)],
        ),
        rates_figure(rate_number, f"Learning rates, {d.kind}", case.training, first),
        Figure(
            number=test_number,
            title=f"Test, {d.kind}, frozen weights",
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
    searches = []
    for k, kind in enumerate(PAGES):
        d = data(kind)
        full = [learn(d, settings.pick(CYCLES, 2), s) for s in range(settings.seeds)]
        settings.progress((2 * k + 1) / 4)
        short = [learn(d, settings.pick(300, 1), s) for s in range(settings.pick(20, 2))]
        all_rows += rows(d, full, short)
        all_figures += figures(d, full[0])
        searches.append(choices(d, settings))
        settings.progress((2 * k + 2) / 4)
    return Outcome(rows=all_rows, figures=all_figures, searches=searches)


EXPERIMENT = Experiment(
    name="black-box",
    title="Sections 3.5.1-3.5.2: black box",
    run=run,
    figures=(44, 46, 47, 49, 51, 52, 54),
    minutes=1.7,
    seed_minutes=0.2,
)
