"""Table 9, figures 28, 30, 32, 33: online training, one input.

Open in the thesis, and chosen here:
- one iteration is one sweep: x = sin of a linear chirp, 0.01 to 1 Hz in 10 s. The start is not stated:
  dyadic grid, weights uniform in [-0.1, 0.1]. Updated at every sample; the sum over patterns has one term
  then.
- mu 0.1 with momentum 0.9, as stated, is at the edge of stability: sampled at 1 ms it diverges, at 0.1 ms
  (the sampling time of the later chapters) it follows the signal by its moving weights and learns
  nothing. These rows are cut to 100 sweeps of 100 000 samples.
- so momentum 0 is run too, sampled at 1 ms, for the full 10 000 (figure 30) and 1000 (Table 9) sweeps.
- the thesis gives the error met while learning, and once, for figure 32, a tested one (triangle and sine
  waves; here even steps through the range, as a triangle makes). Both are given for every row: the first
  is a tracking error.

Wanted, tested with frozen weights and no more samples: 1e-8. Recursive Gauss-Newton is given 30 sweeps at
1 ms.
"""

from __future__ import annotations

import numpy as np

from rwn.networks.trainers import PatternDescent, PatternGaussNewton
from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Panel, Row, Settings, curve
from rwn.studies.thesis.functions import gaussian
from rwn.studies.thesis.offline import WAVELET_CASES, lines
from rwn.studies.thesis.online import Online, Sweep, history_figure, learn, rows_of, wanted_row

TABLE_9 = {"gaussian derivative": 1.819e-7, "Mexican hat": 3.38e-8, "Morlet (omega0 5)": 1.359e-9}
WAVELETS = 7


def sweep(step: float) -> Sweep:
    """One chirp, sampled every `step` seconds."""
    t = np.arange(0, 10, step)
    x = np.sin(2 * np.pi * (0.01 * t + 0.99 / 20 * t**2))[:, None]
    even = np.linspace(-1, 1, 2001)[:, None]
    return Sweep(x, gaussian(x), even, gaussian(even))


def run(settings: Settings) -> Outcome:
    """Trains with descent as stated and without momentum, and with recursive Gauss-Newton."""
    fine, coarse = sweep(1e-3 if settings.reduced else 1e-4), sweep(1e-3)
    gaussian_derivative = WAVELET_CASES["gaussian derivative"]
    calm = PatternDescent(
        rate=0.1, momentum=0, shape_momentum=0, iterations=settings.pick(10_000, 4), stall=-1
    )
    first = learn(coarse, calm, gaussian_derivative, wavelets=WAVELETS, seeds=settings.pick(3, 1))
    settings.progress(0.3)
    stated, plain = _table_9(fine, coarse, settings)
    settings.progress(0.8)
    gauss_newton = PatternGaussNewton(iterations=settings.pick(30, 3))
    better = {
        label: learn(coarse, gauss_newton, wavelet, wavelets=WAVELETS, seeds=settings.pick(20, 2))
        for label, wavelet in WAVELET_CASES.items()
    }
    settings.progress(1.0)
    rows: list[Row] = []
    for case, online in (
        ("mu 0.1, momentum 0.9", stated["gaussian derivative"]),
        ("mu 0.1, momentum 0", first),
    ):
        rows += rows_of("Figure 30", case, online, learning=4.6294e-8, tested=2.7517e-5)
    for momentum, runs in (("0.9", stated), ("0", plain)):
        for label, online in runs.items():
            case = f"{label}, momentum {momentum}"
            thesis = TABLE_9.get(label)
            rows += rows_of(
                "Table 9", case, online, learning=thesis, tested=None, group=f"momentum {momentum}"
            )
    rows += [
        wanted_row("Table 9", f"{label}, recursive Gauss-Newton, frozen, tested", 2.7517e-5, 1e-8, online)
        for label, online in better.items()
    ]
    return Outcome(rows=rows, figures=_figures(fine, first, plain, better["gaussian derivative"]))


def _table_9(fine: Sweep, coarse: Sweep, settings: Settings) -> tuple[dict[str, Online], dict[str, Online]]:
    """Each wavelet with momentum as stated, and without."""
    as_stated = PatternDescent(
        rate=0.1, momentum=0.9, shape_momentum=0.9, iterations=settings.pick(100, 2), stall=-1
    )
    calm = PatternDescent(rate=0.1, momentum=0, shape_momentum=0, iterations=settings.pick(1000, 4), stall=-1)
    seeds = settings.pick(3, 1)
    stated = {k: learn(fine, as_stated, w, wavelets=WAVELETS, seeds=seeds) for k, w in WAVELET_CASES.items()}
    plain = {k: learn(coarse, calm, w, wavelets=WAVELETS, seeds=seeds) for k, w in WAVELET_CASES.items()}
    return stated, plain


def _figures(fine: Sweep, first: Online, plain: dict[str, Online], better: Online) -> list[Figure]:
    x, wanted = fine.x_test[:, 0], fine.y_test[:, 0]
    outputs = {
        label: online.trainings[online.median].network.output(fine.x_test)[:, 0]
        for label, online in {"descent": first, "recursive Gauss-Newton": better}.items()
    }
    shown = [curve(wanted, x, label="wanted", style="k--")]
    shown += [curve(y, x, label=f"{label}, frozen") for label, y in outputs.items()]
    errors = [curve(np.abs(y - wanted), x, label=f"{label}, frozen") for label, y in outputs.items()]
    error_panel = Panel(xlabel="x", ylabel="absolute error", curves=errors, log_y=True)
    return [
        Figure(number=28, title="Gaussian function (2.27)", panels=[lines(curve(wanted, x))]),
        history_figure(30, "MSE for approximation of the Gaussian function, online", {"descent": first}),
        Figure(
            number=32,
            title="Output of the network after online training",
            panels=[lines(*shown), error_panel],
        ),
        history_figure(33, "MSE with different wavelets, online, one input", plain),
    ]


EXPERIMENT = Experiment(
    name="online-siso", title="Table 9: online, one input", run=run, tables=(9,), figures=(28, 30, 32, 33)
)
