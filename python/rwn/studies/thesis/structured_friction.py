"""Tables 13-16, figures 74-82: the friction network learns while the linear parameters are known.

Open in the thesis, and chosen here: B is known too (with B to be learned by the network the rule
diverges); dyadic start over the speeds of the recording, w normal with deviation 1e-3, c = 0, 3 seeds;
running maxima at 0.1 of the bound of each group by itself; 10 000 cycles from 3 seeds, and with 15
wavelets the thesis's 100 000 from one (2 000 for the wavelets of Table 15); Morlet with omega0 = 5;
Table 16 is tested on a 0.75 V sine of 1 Hz. The batch fit starts from wavelets selected from a library
and is given at most 1 % of the thesis's cycles.
"""

from __future__ import annotations

import numpy as np

import rwn
from rwn.networks.arrays import Array
from rwn.networks.initialisation import StructuredSelection
from rwn.networks.trainers import StructuredLevenbergMarquardt
from rwn.studies.thesis.drive import MOTOR, chirp, coulomb, friction_network, linear_network, sine, speed_with_friction
from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Panel, Row, Settings, curve, median_row
from rwn.studies.thesis.linear import thesis_rule
from rwn.studies.thesis.within_cycle import first_cycle_panel

SIZES = {7: (8.3151e-5, 1.5425e-4), 15: (3.3040e-5, 5.4618e-5), 31: (1.4045e-5, 4.2923e-5)}
WAVELETS = {
    "gaussian-derivative": (3.1385e-5, 2.5062e-4),
    "mexican-hat": (4.8973e-4, 0.0027),
    "morlet": (21.0638, None),
}
LONG = 15  # wavelets of the training that has all cycles of the thesis
NETWORK = ("w", "m", "d", "c")
REASON = "with frozen weights; friction levels, start and fraction of the bound are not stated, and each moves it by 10"
Training = rwn.OnlineTraining[rwn.StructuredNetwork]


