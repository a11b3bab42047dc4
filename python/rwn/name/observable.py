"""Which effects can be told at all from the recorded signals."""

from __future__ import annotations

import numpy as np

from rwn.fit.preparation import Setup

A_SIXTH = 1.0 / 6.0  # travel in revolutions, from which a torque of the angle is more than a load and a spring
HALF_A_METRE = 0.5  # the same of a linear axis, where nothing repeats by the metre


def applicable(name: str, setup: Setup) -> bool:
    """Whether an effect can be told at all from these signals and this model."""
    effect = setup.nominal.table[name]
    axis = setup.problem.kind == "axis"
    if axis and effect.site in ("voltage", "flux"):
        return False
    if setup.problem.kind == "lti" and not effect.at_an_end:
        return False
    if name == "sensor-rectification" and not _may_be_rectified(setup):
        return False
    if any(p.lattice for p in effect.parameters):
        return False  # read off the values, not fitted
    if any(p.cyclic for p in effect.parameters) and not any(p.order for p in effect.parameters):
        turns = setup.problem.angle_per_position == 1.0
        if turns and any(p.replaces for p in effect.parameters):
            return True  # of a shaft that rubs, a part of a turn shows where it rubs more
        return _revolutions(setup) > (A_SIXTH if turns else HALF_A_METRE)
    if name == "viscous-friction":
        return setup.nominal.uncertainty.get("viscous_friction", 0.0) == 0.0
    signals = {s for t in setup.problem.targets for s in t.recorded}
    return not (effect.site == "sensor" and "speed" not in signals)


def _may_be_rectified(setup: Setup) -> bool:
    """A sensor that does not see the direction never shows a negative speed."""
    speeds = [t.speed for t in setup.problem.targets if t.speed.size]
    return all(np.percentile(s, 2.0) > -0.05 * np.max(np.abs(s)) for s in speeds)


def _revolutions(setup: Setup) -> float:
    """The longest travel of a recording in revolutions (metres on a linear axis)."""
    spans = [float(np.ptp(t.angle)) for t in setup.problem.targets if t.angle.size]
    return max(spans, default=np.inf) * setup.problem.angle_per_position / (2.0 * np.pi)
