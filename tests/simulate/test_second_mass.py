"""Two masses, with and without play, against scipy's integrator of the same law."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import plant_reference as judge
import rwn
from rwn.model.model import Model

Array = NDArray[np.float64]

MOTOR = {"resistance": 1.1, "inductance": 4e-4, "torque_constant": 0.037, "back_emf_constant": 0.037,
         "inertia": 2.8e-5, "viscous_friction": 4e-5}  # fmt: skip
J, LOAD = MOTOR["inertia"], 1.1e-5
REDUCED = LOAD * (J - LOAD) / J
BEHIND = {"load_viscous_share": judge.LOAD_VISCOUS_SHARE}
RATE = 500.0  # the closed gap swings once or twice a sample
LEVELS = np.repeat(np.random.default_rng(4).uniform(-4.0, 4.0, 12), 10)


def _simulated(effects: dict[str, dict[str, float]]) -> Array:
    seen = rwn.Recording(name="two.csv", time=np.arange(LEVELS.size) / RATE, signals={"voltage": LEVELS})
    done = rwn.simulate(Model(kind="dc", parameters=MOTOR, effects=effects), seen)
    assert done.status == "ok"
    return np.column_stack([done.signals[s] for s in ("current", "speed", "position")])


def _expect_the_same(found: Array, judged: Array, limit: float) -> None:
    for k in range(found.shape[1]):
        assert np.max(np.abs(found[:, k] - judged[:, k])) < limit * np.max(np.abs(judged[:, k]))


@pytest.mark.parametrize("rate", [600.0, 2000.0, 5000.0])
@pytest.mark.parametrize("damping", [0.1, 0.4, 1.5])
def test_a_gap_closes_bounces_and_opens_as_its_law_says(rate: float, damping: float) -> None:
    law = {"gap": 0.2, "load_inertia": LOAD, "contact_rate": rate, "contact_damping_ratio": damping} | BEHIND
    machine = judge.two_masses(MOTOR, LOAD, REDUCED * rate**2, 2.0 * damping * REDUCED * rate, 0.2)
    # scipy does not know where they touch: by steps 100 times as short the simulation itself is exact to 1e-9
    _expect_the_same(_simulated({"backlash": law}), judge.run(MOTOR, machine, LEVELS, RATE), 5e-5)


@pytest.mark.parametrize(("stiffness", "share"), [(0.01, 0.3), (1.0, 0.0), (1.0, 0.9)])
def test_a_shaft_twists_as_its_law_says(stiffness: float, share: float) -> None:
    law = {"stiffness": stiffness, "damping": 1e-5, "load_inertia": LOAD, "load_viscous_share": share}
    machine = judge.two_masses(MOTOR, LOAD, stiffness, 1e-5, share=share)
    _expect_the_same(_simulated({"shaft-compliance": law}), judge.run(MOTOR, machine, LEVELS, RATE), 1e-6)


def test_a_gap_beside_a_drag_that_is_not_linear() -> None:
    law = {"gap": 0.2, "load_inertia": LOAD, "contact_rate": 1500.0, "contact_damping_ratio": 0.3} | BEHIND
    two = judge.two_masses(MOTOR, LOAD, REDUCED * 1500.0**2, 2.0 * 0.3 * REDUCED * 1500.0, 0.2)
    drag = 1e-6
    machine = judge.Machine(
        motor_inertia=two.motor_inertia, extras=2, extra=two.extra, coupling=two.coupling,
        braking=lambda t, i, w, th: drag * w * abs(w),  # noqa: ARG005
    )  # fmt: skip
    found = _simulated({"backlash": law, "quadratic-drag": {"drag_coefficient": drag}})
    # the position is a quadrature of the speed, which current's first rise bends within a sample
    _expect_the_same(found[:, :2], judge.run(MOTOR, machine, LEVELS, RATE)[:, :2], 1e-4)


@pytest.mark.parametrize("friction", [0.0, 0.05])
@pytest.mark.parametrize("damping", [0.02, 0.3])
def test_no_bounce_is_overlooked_in_long_steps(friction: float, damping: float) -> None:
    law = {"gap": 0.2, "load_inertia": LOAD, "contact_rate": 2500.0, "contact_damping_ratio": damping} | BEHIND
    model = Model(kind="dc", parameters={**MOTOR, "coulomb_friction": friction}, effects={"backlash": law})
    speeds = []
    for parts in (1, 20):
        time = np.arange(LEVELS.size * parts) / (RATE * parts)
        seen = rwn.Recording(name="two.csv", time=time, signals={"voltage": np.repeat(LEVELS, parts)})
        speeds.append(rwn.simulate(model, seen).signals["speed"][::parts])
    assert (np.count_nonzero(speeds[0] == 0.0) > 10) == (friction > 0.0), "it has to stick somewhere"
    assert np.max(np.abs(speeds[0] - speeds[1])) < 1e-6 * np.max(np.abs(speeds[1]))


@pytest.mark.parametrize("effect", ["backlash", "shaft-compliance"])
def test_a_load_heavier_than_the_whole_is_refused_by_its_name(effect: str) -> None:
    law = {"gap": 0.2, "contact_rate": 1500.0, "contact_damping_ratio": 0.3} | BEHIND if effect == "backlash" else {
        "stiffness": 1.0, "damping": 1e-5} | BEHIND  # fmt: skip
    model = Model(kind="dc", parameters=MOTOR, effects={effect: {**law, "load_inertia": 1.2 * J}})
    seen = rwn.Recording(name="two.csv", time=np.arange(LEVELS.size) / RATE, signals={"voltage": LEVELS})
    with pytest.raises(rwn.InputError, match=rf"load_inertia is {1.2 * J:g}.*of the drive"):
        rwn.simulate(model, seen)


def test_a_load_that_rattles_far_faster_than_the_samples_keeps_its_mean_motion() -> None:
    law = {"gap": 2e-3, "load_inertia": LOAD, "contact_rate": 5000.0, "contact_damping_ratio": 0.01} | BEHIND
    model = Model(kind="dc", parameters=MOTOR, effects={"backlash": law})
    ends = []
    for parts in (1, 40):
        time = np.arange(40 * parts) * (0.2 / parts)
        seen = rwn.Recording(name="slow.csv", time=time, signals={"voltage": np.repeat(LEVELS[::3], parts)})
        ends.append(rwn.simulate(model, seen).signals["position"][::parts])
    assert np.max(np.abs(ends[0] - ends[1])) < 0.01 * np.max(np.abs(ends[1]))
