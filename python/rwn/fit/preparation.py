"""From recordings and a model to the problem of a fit."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.fit.driving_force import of_driving_force
from rwn.fit.fit import fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.prior import Prior, RunUnknown
from rwn.fit.problem import Problem
from rwn.fit.residual_noise import noise_of
from rwn.fit.transfer_function_problem import TransferFunctionProblem, first_guesses
from rwn.model.initial_state import INITIAL_POSITION
from rwn.model.model import Model
from rwn.model.vocabulary import motor_index, motor_parameters
from rwn.recording.recording import Recording
from rwn.simulate.own_unknowns import StartUnknown
from rwn.simulate.recorded_run import run_of
from rwn.simulate.run import Run
from rwn.simulate.scales import scales
from rwn.simulate.simulator import Simulator

Array = NDArray[np.float64]

GUESSED = 25  # iterations from each first guess of a transfer function


def prepare(recordings: Sequence[Recording], model: Model, *, work: _core.Work | None = None) -> Problem:
    """Runs, weights and scales; the noise levels are first guesses from the recordings alone.

    `work`: meter of what simulations cost, of a diagnosis that prepares several times.
    """
    runs, prior = _one_sensor(tuple(run_of(r, model) for r in recordings)), Prior.of(model)
    if not model.drive.coefficients:  # a transfer function's initial state is eliminated from every fit
        runs, starts = _unknown_starts(runs)
        prior = replace(prior, of_runs=starts)
    problem = replace(_problem(runs, model, prior, work), filters=model.recording.filters)
    if model.drive.coefficients and not model.parameters:
        problem = replace(problem, prior=_guessed(problem, first_guesses(runs, model.order)))
    vector = hypothesis(problem.prior, (), {}).vector
    outputs = [_with_motion(r, problem.simulate(r, vector, []).signals) for r in runs]
    problem = replace(problem, scales=scales(model.drive, vector, runs, outputs))
    held = model.drive.force and any(r.in_motion for r in runs) and all(r.position.size for r in runs)
    return of_driving_force(problem) if held else problem


def _one_sensor(runs: tuple[Run, ...]) -> tuple[Run, ...]:
    """The runs with the speed measured in all as most of them show; as many, the way over fewest samples.

    One recording may show it wrongly: an input that is held for some samples leaves gaps in the spectrum of its own.
    A difference of the position beside it is known by its values; a recording that shows none says nothing against it.
    """
    shown = Counter(
        r.speed_measured for r in runs if r.speed.size and r.position.size and r.speed_measured.is_difference
    )
    ways = shown or Counter(r.speed_measured for r in runs if r.speed.size)
    if not ways:
        return runs
    usual = max(ways, key=lambda way: (ways[way], -way.before - way.after))
    return tuple(replace(r, speed_measured=usual) if r.speed.size else r for r in runs)


def _unknown_starts(runs: Sequence[Run]) -> tuple[tuple[Run, ...], tuple[RunUnknown, ...]]:
    """The runs with a place in the vector for what is not known of each one's start, and these unknowns."""
    unknowns: list[RunUnknown] = []
    placed = []
    for run in runs:
        own = []
        for name, spread in run.start_spread.items():
            place = _core.parameter_count() + len(unknowns)
            unit = motor_parameters()[name].unit
            unknowns.append(
                RunUnknown(
                    name=f"{name} of {run.name}", unit=unit, place=place, parameters=(motor_index(name),),
                    spread=spread, turns=name == INITIAL_POSITION and run.angle_unknown,
                )
            )
            own.append(StartUnknown(place, motor_index(name)))
        placed.append(replace(run, start_unknowns=tuple(own)))
    return tuple(placed), tuple(unknowns)


def _problem(runs: tuple[Run, ...], model: Model, prior: Prior, work: _core.Work | None) -> Problem:
    noise = noise_of(runs, [{s: r.signal(s) for s in r.recorded} for r in runs])
    simulator = Simulator.of(model, work=work)
    if model.drive.coefficients:
        return TransferFunctionProblem(
            drive=model.drive, simulator=simulator, runs=runs, whole=runs, noise=noise, prior=prior, scales={},
            at_rest=not any(r.in_motion for r in runs),
        )  # fmt: skip
    return Problem(drive=model.drive, simulator=simulator, runs=runs, whole=runs, noise=noise, prior=prior, scales={})


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
        own["speed"] = run.motion[0]
    return own
