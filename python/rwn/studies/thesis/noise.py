"""Noise (future work of section 6.2, ours): error, bias and intervals of Tables 17-20 at 60 to 10 dB.

Not done in the thesis. Chosen here: white noise on the speed, so that the ratio of the signal's to the
noise's mean square is the stated one [dB]; starts of case 1 of Tables 17 and 18 and of Table 20. Tables 17
and 18 keep the thesis's 1 V chirp 0-4 Hz. Table 19 has the 12 V chirp 0-200 Hz, since the thesis's own does
not identify three parameters (Table 19). Table 20 keeps the thesis's chirp: wavelets selected from a library
until the next would explain no more than noise (7 to 31), a prior of 0.1 N m on every w; R, L and Kt known.
Its network is fed with the speed that the model itself simulates, so that no noise enters it; beside it, at
40 and 20 dB, with the measured and with a smoothed speed (41 samples), whose errors in variables bias J.
The total slope is <tau, speed>/<speed, speed> along the smoothed speed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rwn.networks.arrays import Array
from rwn.networks.trainers import StructuredLevenbergMarquardt
from rwn.studies.thesis import frictionless, three_parameters, viscous
from rwn.studies.thesis.drive import chirp, linear_network, speed_with_friction
from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Panel, Row, Settings, curve
from rwn.studies.thesis.linear import GROUPS, SYMBOLS, Case
from rwn.studies.thesis.noisy import RATIOS, Estimate, Feed, Noisy, noisy, rows_of
from rwn.studies.thesis.simultaneous import WRONG, total_slope, true_torque

Estimator = Callable[[float, int], Estimate]  # ratio [dB], seed


def linear(case: Case, voltage: Array) -> Estimator:
    """Levenberg-Marquardt on the linear parameters of a case."""
    true = linear_network(viscous_friction=case.viscous)
    speed = true.simulate(voltage, 0 * voltage)
    index = {SYMBOLS[name]: int(GROUPS[name][1]) - 1 for name in case.start}
    trainer = StructuredLevenbergMarquardt(gauge=False, iterations=100, tolerance=1e-8)

    def estimate(decibel: float, seed: int) -> Estimate:
        y, _ = noisy(speed, decibel, np.random.default_rng(seed))
        fit = trainer.fit(case.network(), voltage, y, learn=case.learn)
        return Estimate(
            error={name: 100 * float(fit.network.v[k] / true.v[k] - 1) for name, k in index.items()},
            deviation={name: 100 * float(fit.deviation[k] / true.v[k]) for name, k in index.items()},
        )

    return estimate


def with_friction(feed: Feed, steps: int) -> Estimator:
    """J, the total slope and the friction curve of Table 20."""
    voltage = chirp(1.0, 0.0, 4.0)
    speed, true = speed_with_friction(voltage), linear_network().v

    def estimate(decibel: float, seed: int) -> Estimate:
        y, sigma = noisy(speed, decibel, np.random.default_rng(seed))
        recording = Noisy(voltage=voltage, speed=y, noise=sigma)
        fit = recording.fit(WRONG, ("v1", "v2"), feed, steps)
        along = y if feed == "measured" else recording.source
        slope, v = total_slope(true_torque(along), along), fit.network.v
        rms = float(np.sqrt(np.mean((fit.friction(speed) - true_torque(speed)) ** 2)))
        largest = float(np.abs(true_torque(speed)).max())
        return Estimate(
            error={
                "J": 100 * float(true[1] / v[1] - 1),
                "total slope": 100 * float(v[0] / slope - 1),
                "the friction curve (rms, of its largest)": 100 * rms / largest,
            },
            deviation={
                "J": 100 * float(fit.deviation[1] / true[1]),
                "total slope": 100 * float(fit.deviation[0] / slope),
            },
        )

    return estimate


def run(settings: Settings) -> Outcome:
    """The linear cases, then Table 20, at every ratio."""
    slow, fast, steps = chirp(1.0, 0.0, 4.0), chirp(12.0, 0.0, 200.0), settings.pick(60, 2)
    ratios = RATIOS[: settings.pick(len(RATIOS), 1)]
    problems: dict[tuple[str, str], tuple[Estimator, tuple[float, ...], int]] = {
        ("Table 17", "J and Kt"): (linear(frictionless.CASES[0], slow), ratios, settings.pick(60, 2)),
        ("Table 18", "B and J"): (linear(viscous.CASES[0], slow), ratios, settings.pick(60, 2)),
        ("Table 19", "B, J and Kt"): (linear(three_parameters.CASES[0], fast), ratios, settings.pick(40, 2)),
        ("Table 20", "simulated speed"): (with_friction("simulated", steps), ratios, settings.pick(24, 1)),
        ("Table 20", "smoothed speed"): (with_friction("smoothed", steps), (40.0, 20.0), settings.pick(6, 1)),
        ("Table 20", "measured speed"): (with_friction("measured", steps), (40.0, 20.0), settings.pick(6, 1)),
    }
    rows: list[Row] = []
    panels = []
    for k, ((where, what), (estimate, levels, seeds)) in enumerate(problems.items()):
        by_level = {d: [estimate(d, seed) for seed in range(seeds)] for d in levels}
        for d, found in by_level.items():
            cured = what not in ("smoothed speed", "measured speed")
            new = rows_of(where, f"{what}, {d:.0f} dB", found, goal=1.0 if d == 40.0 and cured else None)
            rows += new if cured else [as_aside(row) for row in new]
        if len(levels) == len(RATIOS):
            panels.append(panel(f"{where}: {what}", by_level))
        settings.progress((k + 1) / len(problems))
    figure = Figure(number=None, name="noise", title="Median parameter error against noise", panels=panels)
    return Outcome(rows=rows, figures=[figure] if panels else [])


def as_aside(row: Row) -> Row:
    """The same number, not judged: shown to say what the cure is worth."""
    return replace(row, judge="none", wanted=None)


def panel(title: str, by_level: dict[float, list[Estimate]]) -> Panel:
    """Median error by ratio, and the deviation that the fits state."""
    levels = np.array(list(by_level))
    first = next(iter(by_level.values()))[0]
    lines = []
    for name in first.deviation:
        error = [float(np.median([abs(e.error[name]) for e in found])) for found in by_level.values()]
        stated = [0.674 * float(np.median([e.deviation[name] for e in found])) for found in by_level.values()]
        lines.append(curve(error, levels, label=f"{name}, met"))
        lines.append(curve(stated, levels, label=f"{name}, stated", style="--"))
    return Panel(
        xlabel="signal to noise [dB]", ylabel="median error [%]", title=title, curves=lines, log_y=True
    )


EXPERIMENT = Experiment(name="noise", title="Noise: Tables 17 to 20 at 60 to 10 dB", run=run, minutes=2.5)
