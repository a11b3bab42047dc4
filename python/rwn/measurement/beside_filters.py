"""An explanation refitted beside filters of the sensors: how likely it is then, and what it leaves as recorded."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.fit.budget import first_stage
from rwn.fit.fit import NEAR_ITS_END, Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.prior_weight import BELIEVABLE
from rwn.fit.problem import Problem
from rwn.fit.residuals import losses
from rwn.measurement.filter_colour import SLOWEST, SensorFilter
from rwn.measurement.known_filters import filtered, log_density
from rwn.measurement.likelihood import log_posterior
from rwn.measurement.noise_spectrum import FASTEST
from rwn.recording.filters import share_before

Array = NDArray[np.float64]

SPACING = 0.035  # of the values of phi that are compared: at few rows a time constant it is told to a few per cent
# Fits that a filter is found by at most, as many refine it as scan phi; they may cost a stage together.
COMPARED = 2 * (round((SLOWEST - FASTEST) / SPACING) + 1)


def refitted(this: Fit, problem: Problem) -> Fit:
    """The same explanation fitted to a problem that may hold other filters.

    Where the motor left what is declared of it, it may have made up for a filter: it then starts from the data sheet.
    """
    starts = {name: this.values_of(name) for name in this.added}
    motor = this.motor if this.farthest_move < BELIEVABLE else None
    begun = hypothesis(problem.prior, this.added, problem.scales, starts, motor)
    return fit(problem, begun, max_iterations=NEAR_ITS_END, share=first_stage() / COMPARED)


def likelihood_beside(problem: Problem, base: Fit, filters: Sequence[SensorFilter]) -> float:
    """How likely an explanation and filters beside it are (log, BIC)."""
    on = filtered(problem, filters)
    this = refitted(base, on)
    unknowns = len(this.hypothesis.unknowns) + len(on.filters)
    return log_posterior(on, this) - log_density(on) - 0.5 * unknowns * float(np.log(problem.samples))


def losses_beside(problem: Problem, this: Fit, filters: Sequence[SensorFilter]) -> Array:
    """`losses` (n,) of an explanation refitted beside filters, of the rows as they were recorded."""
    on = filtered(problem, filters)
    return losses(problem, _as_recorded(on, refitted(this, on), filters))


def losses_of(problem: Problem, this: Fit) -> Array:
    """`losses` (n,) of an explanation as it was fitted, of the rows as they were recorded."""
    return losses(problem, _as_recorded(problem, this, ()))


def _as_recorded(problem: Problem, this: Fit, filters: Sequence[SensorFilter]) -> list[dict[str, Array]]:
    """Errors (n,) of each run, by signal, as a filter and the lines between samples show those that they are made of.

    What was found of samples from such rows, or from before a filter, has the noise of these amplified; an input that
    was inferred from the errors has taken some of it.
    """
    left = shown_through(filters, problem, problem.residuals(this.vector, this.active))
    for run, of_a_run in zip(problem.runs, left, strict=True):
        if run.interpolated is not None:
            of_a_run.update({s: run.interpolated.shown(x) for s, x in of_a_run.items()})
        of_a_run.update({s: x / run.noise_left(s) for s, x in of_a_run.items()})
    return left


def shown_through(
    filters: Sequence[SensorFilter], problem: Problem, residuals: Sequence[Mapping[str, Array]]
) -> list[dict[str, Array]]:
    """Errors (n,) of each run, by signal, as the digital ones of some filters show them."""
    from scipy.signal import lfilter  # late: the command line starts without it

    left = [dict(of_a_run) for of_a_run in residuals]
    for run, of_a_run in zip(problem.runs, left, strict=True):
        for f in (f for f in filters if f.digital and f.signal in of_a_run):
            before = share_before(f.share, run.ticks_per_row)
            taken_in = (1.0 - f.share) * np.array([1.0 - before, before])
            of_a_run[f.signal] = lfilter(taken_in, [1.0, -f.share], np.nan_to_num(of_a_run[f.signal]))
    return left
