"""What tests of the naming share."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import rwn
from rwn.fit.fit import Fit, fit_nominal
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.name.screening import screen

DEMO = Path(rwn.__file__).parent / "demo"


@pytest.fixture(scope="module")
def problem() -> Problem:
    """The recording of the demo, prepared."""
    model = rwn.read_model(DEMO / "model.toml")
    return prepare([rwn.read_recording(DEMO / "train.csv", layout=model.recording)], model)


@pytest.fixture(scope="module")
def fit_with(problem: Problem) -> Callable[[str], Fit]:
    """It, explained by one effect."""
    return lambda name: screen(problem, fit_nominal(problem), [name])[0]
