"""Simulations that run away end in words and files like any other, never in a traceback."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, recorded

CUBE = """
[uncertainty]
inertia = 0.1
[own_effects.runs-away]
term = "torque"
equation = "k * speed**3"
parameters.k = { start = 1e-4, unit = "N m s^3/rad^3", lower = 0.0, upper = 1.0, strength = true }
[effects.runs-away]
k = 1e-4
"""


@pytest.mark.slow
def test_a_torque_that_grows_with_the_cube_of_the_speed_is_diagnosed_saved_and_read(tmp_path: Path) -> None:
    run, kept = (recorded(seed, lambda speed, _: -0.004 * np.sign(speed), samples=600) for seed in (1, 2))
    lines = ["[motor]", 'kind = "dc"', *(f"{name} = {value!r}" for name, value in MOTOR.items()), CUBE]
    (tmp_path / "motor.toml").write_text("\n".join(lines))
    found = rwn.diagnose([run], tmp_path / "motor.toml", heldout=[kept], effort=0.1)
    assert all(np.isfinite([e.probability, e.together, e.evidence.odds]).all() for e in found.account)
    found.save(tmp_path / "result")
    assert rwn.Diagnosis.load(tmp_path / "result") == found
