"""What recordings do not show, and the experiment that would."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.fit.hypothesis import Hypothesis
from rwn.simulate.run import Run

Array = NDArray[np.float64]

LEARNED = 0.7  # standard deviation after the fit against that of the data sheet, below which something was learned


def learns_nothing(this: Hypothesis, deviations: Array, values: Array) -> bool:
    """Whether the recordings say no more of any uncertain parameter of the motor than the data sheet does.

    `deviations`, `values`: (p,) of its unknowns, in SI.
    """
    shares = [
        std / (u.prior_std * (abs(value) if u.logarithmic else abs(u.prior)))
        for u, std, value in zip(this.unknowns, deviations, values, strict=True)
        if u.prior and np.isfinite(u.prior_std) and u.prior_std > 0.0
    ]
    return bool(shares) and min(shares) > LEARNED


def advice(runs: Sequence[Run]) -> str:
    """The run that would show what these do not."""
    lacks = missing(runs)
    what = "steps to both directions at several levels up to the rated voltage, with pauses at standstill"
    return f"Record {what}" + (f"; these recordings show {' and '.join(lacks)}." if lacks else ".")


def moves(runs: Sequence[Run]) -> bool:
    """Whether any recording shows that the shaft turned."""
    return any(run.moves for run in runs)


def missing(runs: Sequence[Run]) -> list[str]:
    """What no recording shows, in words."""
    if not moves(runs):
        return ["no motion"]
    speeds = [r.motion[0] for r in runs]
    peak = max((float(np.percentile(np.abs(w), 99.5)) for w in speeds if w.size), default=0.0)
    together = np.concatenate(speeds) if speeds else np.zeros(1)
    lacks = []
    if not (np.any(together > 0.1 * peak) and np.any(together < -0.1 * peak)):
        lacks.append("no change of direction")
    if np.percentile(np.abs(together), 90) < 1.3 * np.percentile(np.abs(together), 10):
        lacks.append("one speed only")
    if all(np.ptp(r.input) < 1e-9 + 1e-3 * float(np.max(np.abs(r.input))) for r in runs):
        lacks.append("an input that does not change")
    return lacks
