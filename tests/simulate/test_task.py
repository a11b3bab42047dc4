"""A task of the core: what it is made of, and what is left out of it."""

from __future__ import annotations

import gc
from typing import Any

import numpy as np
import pytest

from rwn import _core
from rwn.model.vocabulary import parameter_vector

TIME = 1e-3 * np.arange(200.0)
FORCE = 0.1 * np.sin(40.0 * TIME)
VECTOR = parameter_vector({"inertia": 3e-4, "viscous_friction": 7e-5}, {})
LEFT_OUT: dict[str, Any] = {
    "input_time": np.empty(0), "angle_per_position": 1.0, "input_before": 0.0, "angle": np.empty(0),
    "angle_from_speed": False, "angle_from_start": False, "restart_every": 0, "restart_speed": np.empty(0),
    "restart_position": np.empty(0), "order": 0, "own": [],
}  # fmt: skip


def _speed(task: _core.Task) -> np.ndarray:
    return np.asarray(_core.simulate(task, VECTOR, [], []).signals["speed"])


def test_what_is_left_out_is_as_the_core_has_it() -> None:
    plain = _core.Task("axis", time=TIME, input=FORCE)
    np.testing.assert_array_equal(_speed(_core.Task("axis", time=TIME, input=FORCE, **LEFT_OUT)), _speed(plain))


def test_each_field_goes_to_its_place() -> None:
    """Windows restart from the motion that is given for them, and an input is held from its own instants."""
    motion = {"restart_speed": np.full(200, 7.0), "restart_position": np.full(200, 3.0)}
    made = _core.simulate(_core.Task("axis", time=TIME, input=FORCE, restart_every=50, **motion), VECTOR, [], [])
    assert made.signals["speed"][51] == pytest.approx(7.0, abs=1.0)
    assert made.signals["position"][51] == pytest.approx(3.0, abs=0.1)
    held = _core.Task("axis", time=TIME, input=np.array([0.1]), input_time=np.zeros(1))
    assert _speed(held)[-1] == pytest.approx(0.1 / 7e-5 * -np.expm1(-7e-5 / 3e-4 * TIME[-1]), rel=1e-9)


def test_a_task_keeps_its_arrays() -> None:
    kept = _core.Task("axis", time=TIME.copy(), input=FORCE.copy(), angle=np.zeros(200))
    gc.collect()
    np.testing.assert_array_equal(_speed(kept), _speed(_core.Task("axis", time=TIME, input=FORCE, angle=np.zeros(200))))


def test_what_it_does_not_know_is_refused() -> None:
    with pytest.raises(TypeError):
        _core.Task("axis", time=TIME)  # type: ignore[call-arg]
    with pytest.raises(TypeError):
        _core.Task("axis", time=TIME, input=FORCE, restarts=1)  # type: ignore[call-arg]
    with pytest.raises(TypeError):
        _core.Task("axis", time=TIME, input=FORCE.astype(np.float32))
    with pytest.raises(ValueError, match="no such kind of drive"):
        _core.Task("pump", time=TIME, input=FORCE)
