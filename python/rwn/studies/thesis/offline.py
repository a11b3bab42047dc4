"""What the offline experiments (section 2.3.1) share: the two tasks, training over seeds, rows and figures
of it.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from rwn.networks.arrays import Array
from rwn.networks.initialisation import DyadicGrid, Heuristic, Initialiser, LeastSquares, LinearStart, SmallRandom
from rwn.networks.trainers import GradientDescent, Trainer
from rwn.networks.training import Training
from rwn.networks.wavelets import Wavelet
from rwn.studies.thesis.experiment import Curve, Figure, Outcome, Panel, Row, Settings, band, curve, median_row
from rwn.studies.thesis.functions import grid, miso, siso

SEEDS = 20


@dataclass(frozen=True)
class Task:
    """Patterns to approximate, finer ones to test on, and how b, a and w start."""

    x: Array
    y: Array
    x_test: Array
    y_test: Array
    linear: LinearStart


_siso, _siso_fine = np.linspace(-10, 10, 201)[:, None], np.linspace(-10, 10, 2001)[:, None]
_miso, _miso_fine = grid(0, 1, 21), grid(0, 1, 81)
SISO = Task(_siso, siso(_siso), _siso_fine, siso(_siso_fine), LeastSquares(scale=0.1))
MISO = Task(_miso, miso(_miso)[:, None], _miso_fine, miso(_miso_fine)[:, None], SmallRandom(scale=0.1))


@dataclass(frozen=True, kw_only=True)
class Runs:
    """Trainings of one setting, one per seed."""

    trainings: list[Training]

    @property
    def mses(self) -> list[float]:
        """MSE after training; infinite where it diverged."""
        return [np.inf if t.status == "diverged" else t.frozen_mse for t in self.trainings]

    @property
    def median(self) -> Training:
        """The training whose MSE is the (lower) median."""
        return self.trainings[int(np.argsort(self.mses)[(len(self.mses) - 1) // 2])]

    def row(self, where: str, case: str, thesis: float, *, iterations: int, answer: bool) -> Row:
        """The row of these runs; `answer`: it speaks for the thesis's number, in the trend of its table."""
        return median_row(
            where,
            case,
            thesis,
            self.mses,
            count=f"{iterations} iterations, {len(self.mses)} seeds",
            group=where if answer else "",
            judge="factor-2" if answer else "none",
            answer=answer,
        )


def train(
    task: Task,
    way: Initialiser,
    trainer: Trainer,
    *,
    wavelets: int,
    seeds: int,
    wavelet: Wavelet | None = None,
) -> Runs:
    """One training per seed; the seed draws the random weights of the start."""
    starts = [
        way.start(wavelet or Wavelet(), task.x, task.y, wavelets=wavelets, seed=seed) for seed in range(seeds)
    ]
    return Runs(trainings=[trainer.train(start, task.x, task.y) for start in starts])


def history(errors: Sequence[Array], label: str) -> list[Curve]:
    """Median and range over the seeds; the seeds one by one where some of them ended before the others."""
    if len({len(e) for e in errors}) == 1:
        return band(errors, label=label)
    return [curve(e, label=label if k == 0 else "") for k, e in enumerate(errors)]


def history_figure(number: int, title: str, runs: dict[str, Runs], thesis: dict[str, float] | None = None) -> Figure:
    """MSE by iteration, median and range over the seeds, beside the thesis's last values."""
    curves = [line for label, r in runs.items() for line in history([t.mse for t in r.trainings], label)]
    panel = Panel(
        xlabel="iteration", ylabel="MSE", curves=curves, thesis=thesis or {}, log_x=True, log_y=True
    )
    return Figure(number=number, title=title, panels=[panel])


def output_panel(task: Task, runs: dict[str, Runs]) -> Panel:
    """Wanted output and output of the median run of each setting; for one input."""
    x = task.x_test[:, 0]
    curves = [curve(task.y_test[:, 0], x, label="wanted", style="k--")]
    curves += [curve(r.median.network.output(task.x_test)[:, 0], x, label=label) for label, r in runs.items()]
    return lines(*curves)


@dataclass(frozen=True, kw_only=True)
class Case:
    """One line of a table that compares the two initialisations."""

    label: str
    wavelets: int
    rate: float
    momentum: float
    heuristic: float  # the thesis's MSEs
    dyadic: float


# Readings of (2.20): the rate as printed, times (1 - momentum), as in MATLAB's descent with momentum, and with the
# gradient of the mean squared error (2.21), which is twice that of (2.12).
PRINTED, MATLAB, SQUARED = "", ", mu (1 - gamma)", ", 2 mu"


def descent(reading: str, *, rate: float, momentum: float, iterations: int) -> GradientDescent:
    """Gradient descent in one of the readings of (2.20)."""
    factor = {PRINTED: 1.0, MATLAB: 1 - momentum, SQUARED: 2.0}[reading]
    return GradientDescent(rate=factor * rate, momentum=momentum, iterations=iterations, stall=-1)


def kept(settings: Settings, full: int, tiny: int) -> int:
    """A number of iterations that decides what an error means: quick runs save seeds, not these."""
    return tiny if settings.count == "tiny" else full


