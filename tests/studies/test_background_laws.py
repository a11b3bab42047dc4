"""The laws of bench trials that have no name: the plant against scipy and against what they say of themselves."""
# ruff: noqa: ARG005  (hooks all have the same arguments, most use few)

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import plant_reference as judge
from plant_reference import Machine, two_masses
from rwn.studies.trials.effects import BACKGROUND, NAMED, UNNAMED
from rwn.studies.trials.motors import MOTORS, plant_of
from rwn.studies.trials.plant import Array, simulate

RATE = 1000.0
MOTOR = next(motor for motor in MOTORS if motor.name == "M06-40W-24V")
NOMINAL = MOTOR.nominal(dry=False)
J, KT, R = NOMINAL["inertia"], NOMINAL["torque_constant"], NOMINAL["resistance"]
TIME = np.arange(100) / RATE
BOTH_WAYS = np.round(5.0 * np.sin(2.0 * np.pi * 9.0 * TIME) + 2.0 * np.sin(2.0 * np.pi * 41.0 * TIME + 0.4), 5)
FORWARD = np.round(6.0 + 2.0 * np.sin(2.0 * np.pi * 30.0 * TIME), 5)  # never turns back
CONSTANT = np.full(100, 6.0)
TC = 0.004  # of the dry friction that a drift or a wave acts on


def dry(level: Callable[[float, float, float], float]) -> Machine:
    """Friction of this level (time, current, angle) on a rotor that leaves rest and turns forward."""
    return Machine(braking=lambda t, i, w, th: level(t, i, th) if w > 1e-9 else min(level(t, i, th), KT * i))


def wave(th: float) -> float:
    return 1.0 + 0.2 * (np.cos(2.0 * th + 0.1) + np.cos(3.0 * th + 0.2) + np.cos(5.0 * th + 0.3))


# effect: values as in an answer, command, the machine that the law describes
LAWS = {
    "friction-level-drift": ({"rate": 4.0}, FORWARD, dry(lambda t, i, th: TC * (1.0 + 4.0 * t))),
    "friction-wave": (
        {"variation": 0.2, "phase_2": 0.1, "phase_3": 0.2, "phase_5": 0.3},
        FORWARD,
        dry(lambda t, i, th: TC * wave(th)),
    ),
    "iron-hysteresis": (
        {"coefficient": 0.001, "exponent": 1.7},
        FORWARD,
        dry(lambda t, i, th: 0.001 * abs(i) ** 1.7),
    ),
    "supply-ripple": (
        {"amplitude": 0.1, "frequency": 43.0},
        CONSTANT,
        Machine(drop=lambda t, i, w, th: -6.0 * 0.1 * np.sin(2.0 * np.pi * 43.0 * t)),
    ),
    "torque-constant-warming": (
        {"temperature_coefficient": 0.004, "thermal_resistance": 20.0, "heat_capacity": 0.01},
        BOTH_WAYS,
        Machine(
            magnet=lambda t, i, w, th, rise: 1.0 - 0.004 * rise,
            extras=1,
            extra=lambda t, i, w, th, rise: ((R * i * i - rise / 20.0) / 0.01,),
        ),
    ),
    "speed-band-drag": (
        {"torque": 0.01, "speed": 60.0, "width": 15.0},
        BOTH_WAYS,
        Machine(braking=lambda t, i, w, th: 0.01 * np.sign(w) * np.exp(-(((abs(w) - 60.0) / 15.0) ** 2))),
    ),
    "eccentric-drag": (
        {"coefficient": 5e-5, "phase": 0.7},
        BOTH_WAYS,
        Machine(braking=lambda t, i, w, th: 5e-5 * w * np.cos(th + 0.7)),
    ),
    "load-spring": ({"stiffness": 0.002}, BOTH_WAYS, Machine(braking=lambda t, i, w, th: 0.002 * th)),
    "second-resonance": (
        {"inertia_share": 0.1, "resonance": 300.0, "damping_ratio": 0.05},
        BOTH_WAYS,
        two_masses(NOMINAL, 0.1 * J, 0.1 * J * 300.0**2, 2.0 * 0.05 * 0.1 * J * 300.0, share=0.0),
    ),
}
ELSEWHERE = {"wandering-torque", "added-inertia", "supply-sag", "sensor-eccentricity"}
NEEDS_DRY = {"friction-level-drift", "friction-wave"}


def built(name: str, values: dict[str, float]) -> dict[str, float]:
    nominal = NOMINAL | ({"coulomb_friction": TC} if name in NEEDS_DRY else {})
    return plant_of(nominal) | BACKGROUND[name].build(values, nominal)


