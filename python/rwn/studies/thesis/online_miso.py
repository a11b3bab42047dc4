"""Table 10, figures 34, 35, 37, 39, 40: online training, two inputs.

Open in the thesis, and chosen here:
- the spiral: radius from 0 to the corners of [-0.5, 0.5]^2 in 25 turns, 2500 samples, cut off at the
  sides, so that it covers the whole square ("the entire input domain"). A spiral that stays in the circle
  of radius 0.5 leaves the corners unlearnt.
- one iteration is one pass along the spiral. The start is not stated: dyadic grid, weights uniform in
  [-0.1, 0.1].
- mu 0.001, momentum 0.8 for translations and dilations, 0.6 for the rest, updated at every sample, as
  stated.
- tested on a mesh of 41 x 41 over the square with frozen weights.

Wanted, tested with frozen weights and no more samples: 1e-4. Recursive Gauss-Newton is given 20 passes
along the same spiral.
"""

from __future__ import annotations

import numpy as np

from rwn.networks.trainers import PatternDescent, PatternGaussNewton
from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Panel, Settings, curve
from rwn.studies.thesis.functions import grid, miso
from rwn.studies.thesis.miso_size import function_panel
from rwn.studies.thesis.offline import WAVELET_CASES, lines
from rwn.studies.thesis.online import Online, Sweep, history_figure, learn, rows_of, wanted_row

TABLE_10 = {"gaussian derivative": 0.0013380, "Mexican hat": 0.00083426, "Morlet (omega0 5)": 0.0013868}
WAVELETS = 31


def spiral() -> Sweep:
    """The patterns along the spiral."""
    s = np.linspace(0, 1, 2500)
    radius, angle = np.sqrt(0.5) * s, 2 * np.pi * 25 * s
    x = np.clip(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]), -0.5, 0.5)
    mesh = grid(-0.5, 0.5, 41)
    return Sweep(x, miso(x)[:, None], mesh, miso(mesh)[:, None])


def run(settings: Settings) -> Outcome:
    """Trains with descent as stated, and with recursive Gauss-Newton."""
    path = spiral()
    stated = {"rate": 0.001, "momentum": 0.6, "shape_momentum": 0.8, "stall": -1.0}
    long = PatternDescent(iterations=settings.pick(1600, 2), **stated)
    short = PatternDescent(iterations=settings.pick(1500, 2), **stated)
    seeds = settings.pick(5, 1)
    first = learn(path, long, WAVELET_CASES["gaussian derivative"], wavelets=WAVELETS, seeds=seeds)
    rows = rows_of(
        "Figure 37",
        "gaussian derivative",
        first,
        learning=0.0013,
        tested=0.0094,
    )
    gauss_newton = PatternGaussNewton(iterations=settings.pick(20, 1))
    by_wavelet: dict[str, Online] = {}
    for label, wavelet in WAVELET_CASES.items():
        by_wavelet[label] = learn(path, short, wavelet, wavelets=WAVELETS, seeds=seeds)
        rows += rows_of(
            "Table 10",
            label,
            by_wavelet[label],
            learning=TABLE_10.get(label),
            tested=None,
            group="Table 10",
        )
        settings.progress(0.2 + 0.6 * len(by_wavelet) / len(WAVELET_CASES))
    better = learn(path, gauss_newton, WAVELET_CASES["gaussian derivative"], wavelets=WAVELETS, seeds=seeds)
    rows.append(
        wanted_row(
            "Table 10",
            "gaussian derivative, recursive Gauss-Newton, frozen, tested",
            0.0094,
            1e-4,
            better,
        )
    )
    return Outcome(rows=rows, figures=_figures(path, first, by_wavelet, better))


def _figures(path: Sweep, first: Online, by_wavelet: dict[str, Online], better: Online) -> list[Figure]:
    outputs = {
        "wanted": path.y_test,
        "descent, frozen": first.trainings[first.median].network.output(path.x_test),
        "recursive Gauss-Newton, frozen": better.trainings[better.median].network.output(path.x_test),
    }
    surfaces: list[Panel] = [function_panel(-0.5, 0.5, z, title) for title, z in outputs.items()]
    spiral_panel = lines(curve(path.x[:, 1], path.x[:, 0]), xlabel="x1", ylabel="x2")
    return [
        Figure(number=34, title="Function of two inputs (2.28)", panels=[function_panel(-0.5, 0.5)]),
        Figure(number=35, title="Training signals: a spiral over the domain", panels=[spiral_panel]),
        history_figure(37, "MSE for approximation of the function of two inputs, online", {"descent": first}),
        Figure(number=39, title="Output of the network after online training", panels=surfaces),
        history_figure(40, "MSE with different wavelets, online, two inputs", by_wavelet),
    ]


EXPERIMENT = Experiment(
    name="online-miso",
    title="Table 10: online, two inputs",
    run=run,
    tables=(10,),
    figures=(34, 35, 37, 39, 40),
)
