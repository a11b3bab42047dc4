"""Simulations that run away end in words, never in a traceback."""

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


def test_a_torque_that_grows_with_the_cube_of_the_speed_has_no_result(tmp_path: Path) -> None:
    run, kept = (recorded(seed, lambda speed, _: -0.004 * np.sign(speed), samples=600) for seed in (1, 2))
    lines = ["[motor]", 'kind = "dc"', *(f"{name} = {value!r}" for name, value in MOTOR.items()), CUBE]
    (tmp_path / "motor.toml").write_text("\n".join(lines))
    with pytest.raises(rwn.NoResultError, match="the model as given: formula-failed"):
        rwn.diagnose([run], tmp_path / "motor.toml", heldout=[kept], effort=0.1)


@pytest.mark.parametrize("doubt", [0.5, 3.0])
@pytest.mark.parametrize("samples", [600, 3000])  # of which the shorter ends at 1e80 or so, the longer has no end
def test_an_unstable_transfer_function_is_no_model_of_a_stable_motor(samples: int, doubt: float) -> None:
    step, rng = 1e-3, np.random.default_rng(0)
    voltage = np.repeat(rng.uniform(-5.0, 5.0, samples // 20), 20)
    speed = np.zeros(samples)
    for k in range(samples - 1):
        speed[k + 1] = speed[k] + step * (300.0 * voltage[k] - 40.0 * speed[k])
    signals = {"voltage": voltage, "speed": speed + 0.05 * rng.standard_normal(samples)}
    run = rwn.Recording(name="run", time=step * np.arange(samples), signals=signals)
    model = rwn.Model(
        kind="lti", order=1, parameters={"b0": 300.0, "a0": -400.0}, uncertainty={"b0": doubt, "a0": doubt}
    )
    with pytest.raises(rwn.NoResultError, match="run, the model as given: diverged: "):
        rwn.diagnose([run], model, effort=0.1)
