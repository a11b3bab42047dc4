"""Explanations that say nothing of their own: no strength, a load at all times, half a period, a wound-up shaft."""

from __future__ import annotations

import math

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.name.observable import revolutions

WHOLE = 0.99  # share of the recording's time from which a window counts as all of it
BRIEF = 10  # fewest samples that a load disturbance lasts
MOST_TWIST = 2.0 * math.pi  # [rad] by which a drive twists a shaft: rubber couplings are made for half a radian


def adds(this: Fit, problem: Problem) -> bool:
    """Whether every effect of a fit says something that the fit without it does not."""
    checks = (_covers_all_or_a_moment, _is_no_period_long, _winds_up)
    return not (this.idle or any(check(this, problem) for check in checks))


def _covers_all_or_a_moment(this: Fit, problem: Problem) -> bool:
    """Whether a load is said to act from end to end of the recordings, which has a name of its own, or for a moment.

    A stray sample is no load.
    """
    brief = BRIEF / max(r.time.size for r in problem.whole)
    return any(not brief < end - begin < WHOLE for begin, end in this.windows)


def _is_no_period_long(this: Fit, problem: Problem) -> bool:
    """Whether something is said to be periodic of which no recording travels a period."""
    travel = revolutions(problem)
    return any(periods * travel < 1.0 for periods in this.periods)


def _winds_up(this: Fit, problem: Problem) -> bool:
    """Whether a shaft is said to be so soft that the torque of its drive winds it up by turns, as of a clutch.

    Of the torque what moves the inertia behind it goes through it.
    """
    if problem.drive.linear:
        return False
    torque, whole = problem.scales["torque"], problem.scales["inertia"]
    joints = [e for e in (this.hypothesis.table[name] for name in this.added) if e.second_mass]
    for of in ({p.unit: this.value(f"{e.name}.{p.name}") for p in e.parameters} for e in joints):
        behind = min(of.get("kg m^2", whole) / whole, 1.0)
        if "N m/rad" in of and of["N m/rad"] * MOST_TWIST < behind * torque:
            return True
    return False
