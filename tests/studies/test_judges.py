"""The judges agree where they have the same laws; MuJoCo's is left out where it is not installed."""

from __future__ import annotations

import numpy as np
import pytest

from rwn.studies.trials.effects import EFFECTS
from rwn.studies.trials.judges import FINE, JUDGES, mjcf
from rwn.studies.trials.plant import Values

RATE = 1000.0
MOTOR: Values = {
    "resistance": 0.8, "inductance": 1.5e-3, "torque_constant": 0.12, "back_emf_constant": 0.12, "inertia": 3.8e-4,
    "viscous_friction": 6e-5,
}  # fmt: skip
DRY = {"coulomb_plus": 0.02, "coulomb_minus": 0.02}
LAWS: dict[str, Values] = {
    "linear": {},
    "coulomb": DRY,
    "cogging": {"cogging_amplitude": 0.02, "cogging_periods": 7.0, "cogging_phase": 0.4},
    "unbalance": {"unbalance_amplitude": 0.02, "unbalance_phase": 0.9},
    "lugre": DRY | {"bristle_stiffness": 0.5, "bristle_damping": 5e-3},
    "heating": {"temperature_coefficient": 0.0039, "thermal_resistance": 2.0, "heat_capacity": 0.5},
    "drag": {"quadratic_drag": 2e-6, "cubic_drag": 1e-9},
    "shaft": {"load_inertia": 1e-4, "load_viscous": 1e-5, "stiffness": 3.0, "damping": 2e-3},
    "disturbance": {"load_torque": 0.05, "load_start": 0.25, "load_end": 0.45},
    "limit": {"voltage_limit": 9.0},
    "periodic": {"periodic_amplitude": 0.05, "periodic_frequency": 7.0, "periodic_phase": 0.6},
    "supply": {"voltage_limit": 9.0, "supply_resistance": 0.3},
}


def run(judge: str, plant: Values) -> np.ndarray:
    """(rows, 6): states under steps of the voltage."""
    running = JUDGES[judge].start(plant, rate=RATE, voltage_scale=12.0)
    rows = [running.state()]
    for tick in range(800):
        rows += list(running.step(12.0 if tick % 400 < 200 else -6.0))[1:]
        rows.append(running.state())
    return np.array(rows)


@pytest.mark.parametrize("law", LAWS)
def test_mujoco_agrees_with_the_plant(law: str) -> None:
    pytest.importorskip("mujoco", reason="the extra 'judges' (MuJoCo 4) is not installed")
    plant = MOTOR | LAWS[law]
    assert JUDGES["mujoco"].describes(plant)
    own, theirs = run("plant", plant), run("mujoco", plant)
    assert own.shape == theirs.shape == (800 * FINE + 1, 6)
    for column in (0, 1):
        off = float(np.sqrt(np.mean((own - theirs)[:, column] ** 2)))
        assert off < 4e-3 * float(np.std(own[:, column]))


def test_judges_know_what_they_have_laws_for() -> None:
    assert JUDGES["plant"].missing() == ""
    assert all(JUDGES["plant"].knows(name) for name in EFFECTS)
    assert JUDGES["mujoco"].knows("cogging-torque")
    assert not JUDGES["mujoco"].knows("magnetic-saturation")
    assert not mjcf.describes(MOTOR | {"saturation_current": 3.0})
    assert not mjcf.describes(MOTOR | {"coulomb_plus": 0.1, "coulomb_minus": 0.2})


def test_a_step_gives_the_states_within_it() -> None:
    judge = JUDGES["plant"].start(MOTOR, rate=RATE, voltage_scale=12.0)
    before = list(judge.state())
    states = judge.step(12.0)
    assert len(states) == FINE
    assert list(states[0]) == before
    assert np.all(np.diff([state[1] for state in states]) > 0.0)
    judge.wait()
    assert judge.state()[1] > states[-1][1]


def test_mujoco_limits_a_command_and_pushes_in_time() -> None:
    """A supply that does not sag is a limit of the model's own; a torque of time comes from outside."""
    mujoco = pytest.importorskip("mujoco", reason="the extra 'judges' (MuJoCo 4) is not installed")
    assert JUDGES["mujoco"].missing() == ""
    limited = mujoco.MjModel.from_xml_string(mjcf.model(MOTOR | {"voltage_limit": 9.0}, 1e-4))
    assert limited.actuator_ctrlrange.tolist() == [[-9.0, 9.0]]
    sagging = mujoco.MjModel.from_xml_string(mjcf.model(MOTOR | LAWS["supply"], 1e-4))
    assert not sagging.actuator_ctrllimited.any()


def test_a_judge_that_cannot_run_here_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rwn.studies.trials.judges.mujoco.find_spec", lambda _: None)
    assert "pip install 'rwn[judges]'" in JUDGES["mujoco"].missing()
    assert JUDGES["plant"].missing() == ""
