"""Rows with rows between them, of the same input, move a drive the same: whatever drive, effects and rows are drawn."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from rwn.model.drives import KINDS
from rwn.model.vocabulary import table
from started_effects import started

EXACT = 0.02


def _drawn(rng: np.random.Generator) -> tuple[rwn.Model, str]:
    kind = str(rng.choice(["dc", "axis"]))
    motor = {"inertia": 10.0 ** rng.uniform(-4.5, -3.5), "viscous_friction": 10.0 ** rng.uniform(-5.0, -4.0)}
    motor["coulomb_friction"] = 10.0 ** rng.uniform(-2.5, -1.7)
    if kind == "dc":
        constant = 10.0 ** rng.uniform(-1.4, -1.0)
        motor |= {"torque_constant": constant, "back_emf_constant": constant}
        motor |= {"resistance": rng.uniform(1.0, 4.0), "inductance": 10.0 ** rng.uniform(-5.0, -3.3)}
    sizes = {"torque": 0.1, "speed": 100.0, "voltage": 10.0, "current": 3.0, "inertia": motor["inertia"],
             "time_step": 2e-3, "duration": 3.0, "loss": 10.0}  # fmt: skip
    names = [name for name, effect in table().items() if effect.site in KINDS[kind].sites]
    effects = {}
    drawn = [str(name) for name in rng.choice(names, int(rng.integers(0, 3)), replace=False)]
    for name in drawn[: 1 if sum(table()[n].second_mass for n in drawn) > 1 else 2]:  # a drive has one joint
        effects[name] = started(table()[name], sizes)
        for p in table()[name].parameters:
            motor.pop(p.replaces or "", None)
    return rwn.Model(kind=kind, parameters=motor, effects=effects), "voltage" if kind == "dc" else "torque"


def _rows(rng: np.random.Generator) -> np.ndarray:
    time = np.arange(1500) * 10.0 ** rng.uniform(-3.5, -2.6)
    kind = rng.choice(["regular", "jitter", "lost"])
    if kind == "jitter":
        time += 0.3 * time[1] * rng.uniform(-1.0, 1.0, time.size)
    return time - time[0] if kind != "lost" else time[rng.random(time.size) > 0.1]


@pytest.mark.parametrize("seed", range(200))
def test_rows_with_rows_between_them_move_a_drive_the_same(seed: int) -> None:
    rng = np.random.default_rng(seed)
    model, name = _drawn(rng)
    time = np.sort(_rows(rng))
    time -= time[0]
    held = np.repeat(rng.uniform(-1.0, 1.0, time.size // 10 + 1), 10)[: time.size]
    given = held * (10.0 if name == "voltage" else 0.3)
    between = np.insert(time, np.arange(1, time.size), time[:-1] + 0.4 * np.diff(time))

    def speed(at: np.ndarray, values: np.ndarray) -> np.ndarray:
        done = rwn.simulate(model, rwn.Recording(name="run", time=at, signals={name: values}))
        assert done.status == "ok"
        return done.signals["speed"]

    coarse, fine = speed(time, given), speed(between, np.repeat(given, 2)[:-1])[::2]
    assert np.sqrt(np.mean((coarse - fine) ** 2)) < EXACT * np.sqrt(np.mean(fine**2)) + 1e-9


@pytest.mark.parametrize("time_constants", [1.0, 3.0, 20.0, 1000.0])
@pytest.mark.parametrize(
    "effects",
    [{"magnetic-saturation": {"saturation_current": 3.0}}, {"load-dependent-friction": {"friction_ratio": 0.3}}],
    ids=["saturation", "friction"],
)
def test_winding_that_settles_within_a_row(effects: dict[str, dict[str, float]], time_constants: float) -> None:
    motor = {"inertia": 4e-5, "viscous_friction": 1e-5, "coulomb_friction": 0.003, "resistance": 1.0}
    motor |= {"inductance": 1e-3 / time_constants, "torque_constant": 0.03, "back_emf_constant": 0.03}
    model = rwn.Model(kind="dc", parameters=motor, effects=effects)
    voltage = np.random.default_rng(0).uniform(-8.0, 8.0, 1000)

    def speed(parts: int) -> np.ndarray:
        time = np.arange(999 * parts + 1) * 1e-3 / parts
        given = {"voltage": np.repeat(voltage, parts)[: time.size]}
        return rwn.simulate(model, rwn.Recording(name="run", time=time, signals=given)).signals["speed"][::parts]

    coarse, fine = speed(1), speed(64)
    assert np.sqrt(np.mean((coarse - fine) ** 2)) < EXACT * np.sqrt(np.mean(fine**2))