def compare_initialisers(
    task: Task,
    where: str,
    cases: Sequence[Case],
    figures: dict[int, str],
    settings: Settings,
    *,
    readings: Sequence[str] = (PRINTED,),
    iterations: int = 10_000,
) -> Outcome:
    """Tables 1, 2, 5, 6: each case with both initialisations, and the claim that dyadic beats heuristic. The first
    reading speaks for the thesis's numbers."""
    seeds, count = settings.pick(SEEDS, 3), kept(settings, iterations, 60)
    rows: list[Row] = []
    panels: dict[str, dict[str, Runs]] = {"heuristic": {}, "dyadic-grid": {}}
    for reading in readings:
        won = 0
        for case in cases:
            trainer = descent(reading, rate=case.rate, momentum=case.momentum, iterations=count)
            label = case.label + reading
            for way, thesis in ((Heuristic, case.heuristic), (DyadicGrid, case.dyadic)):
                runs = train(task, way(linear=task.linear), trainer, wavelets=case.wavelets, seeds=seeds)
                panels[way.name][label] = runs
                rows.append(
                    runs.row(
                        where,
                        f"{way.name}, {label}",
                        thesis,
                        iterations=count,
                        answer=reading == readings[0],
                    )
                )
            both = (panels[way][label].mses for way in ("dyadic-grid", "heuristic"))
            won += sum(d < h for d, h in zip(*both, strict=True))
            settings.progress(len(rows) / ((2 * len(cases) + 1) * len(readings)))
        pairs = len(cases) * seeds
        rows.append(claim_row(where, f"dyadic beats heuristic, same seed{reading}", won / pairs, pairs))
    thesis_values = {
        "heuristic": {case.label: case.heuristic for case in cases},
        "dyadic-grid": {case.label: case.dyadic for case in cases},
    }
    return Outcome(
        rows=rows,
        figures=[
            history_figure(number, f"{title} ({way})", panels[way], thesis_values[way])
            for (number, title), way in zip(figures.items(), panels, strict=True)
        ],
    )


def claim_row(where: str, case: str, share: float, pairs: int, *, wanted: float = 0.95) -> Row:
    """A claim: the share of pairs in which it is true."""
    return Row(
        where=where, case=f"claim: {case}", ours=share, wanted=wanted, judge="claim", count=f"{pairs} pairs"
    )


WAVELET_CASES: dict[str, Wavelet] = {
    "gaussian derivative": Wavelet(),
    "Mexican hat": Wavelet("mexican-hat"),
    "Morlet (omega0 5)": Wavelet("morlet", 5.0),
    "Morlet (omega0 1.75)": Wavelet("morlet", 1.75),
}
OTHER_MORLET = "Morlet (omega0 5)"


def compare_wavelets(
    task: Task,
    where: str,
    thesis: tuple[float, float, float],
    rate: float,
    wavelets: int,
    settings: Settings,
    *,
    reading: str,
) -> tuple[list[Row], dict[str, Runs]]:
    """Tables 4 and 8: 1000 iterations from the dyadic grid with each wavelet, and the claim that the Gaussian
    derivative is the best, seed by seed. Morlet with omega0 = 1.75 speaks for the thesis's."""
    seeds, count = settings.pick(SEEDS, 3), kept(settings, 1000, 30)
    trainer = descent(reading, rate=rate, momentum=0.6, iterations=count)
    runs: dict[str, Runs] = {}
    rows = []
    for (label, wavelet), value in zip(WAVELET_CASES.items(), (*thesis, thesis[2]), strict=True):
        way = DyadicGrid(linear=task.linear)
        runs[label] = train(task, way, trainer, wavelets=wavelets, seeds=seeds, wavelet=wavelet)
        answer = label != OTHER_MORLET
        rows.append(runs[label].row(where, label, value, iterations=count, answer=answer))
        settings.progress(len(runs) / len(WAVELET_CASES))
    best = np.argmin([r.mses for r in runs.values()], axis=0)
    rows.append(
        claim_row(where, "gaussian derivative is the best", float(np.mean(best == 0)), seeds, wanted=0.5)
    )
    return rows, runs


def compare_trainers(
    task: Task,
    where: str,
    trainers: dict[str, Trainer],
    thesis: dict[str, float],
    wavelets: int,
    settings: Settings,
    *,
    speaking: Collection[str],
) -> tuple[list[Row], dict[str, Runs]]:
    """Tables 3 and 7: 100 iterations with each trainer from the dyadic grid; thesis: MSE by trainer. Those of
    `speaking` speak for the thesis's numbers."""
    seeds = settings.pick(SEEDS, 3)
    runs: dict[str, Runs] = {}
    rows = []
    for label, trainer in trainers.items():
        runs[label] = train(task, DyadicGrid(linear=task.linear), trainer, wavelets=wavelets, seeds=seeds)
        rows.append(
            runs[label].row(
                where, label, thesis[label], iterations=100, answer=label in speaking
            )
        )
        settings.progress(len(runs) / len(trainers))
    return rows, runs


def lines(*curves: Curve, xlabel: str = "x", ylabel: str = "f(x)") -> Panel:
    """A plain panel."""
    return Panel(xlabel=xlabel, ylabel=ylabel, curves=list(curves))
