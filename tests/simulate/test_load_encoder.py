"""A motion that is measured at a load behind a joint: against plain numerical integration of both masses."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import rwn

Array = NDArray[np.float64]

WINDING = {"resistance": 0.8, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05}
SHAFT = {"inertia": 2e-4, "viscous_friction": 1e-4, "coulomb_friction": 0.0}
STIFFNESS, DAMPING, LOAD, SHARE = 3.0, 2e-3, 1.2e-4, 0.3
COMPLIANCE = {"stiffness": STIFFNESS, "damping": DAMPING, "load_inertia": LOAD, "load_viscous_share": SHARE}
GAP, RATE, RATIO = 0.05, 900.0, 0.4
BACKLASH = {
    "gap": GAP, "load_inertia": LOAD, "contact_rate": RATE, "contact_damping_ratio": RATIO, "load_viscous_share": SHARE,
}  # fmt: skip
TIME = np.arange(800) * 1e-3


def _steps() -> Array:
    """Held for 20 rows each."""
    return np.repeat(np.random.default_rng(3).uniform(-1.0, 1.0, 40), 20)


def _integrated(given: Array, law: dict[str, float], *, kind: str, friction: float) -> tuple[Array, Array]:
    """Speed and position of the load (n,); dry friction as a steep function of the speed."""
    play = "gap" in law
    motor = SHAFT["inertia"] - LOAD
    reduced = LOAD * motor / SHAFT["inertia"]
    stiffness = reduced * RATE**2 if play else STIFFNESS
    damping = 2.0 * RATIO * reduced * RATE if play else DAMPING
    drag = SHAFT["viscous_friction"]

    def slopes(_: float, x: Array, u: float) -> list[float]:
        current, speed, angle, load_speed, load_angle = x
        twist = angle - load_angle
        bend = twist - np.clip(twist, -0.5 * GAP, 0.5 * GAP) if play else twist
        torque = stiffness * bend + damping * (speed - load_speed) * (bend != 0.0)
        torque = max(torque, 0.0) if play and bend > 0.0 else min(torque, 0.0) if play else torque
        driving = WINDING["torque_constant"] * current if kind == "dc" else u
        back_emf = WINDING["back_emf_constant"] * speed
        return [
            (u - WINDING["resistance"] * current - back_emf) / WINDING["inductance"] if kind == "dc" else 0.0,
            (driving - (1.0 - SHARE) * drag * speed - torque) / motor,
            speed,
            (torque - SHARE * drag * load_speed - friction * np.tanh(load_speed / 1e-3)) / LOAD,
            load_speed,
        ]

    state, out = np.zeros(5), []
    for k in range(TIME.size):
        out.append(state[[3, 4]])
        done = solve_ivp(slopes, (0.0, 1e-3), state, args=(given[k],), method="LSODA", rtol=1e-9, atol=1e-10)
        state = done.y[:, -1]
    return np.array(out)[:, 0], np.array(out)[:, 1]


@pytest.mark.parametrize("kind", ["dc", "axis"])
@pytest.mark.parametrize(
    ("effect", "law", "friction", "tolerance"),
    [
        ("load-encoder-compliance", COMPLIANCE, 0.0, 1e-5),
        ("load-encoder-compliance", COMPLIANCE, 0.03, 2e-3),
        ("load-encoder-backlash", BACKLASH, 0.03, 2e-2),
    ],
    ids=["compliance", "compliance-with-friction", "backlash-with-friction"],
)
def test_a_load_behind_its_motor_moves_as_both_masses_do(
    effect: str, law: dict[str, float], friction: float, tolerance: float, kind: str
) -> None:
    given = _steps() * (8.0 if kind == "dc" else 0.2)
    parameters = SHAFT | {"coulomb_friction": friction} | (WINDING if kind == "dc" else {})
    model = rwn.Model(kind=kind, parameters=parameters, effects={effect: law})
    name = "voltage" if kind == "dc" else "torque"
    found = rwn.simulate(model, rwn.Recording(name="run", time=TIME, signals={name: given}))
    speed, position = _integrated(given, law, kind=kind, friction=friction)
    assert np.max(np.abs(found.signals["speed"] - speed)) < tolerance * np.max(np.abs(speed))
    assert np.max(np.abs(found.signals["position"] - position)) < tolerance * np.ptp(position)


def test_friction_holds_the_load_while_its_motor_winds_the_shaft_up() -> None:
    parameters = SHAFT | WINDING | {"coulomb_friction": 0.2}
    model = rwn.Model(kind="dc", parameters=parameters, effects={"load-encoder-compliance": COMPLIANCE})
    voltage = np.where(TIME < 0.4, 2.0, 6.0)  # 0.125 N m at standstill, then 0.375
    found = rwn.simulate(model, rwn.Recording(name="run", time=TIME, signals={"voltage": voltage}))
    assert not np.any(found.signals["speed"][:400])
    assert found.signals["current"][399] == pytest.approx(2.0 / WINDING["resistance"], rel=1e-3)
    assert np.all(found.signals["speed"][420:] > 0.0)