def test_every_law_is_judged_and_none_is_of_the_older_tables() -> None:
    new = set(BACKGROUND) - set(UNNAMED)
    assert set(LAWS) | ELSEWHERE == new
    assert not new & set(NAMED)
    assert len(new) >= 6


@pytest.mark.parametrize("name", LAWS)
def test_law_does_what_its_equation_says(name: str) -> None:
    values, voltage, machine = LAWS[name]
    judged = judge.run(NOMINAL, machine, voltage, RATE)
    found = simulate(built(name, values), voltage, rate=RATE)
    without = plant_of(NOMINAL | ({"coulomb_friction": TC} if name in NEEDS_DRY else {}))
    effect = float(np.max(np.abs(found.speed - simulate(without, voltage, rate=RATE).speed)))
    off = float(np.max(np.abs(found.speed - judged[:, 1])))
    assert off < 2e-4 * float(np.max(np.abs(judged[:, 1])))  # the reference meets the reversal without knowing where
    assert effect > 30.0 * off, "the law must be far larger than the tolerance to be tested at all"


def test_added_inertia_grows_with_speed() -> None:
    c = 2e-7

    def slope(_: float, x: Array, v: float) -> list[float]:
        i, w = x
        di = (v - R * i - KT * w) / NOMINAL["inductance"]
        return [di, (KT * i - NOMINAL["viscous_friction"] * w) / (J + c * abs(w))]

    x, speeds = np.zeros(2), []
    for k, v in enumerate(BOTH_WAYS):
        speeds.append(x[1])
        span = (k / RATE, (k + 1) / RATE)
        x = solve_ivp(slope, span, x, args=(v,), method="RK45", rtol=1e-9, atol=1e-11).y[:, -1]
    found = simulate(built("added-inertia", {"coefficient": c}), BOTH_WAYS, rate=RATE).speed
    np.testing.assert_allclose(found, speeds, atol=5e-6 * np.max(np.abs(speeds)))


def test_sagging_supply_gives_less_the_more_is_drawn() -> None:
    """In the steady state V0 - Rs i = R i + K w, and K i = B w + Tc."""
    sag = {"open_circuit_voltage": 5.0, "internal_resistance": 0.8}
    plant = built("supply-sag", sag) | {"coulomb_plus": 0.02, "coulomb_minus": 0.02}
    found = simulate(plant, np.full(2000, 9.0), rate=RATE)
    current, speed = found.current[-1], found.speed[-1]
    assert current > 0.5
    assert 5.0 - 0.8 * current == pytest.approx(R * current + KT * speed, rel=1e-6)
    below = simulate(plant, np.full(2000, 2.0), rate=RATE)
    assert R * below.current[-1] + KT * below.speed[-1] == pytest.approx(2.0, rel=1e-6)


def test_eccentric_sensor_reads_once_a_turn() -> None:
    found = simulate(built("sensor-eccentricity", {"eccentricity": 0.05, "phase": 0.4}), FORWARD, rate=RATE)
    np.testing.assert_allclose(found.sensed_speed, found.speed * (1.0 + 0.05 * np.sin(found.position + 0.4)))


def wandering(seed: float, rms: float = 0.01, time: float = 0.05) -> Array:
    """The torque itself, from the speed of a rotor that nothing else moves."""
    free = plant_of(NOMINAL) | {"torque_constant": 1e-9, "back_emf_constant": 1e-9, "viscous_friction": 0.0}
    law = BACKGROUND["wandering-torque"].build({"torque": rms, "time": time}, NOMINAL) | {"wander_seed": seed}
    speed = simulate(free | law, np.zeros(100_000), rate=RATE).speed
    return np.asarray(-J * np.diff(speed) * RATE)


def test_wandering_torque_has_its_rms_and_its_correlation_time() -> None:
    torque = wandering(3.0)
    assert np.std(torque) == pytest.approx(0.01, rel=0.1)  # some 1000 correlation times
    lag = int(0.05 * RATE)
    assert np.mean(torque[lag:] * torque[:-lag]) / np.var(torque) == pytest.approx(np.exp(-1.0), abs=0.07)


@pytest.mark.slow
def test_wandering_torque_is_the_same_for_its_seed_alone() -> None:
    np.testing.assert_array_equal(wandering(3.0), wandering(3.0))
    assert abs(np.corrcoef(wandering(3.0), wandering(4.0))[0, 1]) < 0.2
