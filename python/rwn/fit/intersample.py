"""How the input acted between the rows, read off the recordings: the law under which what is left is likeliest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from statistics import NormalDist

import numpy as np

from rwn.fit.fit import Fit, refit
from rwn.fit.likelihood import DECISIVE, log_likelihood
from rwn.fit.nominal import nominal_of
from rwn.fit.problem import Problem
from rwn.fit.residuals import LEVEL, accuracy_lost
from rwn.model.initial_state import CERTAIN
from rwn.model.model import Model
from rwn.parallel import side_by_side
from rwn.recording.clock import clock_of
from rwn.recording.intersample import AUTO, HELD, INTERSAMPLE
from rwn.recording.recording import Recording, beginnings

MOST_OFF = 0.5  # share of the rows: where more are off, that is the noise of the current
REFUSED = NormalDist().inv_cdf(1.0 - LEVEL)  # deviations of the loss of a law that the free run certainly refuses
ITERATIONS = 8  # of a fit that begins near its end


def with_intersample(recordings: Sequence[Recording], model: Model) -> Model:
    """The model with the law that is likeliest under its refitted nominal structure, unless it states one.

    Raises InputError where a recording does not fit the model.
    """
    if model.recording.intersample != AUTO or model.drive.coefficients:
        return model
    return stating(model, likeliest(*nominal_of(beginnings(recordings), stating(model, HELD))))


def likeliest(problem: Problem, this: Fit) -> str:
    """The law under which the errors of a fit, refitted, are likeliest; "held" where none is so by far.

    What is new in an error may go with the input by another way than through the drive: a controller answers the noise
    of a row by the input of that row, a cable picks its steps up. A law that foretells this is likelier for no physics,
    so one that simulates the recordings certainly worse, from their input alone, is not taken.
    """
    under = {law: _under_law(problem, law) for law in INTERSAMPLE}
    candidates = {law: p for law, p in under.items() if law == HELD or any(r.applied_input is not None for r in p.runs)}
    fits = side_by_side(lambda p: refit(this, p, iterations=ITERATIONS), candidates.values())
    refitted = dict(zip(candidates, fits, strict=True))
    scores = {law: log_likelihood(candidates[law], refitted[law]) for law in candidates}
    likely = [law for law in candidates if scores[law] > scores[HELD] + DECISIVE]
    held = candidates[HELD], refitted[HELD]
    lost = {law: accuracy_lost(*held, candidates[law], refitted[law]) for law in likely}
    return max((law for law in likely if lost[law] < REFUSED), key=lambda law: scores[law], default=HELD)


def without_unknown(recordings: Sequence[Recording], model: Model) -> list[Recording]:
    """The recordings without the currents that hang on when the input changed since the row before, which none knows.

    A winding follows its voltage within a row or two: where that stepped, evenly spread over the step, the current is
    known to a twelfth of the square of what it will become.
    """
    recordings, law = list(recordings), model.recording.intersample
    if law in (AUTO, HELD) or not model.drive.winding or any("current" not in r.signals for r in recordings):
        return recordings
    problem, _ = nominal_of(recordings, model)
    known_to = model.drive.resting_voltage(model.motor, CERTAIN * problem.noise["current"].deviation)  # [V]
    for k, run in enumerate(problem.runs):
        after = np.diff(clock_of(run.time).ticks, prepend=0) > 1 if law == "bridged" else np.full(run.time.size, True)
        off = after & (np.abs(np.diff(run.input, prepend=run.input[:1])) / np.sqrt(12.0) > known_to)
        if off.mean() < MOST_OFF:
            missing = recordings[k].missing
            lost = {"current": off | missing.get("current", np.zeros(off.size, dtype=bool))}
            recordings[k] = replace(recordings[k], missing={**missing, **lost})
    return recordings


def stating(model: Model, law: str) -> Model:
    """The model with a law in its recordings' layout."""
    return replace(model, recording=replace(model.recording, intersample=law))


def _under_law(problem: Problem, law: str) -> Problem:
    return replace(problem, runs=tuple(r.with_intersample(law) for r in problem.runs))
