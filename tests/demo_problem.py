"""The recording of the demo as a problem of a fit."""

from __future__ import annotations

from pathlib import Path

import rwn
from rwn import _core
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem

DEMO = Path(rwn.__file__).parent / "demo"


def demo_problem(work: _core.Work | None = None) -> Problem:
    """Prepared anew. `work`: the meter of what is simulated for it."""
    model = rwn.read_model(DEMO / "model.toml")
    return prepare([rwn.read_recording(DEMO / "train.csv", layout=model.recording)], model, work=work)
