"""Tables 13-16, figures 74-82: the friction network learns while the linear parameters are known.

Open in the thesis, and chosen here: B is known too (with B to be learned by the network the rule diverges);
dyadic start over the speeds of the recording, w uniform in [-0.1, 0.1] as in chapter 2, c = 0; running maxima at
0.1 of the bound of each group by itself; the thesis's 100 000 cycles from one seed or from as many as `--seeds`
says, and 500 from 20; Morlet with omega0 = 5; Table 16 is tested on a 0.75 V sine of 1 Hz. The error "after
training" is taken as the one met in the last cycle, as in Table 11; the one with frozen weights stands beside it.
The batch fit starts from wavelets selected from a library and is given at most 1 % of the thesis's cycles.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import rwn
from rwn.networks.arrays import Array
from rwn.networks.initialisation import StructuredSelection
from rwn.networks.trainers import StructuredLevenbergMarquardt
from rwn.studies.thesis.drive import FRICTION, MOTOR, chirp, friction_network, linear_network, sine, speed_with_friction
from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Panel, Row, Settings, curve, median_row
from rwn.studies.thesis.linear import thesis_rule
from rwn.studies.thesis.panels import signal_panel
from rwn.studies.thesis.starts import from_starts, in_words
from rwn.studies.thesis.within_cycle import first_cycle_panel

SIZES = {7: (8.3151e-5, 1.5425e-4), 15: (3.3040e-5, 5.4618e-5), 31: (1.4045e-5, 4.2923e-5)}
WAVELETS = {
    "gaussian-derivative": (3.1385e-5, 2.5062e-4),
    "mexican-hat": (4.8973e-4, 0.0027),
    "morlet": (21.0638, None),
}
GAUSSIAN = "gaussian-derivative"
NETWORK = ("w", "m", "d", "c")
FRACTION = 0.1
Training = rwn.OnlineTraining[rwn.StructuredNetwork]
Signals = tuple[Array, Array]  # voltage, speed


def train(
    wavelets: int, name: str, cycles: int, seed: int, signals: Signals, samples: int | None = None
) -> Training:
    """One training with the thesis's rule, on all samples or on the first ones of every cycle."""
    u, y = signals
    return rwn.train_structured(
        friction_network(y, wavelets, seed=seed, wavelet=rwn.Wavelet(name)),
        u[:samples],
        y[:samples],
        learn=NETWORK,
        rates=thesis_rule(FRACTION),
        cycles=cycles,
        frozen_every=max(cycles // 40, 1),
    )


def first_cycle(signals: Signals) -> Panel:
    """Rates over the first cycle, 15 wavelets."""

    def rates(samples: int) -> Array:
        return train(15, GAUSSIAN, 1, 0, signals, samples).rates

    return first_cycle_panel(rates, len(signals[1]), {g: 5 + k for k, g in enumerate(NETWORK)})


def torque_panels(networks: dict[str, rwn.StructuredNetwork], y: Array) -> list[Panel]:
    """Torque against speed beside the true one, and the error of each."""
    w = np.linspace(float(y.min()), float(y.max()), 400)
    b = MOTOR.viscous_friction
    true = FRICTION.torque(w) + b * w
    learned = {label: n.torque(w) + b * w for label, n in networks.items()}
    lines = [curve(true, w, label="true", style="k-")]
    lines += [curve(torque, w, label=label, style="--") for label, torque in learned.items()]
    errors = [curve(np.abs(torque - true), w, label=label) for label, torque in learned.items()]
    return [
        Panel(xlabel="speed [rad/s]", ylabel="torque [N m]", curves=lines),
        Panel(xlabel="speed [rad/s]", ylabel="error of the torque [N m]", curves=errors, log_y=True),
    ]


def mse_panel(runs: dict[str, Training], thesis: dict[str, float]) -> Panel:
    """Error by cycle, met while learning and with frozen weights, beside the thesis's last values."""
    lines = [curve(r.mse_learning, label=label) for label, r in runs.items()]
    lines += [
        curve(r.mse_frozen[1:], r.frozen_after[1:], label=f"{label}, frozen", style=":") for label, r in runs.items()
    ]
    return Panel(xlabel="cycle", ylabel="MSE [rad2/s2]", curves=lines, thesis=thesis, log_x=True, log_y=True)


def rows_of(
    tables: tuple[str, str],
    case: str,
    thesis: tuple[float, float | None],
    runs: list[Training],
    test: Signals,
    *,
    answer: bool,
) -> list[Row]:
    """Trained and tested errors over the seeds; with `answer` they speak for the thesis's numbers."""
    cycles = len(runs[0].mse_learning)
    count = in_words(runs)
    suffix = "" if answer else f", {cycles} cycles"
    found = (
        (tables[0], "while learning", thesis[0], [r.mse_learning[-1] for r in runs]),
        (tables[0], "frozen", None, [r.mse_frozen[-1] for r in runs]),
        (tables[1], "tested, frozen", thesis[1], [r.network.mse(*test) for r in runs]),
    )
    return [
        median_row(
            table,
            f"{case}, {what}{suffix}",
            number,
            values,
            count=count,
            answer=answer and number is not None,
            judge="factor-2" if answer and number is not None else "none",
            group=table if answer and number is not None else "",
        )
        for table, what, number, values in found
    ]


@dataclass(frozen=True, eq=False, kw_only=True)
class Runs:
    """One size and wavelet: all cycles from the seeds of the settings, few from twenty."""

    full: list[Training]
    short: list[Training]

    @classmethod
    def of(
        cls, wavelets: int, name: str, signals: Signals, settings: Settings, share: tuple[float, float]
    ) -> Runs:
        """Trains them; `share` of the progress before and after."""
        cycles = settings.pick(100_000, 20)
        full = from_starts(lambda seed: train(wavelets, name, cycles, seed, signals), settings, *share)
        short = [
            train(wavelets, name, settings.pick(500, 5), s, signals) for s in range(settings.pick(20, 1))
        ]
        return cls(full=full, short=short)

    def rows(
        self, tables: tuple[str, str], case: str, thesis: tuple[float, float | None], test: Signals
    ) -> list[Row]:
        """The full run speaks for the thesis's numbers, the seeds stand beside it."""
        found = rows_of(tables, case, thesis, self.full, test, answer=True)
        return found + rows_of(tables, case, thesis, self.short, test, answer=False)


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
    rows: list[Row] = []
    by_size: dict[int, Runs] = {}
    for k, (wavelets, thesis) in enumerate(SIZES.items()):
        by_size[wavelets] = Runs.of(wavelets, GAUSSIAN, (u, y), settings, (k / 5, (k + 1) / 5))
        case = f"Nw {wavelets}"
        rows += by_size[wavelets].rows(("Table 13", "Table 14"), case, thesis, test)
        rows.append(batch_row("Table 14", case, thesis[1], wavelets, u, y, test, settings.pick(200, 5)))
    other_u = sine(0.75, 1.0)
    other = (other_u, speed_with_friction(other_u))
    by_wavelet = {GAUSSIAN: by_size[15]}  # the same network, tested on another signal
    for k, (name, expected) in enumerate(WAVELETS.items()):
        if name not in by_wavelet:
            by_wavelet[name] = Runs.of(15, name, (u, y), settings, ((k + 2) / 5, (k + 3) / 5))
        rows += by_wavelet[name].rows(("Table 15", "Table 16"), name, expected, other)
    first = {f"Nw {wavelets}": runs.full[0] for wavelets, runs in by_size.items()}
    second = {name: runs.full[0] for name, runs in by_wavelet.items()}
    return Outcome(rows=rows, figures=figures(first, second, (u, y), test, other))


def figures(
    first: dict[str, Training], by_wavelet: dict[str, Training], signals: Signals, test: Signals, other: Signals
) -> list[Figure]:
    """Figures 74 to 82."""
    shown = {label: r.network for label, r in first.items()}
    rates = [curve(first["Nw 15"].rates[:, 5 + k], label=f"mu {g}") for k, g in enumerate(NETWORK)]
    by_cycle = Panel(xlabel="cycle", ylabel="rate", title="end of each cycle", curves=rates, log_y=True)
    sizes = {f"Nw {n}": trained for n, (trained, _) in SIZES.items()}
    wavelets = {name: trained for name, (trained, _) in WAVELETS.items()}
    near = {label: r.network for label, r in by_wavelet.items() if label != "morlet"}
    y = signals[1]
    return [
        Figure(number=74, title="Training signal", panels=[signal_panel(*signals)]),
        Figure(number=75, title="MSE by size", panels=[mse_panel(first, sizes)]),
        Figure(number=76, title="Learning rates, Nw 15", panels=[first_cycle(signals), by_cycle]),
        Figure(number=77, title="Testing signal", panels=[signal_panel(*test)]),
        Figure(number=78, title="Torque against speed by size", panels=torque_panels(shown, y)),
        Figure(number=79, title="Training signal", panels=[signal_panel(*signals)]),
        Figure(number=80, title="MSE by wavelet", panels=[mse_panel(by_wavelet, wavelets)]),
        Figure(number=81, title="Testing signal", panels=[signal_panel(*other)]),
        Figure(number=82, title="Torque against speed by wavelet", panels=torque_panels(near, y)),
    ]


EXPERIMENT = Experiment(
    name="structured-friction",
    title="Tables 13-16: friction learned in the structured network",
    run=run,
    tables=(13, 14, 15, 16),
    figures=(74, 75, 76, 77, 78, 79, 80, 81, 82),
    minutes=4.0,
    seed_minutes=3.0,
)