def train(
    wavelets: int, name: str, cycles: int, seed: int, u: Array, y: Array, samples: int | None = None
) -> Training:
    """One training with the thesis's rule, on all samples or on the first ones of every cycle."""
    start = friction_network(y, wavelets, seed=seed, wavelet=name)
    every = max(cycles // 40, 1)
    return rwn.train_structured(
        start,
        u[:samples],
        y[:samples],
        learn=NETWORK,
        rates=thesis_rule(0.1),
        cycles=cycles,
        frozen_every=every,
    )


def first_cycle(u: Array, y: Array) -> Panel:
    """Rates over the first cycle, 15 wavelets."""

    def rates(samples: int) -> Array:
        return train(15, "gaussian-derivative", 1, 0, u, y, samples).rates

    return first_cycle_panel(rates, len(y), {g: 5 + k for k, g in enumerate(NETWORK)})


def torque_panel(networks: dict[str, rwn.StructuredNetwork], y: Array) -> Panel:
    """Torque against speed, beside the true one."""
    w = np.linspace(float(y.min()), float(y.max()), 400)
    b = MOTOR.viscous_friction
    lines = [curve(coulomb(w) + b * w, w, label="true", style="k-")]
    lines += [curve(n.torque(w) + b * w, w, label=label, style="--") for label, n in networks.items()]
    return Panel(xlabel="speed [rad/s]", ylabel="torque [N m]", curves=lines)


def mse_panel(runs: dict[str, Training]) -> Panel:
    """Frozen error by cycle."""
    lines = [curve(r.mse_frozen, r.frozen_after, label=label) for label, r in runs.items()]
    return Panel(xlabel="cycle", ylabel="MSE, frozen weights [rad2/s2]", curves=lines, log_y=True)


def signal_panel(u: Array, y: Array) -> Panel:
    """Speed of a recording."""
    t = np.arange(len(y)) * 1e-4
    return Panel(
        xlabel="time [s]", ylabel="speed [rad/s]", curves=[curve(y, t), curve(u, t, label="voltage [V]")]
    )


def rows_of(
    tables: tuple[str, str],
    case: str,
    thesis: tuple[float, float | None],
    runs: list[Training],
    test: tuple[Array, Array],
    group: str = "",
) -> list[Row]:
    """Trained and tested error over the seeds."""
    count = f"{len(runs[0].mse_learning)} cycles, {len(runs)} seeds"
    rest = {"count": count, "reason": REASON}
    rows = [
        median_row(tables[0], case, thesis[0], [r.mse_frozen[-1] for r in runs], group=tables[0] + group, **rest),
        median_row(
            tables[0],
            f"{case}, while learning",
            thesis[0],
            [r.mse_learning[-1] for r in runs],
            group=f"{tables[0]} learning {group}",
            count=count,
            reason="the error while learning is a tracking error",
        ),
    ]
    tested = [r.network.mse(*test) for r in runs]
    judge = "factor-2" if thesis[1] is not None else "none"
    return [*rows, median_row(tables[1], case, thesis[1], tested, group=tables[1] + group, judge=judge, **rest)]


def batch_row(
    table: str,
    case: str,
    thesis: float,
    wavelets: int,
    u: Array,
    y: Array,
    test: tuple[Array, Array],
    iterations: int,
) -> Row:
    """Levenberg-Marquardt from selected wavelets, tested with frozen weights."""
    start = StructuredSelection().start(linear_network(), u, y, wavelets=wavelets)
    trainer = StructuredLevenbergMarquardt(gauge=False, iterations=iterations)
    fit = trainer.fit(start, u, y, learn=("w", "m", "d"))
    return Row(
        where=table,
        case=f"{case}, selection + Levenberg-Marquardt",
        ours=fit.network.mse(*test),
        judge="wanted",
        wanted=thesis / 10,
        count=f"{len(fit.mse) - 1} iterations",
    )


def run(settings: Settings) -> Outcome:
    """Sizes, then mother wavelets."""
    u, test_u = sine(1.0, 1.0), chirp(0.75, 0.1, 4.0)
    y, test = speed_with_friction(u), (test_u, speed_with_friction(test_u))
    seeds = range(settings.pick(3, 1))
    rows, first = [], {}
    for k, (wavelets, thesis) in enumerate(SIZES.items()):
        runs = [train(wavelets, "gaussian-derivative", settings.pick(10_000, 20), s, u, y) for s in seeds]
        tables = ("Table 13", "Table 14")
        rows += rows_of(tables, f"Nw {wavelets}", thesis, runs, test)
        if wavelets == LONG:
            runs = [train(wavelets, "gaussian-derivative", settings.pick(100_000, 20), 0, u, y)]
            rows += rows_of(tables, f"Nw {wavelets}, all cycles", thesis, runs, test, group="all")
        rows.append(
            batch_row("Table 14", f"Nw {wavelets}", thesis[1], wavelets, u, y, test, settings.pick(200, 5))
        )
        first[f"Nw {wavelets}"] = runs[0]
        settings.progress(0.2 * (k + 1))
    other_u = sine(0.75, 1.0)
    other = (other_u, speed_with_friction(other_u))
    by_wavelet = {}
    for name, expected in WAVELETS.items():
        runs = [train(15, name, settings.pick(2_000, 10), s, u, y) for s in seeds]
        rows += rows_of(("Table 15", "Table 16"), name, expected, runs, other)
        by_wavelet[name] = runs[0]
    shown = {label: r.network for label, r in first.items()}
    rates = [curve(first["Nw 15"].rates[:, 5 + k], label=f"mu {g}") for k, g in enumerate(NETWORK)]
    by_cycle = Panel(xlabel="cycle", ylabel="rate", title="end of each cycle", curves=rates, log_y=True)
    figures = [
        Figure(number=74, title="Training signal", panels=[signal_panel(u, y)]),
        Figure(number=75, title="MSE by size", panels=[mse_panel(first)]),
        Figure(number=76, title="Learning rates, Nw 15", panels=[first_cycle(u, y), by_cycle]),
        Figure(number=77, title="Testing signal", panels=[signal_panel(*test)]),
        Figure(number=78, title="Torque against speed by size", panels=[torque_panel(shown, y)]),
        Figure(number=79, title="Training signal", panels=[signal_panel(u, y)]),
        Figure(number=80, title="MSE by wavelet", panels=[mse_panel(by_wavelet)]),
        Figure(number=81, title="Testing signal", panels=[signal_panel(*other)]),
        Figure(
            number=82,
            title="Torque against speed by wavelet",
            panels=[
                torque_panel({label: r.network for label, r in by_wavelet.items() if label != "morlet"}, y)
            ],
        ),
    ]
    return Outcome(rows=rows, figures=figures)


EXPERIMENT = Experiment(
    name="structured-friction",
    title="Tables 13-16: friction learned in the structured network",
    run=run,
    tables=(13, 14, 15, 16),
    figures=(74, 75, 76, 77, 78, 79, 80, 81, 82),
)
