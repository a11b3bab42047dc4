"""A witness: the winding by itself, along the recorded motion; the shaft and its load play no part there.

What a voltage or the amplifier does shows there too. What stands for something mechanical makes the current flow as it
did not.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.decide.half import PARTS, Half, squares
from rwn.fit.budget import one_stage
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.simulate.run import Run
from rwn.simulate.windows import windowed

Array = NDArray[np.float64]

EQUATIONS = ("electrical", "actuator")


def winding_of(this: Fit, problem: Problem, model: Model) -> Half | None:  # noqa: ARG001
    """The winding of an explanation; None where current and speed were not both recorded as they were."""
    table, drive, whole = this.hypothesis.table, problem.drive, problem.in_free_run()
    if drive.mechanics is None or "speed" in problem.filters or not all(_tells(run) for run in whole.runs):
        return None
    if any(table[name].takes_time or table[name].rectifies for name in this.hypothesis.effects):
        return None
    judged = tuple(name for name in this.added if table[name].mismatch in EQUATIONS)
    beside = [name for name in this.added if name in judged or table[name].site == "sensor"]
    of_the_shaft = {p.name for p in drive.mechanics.parameters}
    uncertain = {name: std for name, std in problem.prior.uncertainty.items() if name not in of_the_shaft}
    alone = replace(whole, runs=tuple(map(_along_its_motion, whole.runs)))

    def squares_of(without: str, known: Mapping[str, Mapping[str, float]]) -> Array:
        effects = {**problem.prior.effects, **known}
        prior = replace(problem.prior, uncertainty=uncertain, effects=effects, of_runs=())
        others = tuple(name for name in beside if name != without)
        starts = {name: values for name, values in this.starts(others).items() if name in this.added}
        begun = hypothesis(prior, others, problem.scales, starts, this.motor)
        on = replace(alone, prior=prior)
        return squares(on, fit(on, begun, share=one_stage(on.work) / PARTS), "current")

    return Half(name="winding", judged=judged, explained=squares(whole, this, "current"), squares_of=squares_of)


def _tells(run: Run) -> bool:
    return bool(run.current.size and run.speed.size) and run.can_restart


def _along_its_motion(run: Run) -> Run:
    """The run from the recorded motion at every row, of which the current alone is compared."""
    lost = {name: np.ones(run.time.size, dtype=bool) for name in run.recorded if name != "current"}
    return replace(windowed(run, 1), missing={**run.missing, **lost}, start_unknowns=(), levels=())
