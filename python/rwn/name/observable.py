"""Which effects show at all in the recorded signals."""

from __future__ import annotations

import numpy as np

from rwn.fit.problem import Problem
from rwn.name.initial_guesses.spectra import SEEN_PERIODS
from rwn.recording.signals import MOTION

A_SIXTH = 1.0 / 6.0  # least travel [revolutions] that tells a torque over the angle from a load and a spring
HALF_A_METRE = 0.5  # least travel [m] of a linear axis that tells a force over the position from a load and a spring


def observable(name: str, problem: Problem) -> bool:
    """Whether an effect shows at all in these signals under this model."""
    effect = problem.prior.table[name]
    if effect.site not in problem.drive.sites:
        return False
    if effect.rectifies and not _may_be_rectified(problem):
        return False
    if effect.guess == "none":
        return False  # read off the values, or known beforehand
    if effect.turns and any(p.cyclic for p in effect.parameters) and not any(p.order for p in effect.parameters):
        turns = not problem.drive.linear
        if turns and any(p.replaces for p in effect.parameters):
            return True  # of a shaft that rubs, a part of a turn shows where it rubs more
        return revolutions(problem) > (A_SIXTH if turns else HALF_A_METRE)
    if effect.slow:
        fastest = max(p.upper for p in effect.parameters if p.order)
        return not problem.drive.linear and revolutions(problem) * fastest > SEEN_PERIODS
    beside = [p.beside for p in effect.parameters if p.beside]
    if beside:
        return all(problem.prior.uncertainty.get(nominal, 0.0) == 0.0 for nominal in beside)
    signals = {s for r in problem.runs for s in r.recorded}
    if effect.shows_late:  # against another channel: against the input alone it is the input that is late
        together = MOTION if effect.shows_late in MOTION else (effect.shows_late,)
        return bool(signals & {*together}) and bool(signals - {*together})
    return not (effect.site == "sensor" and "speed" not in signals)


def _may_be_rectified(problem: Problem) -> bool:
    """A sensor that does not see the direction never shows a negative speed."""
    speeds = [r.speed for r in problem.runs if r.speed.size]
    return all(np.percentile(s, 2.0) > -0.05 * np.max(np.abs(s)) for s in speeds)


def revolutions(problem: Problem) -> float:
    """The longest travel of a recording in revolutions (metres on a linear axis)."""
    spans = [float(np.ptp(r.angle)) for r in problem.runs if r.angle.size]
    return max(spans, default=np.inf) * problem.simulator.angle_per_position / (2.0 * np.pi)
