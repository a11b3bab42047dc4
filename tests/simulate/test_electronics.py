"""What a drive's electronics do: ramp its voltage, limit its current, average its speed."""

from __future__ import annotations

import numpy as np
import pytest

import rwn

MOTOR = {
    "resistance": 0.8, "inductance": 1.5e-3, "torque_constant": 0.1, "back_emf_constant": 0.1, "inertia": 3e-4,
    "viscous_friction": 7e-5, "coulomb_friction": 0.02,
}  # fmt: skip


def _run(time: np.ndarray, voltage: np.ndarray, **effects: dict[str, float]) -> rwn.Simulation:
    model = rwn.Model(kind="dc", parameters=MOTOR, effects={k.replace("_", "-"): v for k, v in effects.items()})
    return rwn.simulate(model, rwn.Recording(name="run", time=time, signals={"voltage": voltage}))


def _steps(time: np.ndarray) -> np.ndarray:
    return np.select([time < 0.05, time < 0.2, time < 0.35, time < 0.38], [0.0, 9.0, -6.0, 3.0], 8.0)


@pytest.mark.parametrize("rate", [60.0, 500.0, 4000.0])  # ramps over many rows, over some, and within one
def test_a_limited_slew_rate_is_the_ramp_of_finer_rows(rate: float) -> None:
    coarse = np.arange(120) * 5e-3
    fine = np.arange(120 * 50) * 1e-4
    ramp, reached = np.zeros(fine.size), 0.0
    for k, wanted in enumerate(np.repeat(_steps(coarse), 50)):
        before, reached = reached, reached + np.clip(wanted - reached, -rate * 1e-4, rate * 1e-4)
        ramp[k] = 0.5 * (before + reached)
    limited = _run(coarse, _steps(coarse), slew_rate_limit={"rate": rate}).signals["speed"]
    expected = _run(fine, ramp).signals["speed"][::50]
    unlimited = _run(coarse, _steps(coarse)).signals["speed"]
    error, effect = (np.sqrt(np.mean((x - expected) ** 2)) for x in (limited, unlimited))
    assert error < 0.01 * effect


def test_a_run_in_motion_begins_at_its_own_voltage() -> None:
    time = np.arange(100) * 1e-3
    start = rwn.Recording(name="run", time=time, signals={"voltage": np.full(100, 8.0), "speed": np.full(100, 70.0)})
    model = rwn.Model(kind="dc", parameters=MOTOR, effects={"slew-rate-limit": {"rate": 20.0}})
    moved = rwn.simulate(model, start).signals["speed"]
    assert moved[-1] > 60.0  # at 8 V; a ramp from 0 V would have braked it to 20 rad/s


def test_a_limited_current_is_held_at_its_limit() -> None:
    time = np.arange(1000) * 1e-3
    voltage = np.where(time < 0.5, 12.0, -12.0)  # 15 A of a stalled winding, 27 A where it is reversed
    limit = {"current_limit": {"limit": 4.0, "bandwidth": 10.0}}
    free, limited = (_run(time, voltage, **e).signals for e in ({}, limit))
    assert np.max(np.abs(free["current"])) > 20.0
    assert np.max(np.abs(limited["current"])) == pytest.approx(4.0, rel=1e-3)
    held = (time > 0.02) & (time < 0.04)  # it accelerates with the torque of its limit
    np.testing.assert_allclose(limited["current"][held], 4.0, rtol=2e-3)
    assert limited["speed"][499] == pytest.approx(free["speed"][499], rel=1e-3)  # the limit is no longer met


@pytest.mark.parametrize("rows", [0.2e-3, 1e-3, 5e-3])
@pytest.mark.parametrize("bandwidth", [1.0, 3.0, 10.0, 20.0])
def test_a_current_rises_at_the_whole_voltage_up_to_its_limit(rows: float, bandwidth: float) -> None:
    """As in the equations taken in steps of 2 us: of a winding that takes 1.9 ms, in rows below and above that."""
    voltage = np.repeat(np.random.default_rng(1).uniform(-36.0, 36.0, 12), 10)
    time = rows * np.arange(voltage.size)
    motor = MOTOR | {"coulomb_friction": 0.0}
    effects = {"current-limit": {"limit": 6.0, "bandwidth": bandwidth}}
    model = rwn.Model(kind="dc", parameters=motor, effects=effects)
    limited = rwn.simulate(model, rwn.Recording(name="run", time=time, signals={"voltage": voltage})).signals
    names = ("resistance", "inductance", "torque_constant", "inertia", "viscous_friction")
    r, inductance, kt, j, b = (motor[name] for name in names)
    h, current, speed, expected = 2e-6, 0.0, 0.0, []
    for u in voltage:
        expected.append((current, speed))
        for _ in range(round(rows / h)):
            drive = u - kt * speed
            sign = np.copysign(1.0, drive)
            most = r * current + bandwidth * r * (sign * 6.0 - current)
            held = abs(drive) > 6.0 * r and sign * (drive - most) > 0.0
            current, speed = (
                current + h / inductance * ((most if held else drive) - r * current),
                speed + h / j * (kt * current - b * speed),
            )
    for signal, exact in zip(("current", "speed"), np.transpose(expected), strict=True):
        assert np.sqrt(np.mean((limited[signal] - exact) ** 2)) < 0.01 * np.std(exact)


@pytest.mark.parametrize("samples", [2, 6, 16])
def test_a_moving_average_is_the_mean_of_the_speed(samples: int) -> None:
    time = np.arange(2000) * 1e-3
    voltage = np.where((3.0 * time) % 1.0 < 0.5, 9.0, -6.0)
    true = _run(time, voltage).signals
    mean = (true["position"][samples:] - true["position"][:-samples]) / (samples * 1e-3)
    averaged = _run(time, voltage, speed_moving_average={"window": samples * 1e-3}).signals["speed"][samples:]
    error, effect = (np.sqrt(np.mean((x - mean) ** 2)) for x in (averaged, true["speed"][samples:]))
    assert error < 0.03 * effect


@pytest.mark.parametrize(
    "effect",
    [
        {"current_limit": {"limit": 1.5, "bandwidth": 1.0}},
        {"coasting_bridge": {"share": 0.95, "supply": 40.0}},
    ],
)
def test_what_takes_the_back_emf_out_is_exact_at_rows_longer_than_it_brakes(
    effect: dict[str, dict[str, float]],
) -> None:
    """A motor that its back-EMF brakes within 1.2 ms, at rows of 5 ms."""
    time = np.arange(300) * 5e-3
    voltage = np.random.default_rng(4).normal(0.0, 5.0, time.size)
    fine = np.repeat(time, 10) + np.tile(np.arange(10) * 5e-4, time.size)
    quick = MOTOR | {"inertia": 1.5e-5, "coulomb_friction": 0.0, "inductance": 1e-5}
    coarse, exact = (
        rwn.simulate(
            rwn.Model(kind="dc", parameters=quick, effects={k.replace("_", "-"): v for k, v in effect.items()}),
            rwn.Recording(name="run", time=t, signals={"voltage": u}),
        ).signals
        for t, u in ((time, voltage), (fine, np.repeat(voltage, 10)))
    )
    for signal, share in (("speed", 0.002), ("current", 0.03)):
        error = np.sqrt(np.mean((coarse[signal] - exact[signal][::10]) ** 2))
        assert error < share * np.std(exact[signal])
