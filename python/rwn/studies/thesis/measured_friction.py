"""Tables 11-12, figures 56-64: a recurrent network learns a measured friction torque (3.5.3).

Open in the thesis, and chosen here: the levels of the friction; dyadic start over the speeds of the
recording, a, b by least squares, w normal with deviation 1e-3, c = 0, 3 seeds; running maxima at 0.002
of the bound of each group by itself: at larger fractions the bias follows the error sample by sample and
the frozen network is worthless; 1 000 cycles for 100 000. The better fit trains the static network, its
wavelets selected from a library, by variable projection on the same samples, in at most 1 % of the
thesis's cycles.
"""

from __future__ import annotations

import numpy as np

import rwn
from rwn.networks.arrays import Array
from rwn.networks.initialisation import Selection
from rwn.networks.online_training import OnlineTraining
from rwn.networks.trainers import VariableProjection
from rwn.studies.thesis.drive import MOTOR, chirp, coulomb, dyadic_shapes, sine, speed_with_friction
from rwn.studies.thesis.experiment import Curve, Experiment, Figure, Outcome, Panel, Row, Settings, curve, median_row
from rwn.studies.thesis.linear import thesis_rule
from rwn.studies.thesis.structured_friction import signal_panel
from rwn.studies.thesis.within_cycle import SHAPES, first_cycle_panel, rates_figure

Run = OnlineTraining[rwn.RecurrentNetwork]

SIZES = {3: (8.2753e-10, 1.3724e-4), 7: (2.7731e-10, 1.4662e-5), 15: (3.7961e-11, 4.9190e-7)}
REASON = "the thesis's training error is a tracking error; fewer cycles"


def torque(speed: Array) -> Array:
    """Whole friction torque (3.99) [N m]."""
    return np.asarray(coulomb(speed) + MOTOR.viscous_friction * speed, dtype=np.float64)


def start(speed: Array, wavelets: int, seed: int) -> rwn.RecurrentNetwork:
    """Least squares for a and b, dyadic wavelets, small w."""
    m, d = dyadic_shapes(float(speed.min()), float(speed.max()), wavelets)
    slope, offset = np.polyfit(speed, torque(speed), 1)
    w = np.random.default_rng(seed).normal(0, 1e-3, wavelets)
    column = np.s_[:, None]
    return rwn.RecurrentNetwork(b=offset, a=np.array([slope]), w=w, m=m[column], d=d[column], c=0 * m[column])


def static_fit(speed: Array, test: Array, wavelets: int, iterations: int) -> float:
    """Test MSE of a static network, selected and trained by variable projection."""
    first = Selection().start(rwn.Wavelet(), speed, torque(speed), wavelets=wavelets)
    fitted = VariableProjection(iterations=iterations).train(first, speed, torque(speed)).network
    return float(np.mean((np.ravel(fitted.output(test)) - torque(test)) ** 2))


def first_cycle(wavelets: int, speed: Array) -> Panel:
    """Rates over the first cycle."""

    def train(samples: int) -> Array:
        x = speed[:samples]
        rule = thesis_rule(0.002)
        return rwn.train_recurrent(start(speed, wavelets, 0), x, torque(x), rates=rule).rates

    return first_cycle_panel(train, len(speed), SHAPES)


def run(settings: Settings) -> Outcome:
    """Trains every size and tests it with frozen weights."""
    u, test_u = sine(1.0, 1.0), chirp(0.75, 0.1, 4.0)
    speed, test = speed_with_friction(u), speed_with_friction(test_u)
    rows: list[Row] = []
    runs: dict[int, Run] = {}
    for k, wavelets in enumerate(SIZES):
        found = trained_runs(speed, wavelets, settings)
        rows += size_rows(wavelets, found, speed, test, settings)
        runs[wavelets] = found[0]
        settings.progress((k + 1) / len(SIZES))
    return Outcome(rows=rows, figures=figures(runs, (u, speed), (test_u, test)))


def trained_runs(speed: Array, wavelets: int, settings: Settings) -> list[Run]:
    """Online runs of one size, one a seed."""
    cycles = settings.pick(1_000, 3)
    return [
        rwn.train_recurrent(
            start(speed, wavelets, seed),
            speed,
            torque(speed),
            rates=thesis_rule(0.002),
            cycles=cycles,
            frozen_every=max(cycles // 20, 1),
        )
        for seed in range(settings.pick(3, 1))
    ]


def size_rows(
    wavelets: int, found: list[Run], speed: Array, test: Array, settings: Settings
) -> list[Row]:
    """Tables 11 and 12 for one size."""
    trained, tested = SIZES[wavelets]
    case = f"Nw {wavelets}"
    rest = {"count": f"{settings.pick(1_000, 3)} cycles, {len(found)} seeds", "reason": REASON}
    learning, frozen = [r.mse_learning[-1] for r in found], [r.mse_frozen[-1] for r in found]
    on_test = [r.network.mse(test, torque(test)) for r in found]
    return [
        median_row("Table 11", f"{case}, while learning", trained, learning, group="learning", **rest),
        median_row("Table 11", f"{case}, frozen", trained, frozen, group="frozen", **rest),
        median_row("Table 12", case, tested, on_test, group="test", **rest),
        Row(
            where="Table 12",
            case=f"{case}, selection + variable projection",
            judge="wanted",
            wanted=tested / 10,
            ours=static_fit(speed, test, wavelets, settings.pick(200, 5)),
            count="at most 200 iterations",
        ),
    ]


def figures(
    runs: dict[int, Run], training: tuple[Array, Array], testing: tuple[Array, Array]
) -> list[Figure]:
    """Figures 56 to 64 from (input, speed) of the training and the test signal."""
    speed = training[1]
    w = np.linspace(float(speed.min()), float(speed.max()), 400)
    true = curve(torque(w), w, label="true", style="k-")
    learned = [curve(r.network.simulate(w), w, label=f"Nw {n}", style="--") for n, r in runs.items()]
    mse = [curve(r.mse_learning, label=f"Nw {n}") for n, r in runs.items()]

    def torques(*curves: Curve) -> list[Panel]:
        return [Panel(xlabel="speed [rad/s]", ylabel="torque [N m]", curves=list(curves))]

    by_cycle = Panel(xlabel="cycle", ylabel="MSE while learning", curves=mse, log_y=True)
    return [
        Figure(number=56, title="Friction", panels=torques(true)),
        Figure(number=58, title="Training signal", panels=[signal_panel(*training)]),
        Figure(number=59, title="MSE by size", panels=[by_cycle]),
        *(
            rates_figure(60 + k, f"Learning rates, Nw {n}", r, first_cycle(n, speed))
            for k, (n, r) in enumerate(runs.items())
        ),
        Figure(number=63, title="Testing signal", panels=[signal_panel(*testing)]),
        Figure(number=64, title="Torque against speed", panels=torques(true, *learned)),
    ]


EXPERIMENT = Experiment(
    name="measured-friction",
    title="Tables 11-12: friction torque measured",
    run=run,
    tables=(11, 12),
    figures=(56, 58, 59, 60, 61, 62, 63, 64),
)
