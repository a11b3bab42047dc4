"""What the online experiments (section 2.3.2) share: sweeps, training over seeds, and rows that give the
error while learning beside the error of the frozen network.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rwn.networks.arrays import Array
from rwn.networks.initialisation import DyadicGrid, SmallRandom
from rwn.networks.trainers import Trainer
from rwn.networks.training import Training
from rwn.networks.wavelets import Wavelet
from rwn.studies.thesis.experiment import Figure, Panel, Row, median_row
from rwn.studies.thesis.offline import history

START = DyadicGrid(linear=SmallRandom(scale=0.1))


@dataclass(frozen=True)
class Sweep:
    """The patterns of one iteration in their order, and the test signal."""

    x: Array
    y: Array
    x_test: Array
    y_test: Array


@dataclass(frozen=True)
class Online:
    """Trainings of one setting, one per seed, and their errors on the test signal with frozen weights."""

    trainings: list[Training]
    tested: list[float]
    count: str

    @property
    def tracking(self) -> list[float]:
        """Mean squared error met in the last sweep, learning on; infinite where the run diverged."""
        return [np.inf if t.status == "diverged" else float(t.mse[-1]) for t in self.trainings]

    @property
    def median(self) -> int:
        """The training whose tested error is the (lower) median."""
        return int(np.argsort(self.tested)[(len(self.tested) - 1) // 2])

    def reason(self) -> str:
        """What the median run did."""
        training = self.trainings[self.median]
        if training.status == "diverged":
            return f"it diverges in sweep {len(training.mse)}"
        return (
            f"{training.mse[-1]:.2g} in the last of {len(training.mse)} sweeps with learning on, "
            f"{self.tested[self.median]:.2g} tested with frozen weights"
        )


def learn(sweep: Sweep, trainer: Trainer, wavelet: Wavelet, *, wavelets: int, seeds: int) -> Online:
    """One training per seed."""
    trainings = [
        trainer.train(START.start(wavelet, sweep.x, sweep.y, wavelets=wavelets, seed=s), sweep.x, sweep.y)
        for s in range(seeds)
    ]
    tested = [t.network.mse(sweep.x_test, sweep.y_test) for t in trainings]
    passes = max(len(t.mse) for t in trainings)
    return Online(trainings, tested, f"{passes} sweeps of {len(sweep.x)} samples, {seeds} seeds")


def rows_of(
    where: str,
    case: str,
    online: Online,
    *,
    learning: float | None,
    tested: float | None,
    answer: bool = False,
) -> list[Row]:
    """Two rows, error while learning and tested with frozen weights, beside the thesis's if there is one, for which
    they speak with `answer`."""
    rows = []
    for kind, thesis, values in (
        ("learning on", learning, online.tracking),
        ("frozen, tested", tested, online.tested),
    ):
        rows.append(
            median_row(
                where,
                f"{case}, {kind}",
                thesis,
                values,
                count=online.count,
                group=where if answer and thesis is not None else "",
                judge="factor-2" if answer and thesis is not None else "none",
                answer=answer and thesis is not None,
            )
        )
    return rows


def wanted_row(where: str, case: str, thesis: float, wanted: float, online: Online) -> Row:
    """The frozen, tested error of a better trainer against the wanted one."""
    return median_row(
        where,
        case,
        thesis,
        online.tested,
        wanted=wanted,
        judge="wanted",
        count=online.count,
        reason=f"{where}, {case}: {online.reason()}.",
    )


def history_figure(number: int, title: str, runs: dict[str, Online], thesis: dict[str, float]) -> Figure:
    """Mean squared error of every sweep, learning on, median and range over the seeds, beside the thesis's last."""
    curves = [line for label, o in runs.items() for line in history([t.mse for t in o.trainings], label)]
    panel = Panel(
        xlabel="iteration (sweep)",
        ylabel="MSE while learning",
        curves=curves,
        thesis=thesis,
        log_x=True,
        log_y=True,
    )
    return Figure(number=number, title=title, panels=[panel])
