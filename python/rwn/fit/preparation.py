"""From recordings and a model to the problem of a fit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.fit.fit import fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.noise import noise_of
from rwn.fit.prior import Prior
from rwn.fit.problem import Problem
from rwn.fit.scales import scales
from rwn.fit.transfer_function import TransferFunctionProblem, first_guesses
from rwn.model.model import Model
from rwn.recording.quantisation import quantum
from rwn.recording.recording import Recording
from rwn.simulate.run import Run, run_of, windowed
from rwn.simulate.simulator import Simulator

Array = NDArray[np.float64]

GUESSED = 25  # iterations from each first guess of a transfer function
COUNTS = 1.5  # of an encoder, by which a position may be off that was zeroed anywhere within one


def prepare(recordings: Sequence[Recording], model: Model, *, work: _core.Work | None = None) -> Problem:
    """Runs, weights and scales; the noise levels are first guesses from the recordings alone.

    `work`: meter of what simulations cost, of a diagnosis that prepares several times.
    """
    runs = tuple(run_of(r, model) for r in recordings)
    problem = _problem(runs, model, Prior.of(model), work)
    if model.drive.coefficients and not model.parameters:
        problem = replace(problem, prior=_guessed(problem, first_guesses(runs, model.order)))
    count = max((quantum(r.measured("position")) for r in runs), default=0.0)
    if count > 0.0 and model.recording.initial == "rest":
        # a counter that was zeroed anywhere within a count: else the free run is off by up to one count for ever
        free, reach = {"initial_position": 0.0}, {"initial_position": COUNTS * count}
        problem = replace(problem, prior=replace(problem.prior, free=free, reach=reach))
    vector = hypothesis(problem.prior, (), {}).vector
    outputs = [_with_motion(r, problem.simulate(r, vector, []).signals) for r in runs]
    problem = replace(problem, scales=scales(model.drive, vector, runs, outputs))
    if model.drive.force and model.recording.initial == "estimate":
        problem = replace(problem, runs=tuple(windowed(r) if r.position.size else r for r in runs))
    return problem


def _problem(runs: tuple[Run, ...], model: Model, prior: Prior, work: _core.Work | None) -> Problem:
    noise = noise_of(runs, [{s: r.signal(s) for s in r.recorded} for r in runs])
    simulator = Simulator.of(model, work=work)
    if model.drive.coefficients:
        return TransferFunctionProblem(
            drive=model.drive, simulator=simulator, runs=runs, whole=runs, noise=noise, prior=prior, scales={},
            at_rest=model.recording.initial == "rest",
        )  # fmt: skip
    return Problem(
        drive=model.drive, simulator=simulator, runs=runs, whole=runs, noise=noise, prior=prior, scales={}
    )


def _guessed(problem: Problem, guesses: Sequence[Mapping[str, float]]) -> Prior:
    """The prior with unknown coefficients at the guess from which a fit gets furthest."""
    these = [hypothesis(replace(problem.prior, free=guess), (), {}) for guess in guesses]
    costs = [fit(problem, this, max_iterations=GUESSED).cost for this in these]
    first, *others = (guesses[k] for k in np.argsort(costs, kind="stable"))
    return replace(problem.prior, free=first, starts=tuple(others))


def _with_motion(run: Run, simulated: Mapping[str, Array]) -> dict[str, Array]:
    """Simulated signals, with the recorded motion where it is recorded."""
    own = dict(simulated)
    if run.position.size and not run.speed.size:
        own["speed"] = run.motion()[0]
    return own
