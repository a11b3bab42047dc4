"""MuJoCo's DC motor as judge: written by others, integrated by others; the optional extra `judges`."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np

from rwn.studies.trials.judges import mjcf
from rwn.studies.trials.judges.judge import FINE, State
from rwn.studies.trials.plant import Values

LEAST, MOST = 3, 12  # integration steps per fine instant
FINENESS = 0.4  # largest step over the electrical time constant, where MOST allows it


class MujocoRun:
    """Steps of MuJoCo's Euler integrator, which is a leapfrog: torques act on a speed half a step ahead of the current.

    The mean of two speeds and the angle one step back belong to the instant of the current, to second order.
    """

    def __init__(self, plant: Values, *, rate: float) -> None:
        import mujoco  # the extra

        self._fine = 1.0 / (rate * FINE)
        self._steps = _steps(plant, self._fine)
        self._model: Any = mujoco.MjModel.from_xml_string(mjcf.model(plant, self._fine / self._steps))
        self._data: Any = mujoco.MjData(self._model)
        self._advance = mujoco.mj_step
        self._plant = plant
        self._instant = 0
        self._before = (0.0, 0.0)  # speed and angle one step ago

    def state(self) -> State:
        data, (speed, angle) = self._data, self._before
        current, now = float(data.act[-1]), 0.5 * (speed + float(data.qvel[0]))
        rise = float(data.act[0]) if self._plant.get("temperature_coefficient", 0.0) else 0.0
        return (current, now, angle, current, now, rise)

    def step(self, voltage: float) -> list[State]:
        data = self._data
        states: list[State] = []
        data.ctrl[0] = self._supplied(voltage)
        for _ in range(FINE):
            states.append(self.state())
            data.qfrc_applied[0] = -self._outside()
            self._keep_inductance()
            self._advance(self._model, data, self._steps - 1)
            self._before = (float(data.qvel[0]), float(data.qpos[0]))
            self._advance(self._model, data, 1)
            self._instant += 1
        return states

    def wait(self) -> None:
        self._instant += FINE

    def _keep_inductance(self) -> None:
        """MuJoCo keeps L / R as the winding warms; what is constant is L."""
        p = self._plant
        if p.get("temperature_coefficient", 0.0):
            warm = p["resistance"] * (1.0 + p["temperature_coefficient"] * float(self._data.act[0]))
            self._model.actuator_dynprm[0, 0] = p["inductance"] / warm

    def _supplied(self, voltage: float) -> float:
        drop = self._plant.get("supply_resistance", 0.0) * abs(float(self._data.act[-1]))
        limit = max(self._plant.get("voltage_limit", np.inf) - drop, 0.0)
        return float(min(max(voltage, -limit), limit))

    def _outside(self) -> float:
        """Braking torque of time, its mean over the coming fine instant [N m]."""
        p, begin = self._plant, self._instant * self._fine
        torque = 0.0
        if p.get("load_torque", 0.0):
            inside = min(begin + self._fine, p["load_end"]) - max(begin, p["load_start"])
            torque += p["load_torque"] * max(inside, 0.0) / self._fine
        if p.get("periodic_amplitude", 0.0):
            middle = begin + 0.5 * self._fine
            turned = 2.0 * np.pi * p["periodic_frequency"] * middle
            torque += p["periodic_amplitude"] * float(np.sin(turned + p["periodic_phase"]))
        return torque


def _steps(plant: Values, fine: float) -> int:
    """Integration steps per fine instant."""
    electrical = plant["inductance"] / plant["resistance"]
    second_mass = plant.get("load_inertia", 0.0) > 0.0 or plant.get("absorber_inertia", 0.0) > 0.0
    least = 2 * LEAST if second_mass else LEAST  # a damped spring is integrated to first order alone
    return int(np.clip(np.ceil(fine / (FINENESS * electrical)), least, MOST))


@dataclass(frozen=True)
class Mujoco:
    name: str = "mujoco"

    def missing(self) -> str:
        if find_spec("mujoco") is not None:
            return ""
        return "MuJoCo is not installed: pip install 'rwn[judges]', or make the trials with --judge plant"

    def knows(self, effect: str) -> bool:
        return effect in mjcf.EFFECTS

    def describes(self, plant: Values) -> bool:
        return mjcf.describes(plant)

    def start(self, plant: Values, *, rate: float, voltage_scale: float) -> MujocoRun:  # noqa: ARG002
        return MujocoRun(plant, rate=rate)
