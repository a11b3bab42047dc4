"""The search in short windows, each from the recorded motion, where a free run is far off (multiple shooting).

There a free run's error does not say where a fit should go: a shaft that sticks and slips is soon elsewhere, whatever
is missing. Explanations are built up in windows, effect by effect, and each is then fitted to the free run, by which
alone they are judged.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rwn.fit.fit import Fit, best_few, refit, refit_all
from rwn.fit.problem import Problem
from rwn.fit.residual_noise import with_noise_of
from rwn.fit.residuals import join, statistics
from rwn.fit.screening_part import screening_part
from rwn.name.affordable import affordable
from rwn.name.screening import screen

FAR_OFF = 100.0  # mean squared error, in units of the noise, up to which a free run follows the motion
LARGEST_NRMSE = 0.2  # rms error of a signal, as a share of its spread, up to which a free run follows the motion
PATIENCE = 4  # factor on the iterations in short windows: the first steps of a fit are short where the misfit is large


def is_far_off(problem: Problem, best: Fit) -> bool:
    """Whether a free run is so far off that its fit may have ended elsewhere than where its error is least."""
    in_one = all(r.can_restart for r in problem.runs)
    return in_one and not problem.drive.coefficients and statistics(problem, best).variance > FAR_OFF


def has_lost_the_motion(problem: Problem, best: Fit) -> bool:
    """Whether a free run is far off, and some signal errs by too much of its spread to follow the motion."""
    if not is_far_off(problem, best):
        return False
    errors = join(problem, problem.residuals(best.vector, best.active))
    signals = join(problem, [{s: r.signal(s) for s in r.recorded} for r in problem.runs])
    return any(np.sqrt(np.nanmean(errors[s] ** 2)) > LARGEST_NRMSE * np.nanstd(signals[s]) for s in errors)


def fitted_in_windows(
    problem: Problem, nominal: Fit, wanted: Sequence[str], size: int, known: Sequence[Fit] = ()
) -> list[Fit]:
    """Explanations by up to `size` effects, fitted in short windows: every effect beside the best by one fewer.

    `known`: those by fewer effects that were found so already; they are not among what is returned.
    """
    windows, found = screening_part(problem, nominal).in_windows(), list[Fit]()
    for fewer in range(max((len(f.added) for f in known), default=0), size):
        base = min((f for f in (nominal, *known, *found) if len(f.added) == fewer), key=lambda f: f.cost, default=None)
        if base is None:
            break
        windows = with_noise_of(windows, refit(base, windows))
        base = refit(base, windows)
        found += screen(windows, base, affordable(windows, base, wanted, [*known, *found]), patience=PATIENCE)
    return found


def fitted_to_free_run(found: Sequence[Fit], problem: Problem) -> list[Fit]:
    """The best by each number of effects, of what was found in windows, fitted to the free run."""
    sizes = sorted({len(f.added) for f in found})
    return [again for n in sizes for again in refit_all(best_few([f for f in found if len(f.added) == n]), problem)]
