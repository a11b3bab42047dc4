"""How alike a signal is to its simulation, where next to nothing of it moves."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.faults.scale import wrong_scale
from rwn.faults.similarity import Similarity

DEMO = Path(rwn.__file__).parent / "demo"
SPEED = 40.0 * np.sin(0.01 * np.arange(2000))


@pytest.mark.parametrize("size", [0.0, 1e-320, 1e-165, 1e-20])
def test_what_does_not_move_has_no_scale(size: float) -> None:
    for pair in ((SPEED, size * SPEED), (size * SPEED, SPEED), (size * SPEED, size * SPEED)):
        seen = Similarity.of([pair])
        assert np.isfinite([seen.ratio, seen.correlation]).all()
    assert Similarity.of([(SPEED, size * SPEED)]) == Similarity(1.0, 0.0, (1.0, 0.0))


def test_what_moves_little_has_one() -> None:
    seen = Similarity.of([(SPEED, -1e-12 * SPEED)])
    assert seen.ratio == pytest.approx(1e12)
    assert seen.correlation == pytest.approx(-1.0)


@pytest.mark.parametrize("constant", [1e-100, 1e-162, 1e-200])
def test_a_motor_that_does_not_move_is_no_wrong_unit_of_the_speed(constant: float) -> None:
    given = rwn.read_model(DEMO / "model.toml")
    weak = {"torque_constant": constant, "back_emf_constant": constant}
    fault = wrong_scale([rwn.read_recording(DEMO / "train.csv").beginning(1500)],
                        replace(given, parameters={**given.parameters, **weak}))  # fmt: skip
    assert fault is None or "speed" not in fault.signals
