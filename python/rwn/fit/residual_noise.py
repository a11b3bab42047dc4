"""The measurement noise of each signal, and a problem weighted by what a fit leaves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.input_errors import of_sensors, with_input_errors
from rwn.fit.problem import Problem
from rwn.fit.residuals import join
from rwn.model.vocabulary import analog_filters
from rwn.recording.noise import LEAST, STABLE, Noise, noise_from_differences
from rwn.simulate.run import Run

Array = NDArray[np.float64]

CLOCK = 1e-5  # relative accuracy of a sample clock (a good crystal), and so of what was travelled by it
# deviations of what the noise tells of a filter, from which what the motion tells is another: one in 16 000 by chance
APART = 4.0
DRIFT = 1.0  # most that the error of a drifting position may weigh against that of the other signals


def noise_of(runs: Sequence[Run], residuals: Sequence[Mapping[str, Array]]) -> dict[str, Noise]:
    """The measurement noise of each signal in SI; `residuals`: (n,) of each run, by signal.

    It is what is left of second differences, robustly: a model error is smooth against the sample time, so it falls
    out, and a few sharp instants do not count (median). It is no less than the quantisation, and no position is better
    known than the clock that its travel was timed with.
    """
    levels = {}
    for signal in dict.fromkeys(s for left in residuals for s in left):
        steps = float(np.median([r.quantisation(signal) for r in runs if r.signal(signal).size]))
        pairs = [(r, left[signal]) for r, left in zip(runs, residuals, strict=True) if signal in left]
        found = [
            _noise(r.masked(signal, values), r.noise_in_differences(signal)) / r.noise_left(signal)
            for r, values in pairs
            if values.size > 8
        ]
        differenced = max(float(np.median(found)) if found else 1.0, 1e-12)
        # a simulation that runs away leaves more than was recorded at all: that is no noise
        moved = max((_rms(r.signal(signal)) for r in runs if r.signal(signal).size), default=0.0)
        differenced = min(differenced, moved or differenced)
        levels[signal] = max(steps, differenced)
    if "position" in levels:
        travel = max(float(np.ptp(r.position)) for r in runs if r.position.size)
        levels["position"] = max(levels["position"], CLOCK * travel)
    return {s: Noise(level=level) for s, level in levels.items()}


def with_noise_of(problem: Problem, this: Fit) -> Problem:
    """`problem` weighted by the noise that a fit leaves."""
    residuals = problem.residuals(this.vector, this.active)
    before = {**of_sensors(problem.noise), **_filtered_noise(problem, this)}
    noise = _coloured(problem, before, noise_of(problem.runs, residuals), residuals)
    noise = with_input_errors(problem, this, noise)
    excess = _excess(problem, noise, residuals)
    if excess > 1.0:
        noise["position"] = noise["position"].scaled(excess**0.5)
    return replace(problem, noise=noise)


def without_drift(problem: Problem, this: Fit) -> Problem | None:
    """`problem` weighted by what is new in the error of a position that drifts; None where it does not.

    A position in free run adds up every small torque that is missing: where it is off by more than the other signals
    its error is a random walk, of which each step is new. Plain least squares bends whatever parameter follows it.
    """
    residuals = problem.residuals(this.vector, this.active)
    noise = noise_of(problem.runs, residuals)
    if not _excess(problem, noise, residuals) > 1.0:
        return None
    noise = {**problem.noise, "position": _random_walk(problem, residuals)}
    noise["position"] = noise["position"].scaled(max(_excess(problem, noise, residuals), 1.0) ** 0.5)
    return replace(problem, noise=noise)


def _excess(problem: Problem, noise: Mapping[str, Noise], residuals: Sequence[Mapping[str, Array]]) -> float:
    """Mean squared error of the position in units of the largest that it may weigh; 0 where it stands alone."""
    errors = join(replace(problem, noise=noise), residuals)
    variances = {s: float(np.nanmean(r**2)) for s, r in errors.items()}
    others = [v for s, v in variances.items() if s != "position"]
    return variances["position"] / (DRIFT * max(*others, 1.0)) if "position" in variances and others else 0.0


def _random_walk(problem: Problem, residuals: Sequence[Mapping[str, Array]]) -> Noise:
    """The noise of a position whose error is a random walk, of the steps that the residuals show."""
    walk = Noise(level=1.0, reflection=(STABLE,))
    levels = [
        _noise(walk.innovations(run.masked("position", left["position"]), restart=run.restart_every))
        for run, left in zip(problem.runs, residuals, strict=True)
        if "position" in left
    ]
    return walk.scaled(max(float(np.median(levels)), LEAST))


def _filtered_noise(problem: Problem, this: Fit) -> dict[str, Noise]:
    """The noise of signals whose filter is fitted as part of the measurement: the motion and it went through one.

    Where the motion shows another filter than the noise, what coloured the noise is none: it is so by itself.
    """
    measured, noise = {n.effect: n for n in problem.prior.nuisance}, {}
    for signal, lag in analog_filters(problem.prior.table).items():
        if lag.name in measured and signal in problem.noise:
            ((name, time_constant),) = this.values_of(lag.name).items()
            by_noise, spread = (of[name] for of in (measured[lag.name].values, measured[lag.name].spread))
            if abs(np.log(time_constant / by_noise)) > APART * spread:
                time_constant = by_noise
            share = problem.share_kept(signal, time_constant)
            noise[signal] = replace(problem.noise[signal], reflection=(share,))
    return noise


def _coloured(
    problem: Problem, known: Mapping[str, Noise], noise: dict[str, Noise], residuals: Sequence[Mapping[str, Array]]
) -> dict[str, Noise]:
    """The same levels of what is new in a sample, where it is known how the noise of a signal is coloured."""
    for signal, before in known.items():
        if before.reflection and signal in noise:
            unit = Noise(level=1.0, reflection=before.reflection)
            found = [
                _noise(unit.innovations(run.masked(signal, left[signal]), restart=run.restart_every))
                / run.noise_left(signal)
                for run, left in zip(problem.runs, residuals, strict=True)
                if signal in left
            ]
            level = float(np.median(found))
            noise[signal] = replace(before, level=max(level, 1e-12))
    return noise


def _noise(residual: Array, share: float = 1.0) -> float:
    """`share`: of what the second differences of white noise would show (`Run.noise_in_differences`)."""
    spread = share * noise_from_differences(residual)
    rms = _rms(residual)
    return min(spread, rms) if spread > 0.0 else rms


def _rms(x: Array) -> float:
    return float(np.sqrt(np.nanmean(x**2)))
