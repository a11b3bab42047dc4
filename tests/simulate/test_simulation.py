"""The simulation is as exact where samples are far apart as where they are close."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from rwn.model.model import Model
from rwn.model.vocabulary import Effect, table
from started_effects import started

# a small motor: the winding settles within half a sample
MOTOR = {"resistance": 6.0, "inductance": 2e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 4e-5,
         "viscous_friction": 2e-5, "coulomb_friction": 4e-3}  # fmt: skip
QUANTITIES = {  # that parameters are measured against
    "torque": 0.1, "speed": 150.0, "voltage": 10.0, "current": 1.5, "inertia": 4e-5, "time_step": 7.5e-4,
    "duration": 0.6, "loss": 5.0,
}  # fmt: skip
STEP, PARTS = 6e-4, 8
EXACT = 1e-4


def _run(effect: Effect, parts: int) -> tuple[np.ndarray, np.ndarray]:
    """Current and speed at every 8th of the finest instants."""
    rng = np.random.default_rng(5)
    levels = np.repeat(rng.uniform(-10.0, 10.0, 12), 80)
    time = STEP / parts * np.arange(levels.size * parts)
    motor = dict(MOTOR)
    for parameter in effect.parameters:
        motor.pop(parameter.replaces or "", None)
    model = Model(kind="dc", parameters=motor, effects={effect.name: started(effect, QUANTITIES)})
    signals = {"voltage": np.repeat(levels, parts)}
    done = rwn.simulate(model, rwn.Recording(name="fine.csv", time=time, signals=signals))
    assert done.status == "ok"
    return done.signals["current"][::parts], done.signals["speed"][::parts]


@pytest.mark.parametrize("name", [n for n, effect in table().items() if not effect.jumps])
def test_a_long_step_is_as_exact_as_short_ones(name: str) -> None:
    effect = table()[name]
    coarse, fine = _run(effect, 1), _run(effect, PARTS)
    for a, b in zip(coarse, fine, strict=True):
        error = float(np.sqrt(np.mean((a - b) ** 2)) / np.sqrt(np.mean(b**2)))
        assert error < EXACT, f"{name}: {error:.2g}"


def test_a_winding_without_inductance_has_its_current_at_once() -> None:
    """`inductance = 0`, which data sheets of small motors leave out, made all signals zero."""
    motor = {**MOTOR, "coulomb_friction": 0.0, "inductance": 0.0}
    voltage = np.repeat([5.0, -3.0], 200)
    run = rwn.Recording(name="steps.csv", time=STEP * np.arange(400), signals={"voltage": voltage})
    seen = rwn.simulate(Model(kind="dc", parameters=motor), run).signals
    resting = (np.roll(voltage, 1) - motor["back_emf_constant"] * seen["speed"]) / motor["resistance"]
    np.testing.assert_allclose(seen["current"][1:], resting[1:], rtol=1e-3)
    small = rwn.simulate(Model(kind="dc", parameters={**motor, "inductance": 1e-5}), run).signals["speed"]
    np.testing.assert_allclose(seen["speed"], small, atol=1e-3 * np.max(small))


def test_an_input_alone_can_be_simulated() -> None:
    run = rwn.Recording(name="input.csv", time=STEP * np.arange(50), signals={"voltage": np.full(50, 5.0)})
    assert rwn.simulate(Model(kind="dc", parameters=MOTOR), run).signals["speed"][-1] > 0.0


def test_a_sensor_keeps_its_memory_where_friction_of_no_size_stops_the_motor() -> None:
    motor = {k: v for k, v in MOTOR.items() if k != "coulomb_friction"}
    effects = {"speed-sensor-lag": {"time_constant": 5e-4},
               "asymmetric-friction": {"coulomb_torque_plus": 0.0, "coulomb_torque_minus": 0.0}}  # fmt: skip
    voltage = np.repeat([5.0, -5.0, 0.0, 5.0], 50)
    seen = rwn.Recording(name="lag.csv", time=STEP * np.arange(voltage.size), signals={"voltage": voltage})
    speed = rwn.simulate(Model(kind="dc", parameters=motor, effects=effects), seen).signals["speed"]
    plain = rwn.simulate(Model(kind="dc", parameters=motor), seen).signals["speed"]
    assert np.all(np.isfinite(speed))
    assert np.max(np.abs(speed - plain)) < 0.5 * np.max(np.abs(plain))


def test_a_late_sensor_follows_a_speed_that_bends_within_a_sample() -> None:
    """A lag that is shorter than a sample, and samples that are longer than L/R (trial 16 of test seed 10034)."""
    voltage = np.repeat(np.random.default_rng(3).choice([-5.0, 5.0], 150), 4)

    def seen(lag: float, parts: int) -> np.ndarray:
        time = STEP / parts * np.arange(voltage.size * parts)
        model = Model(kind="dc", parameters=MOTOR, effects={"speed-sensor-lag": {"time_constant": lag}})
        run = rwn.Recording(name="prbs.csv", time=time, signals={"voltage": np.repeat(voltage, parts)})
        return rwn.simulate(model, run).signals["speed"][::parts]

    lag = 0.75 * STEP
    fine = seen(lag, 16)
    done = np.std(fine - seen(1e-3 * lag, 16))
    assert np.std(seen(lag, 1) - fine) < 0.01 * done


@pytest.mark.parametrize("name", ["cogging-torque", "position-dependent-friction", "unbalance"])
def test_no_measured_signal_drives_a_free_run(name: str) -> None:
    """Whatever is measured beyond the first samples, the simulation is the same."""
    effect, rng = table()[name], np.random.default_rng(9)
    motor = {k: v for k, v in MOTOR.items() if k not in {p.replaces for p in effect.parameters}}
    model = Model(kind="dc", parameters=motor, effects={name: started(effect, QUANTITIES)})
    voltage = np.repeat(rng.uniform(-10.0, 10.0, 12), 40)
    time = STEP * np.arange(voltage.size)
    input_alone = rwn.Recording(name="run.csv", time=time, signals={"voltage": voltage})
    seen = dict(rwn.simulate(model, input_alone).signals)
    measured = {k: x + 1e-3 * np.std(x) * rng.standard_normal(x.size) for k, x in seen.items()}
    frozen = {k: np.where(np.arange(x.size) < 20, x, x[20]) for k, x in measured.items()}
    free, held = (
        rwn.simulate(model, replace(input_alone, signals={"voltage": voltage, **signals})).signals
        for signals in (measured, frozen)
    )
    for k in free:
        np.testing.assert_array_equal(free[k], held[k])


def test_a_transfer_function_without_values_is_not_simulated() -> None:
    run = rwn.Recording(name="run", time=STEP * np.arange(99), signals={"voltage": np.ones(99)})
    with pytest.raises(rwn.InputError, match=r"the model has no values.*numerator and denominator.*rwn identify"):
        rwn.simulate(Model(kind="lti", order=2, parameters={}), run)


def test_a_pendulum_hangs_where_the_motor_holds_it() -> None:
    """Under a voltage that stalls it, Kt U / R = m g l sin(angle)."""
    load = {"pendulum": {"mass": 0.2, "length": 0.1}}
    model = Model(kind="dc", parameters={**MOTOR, "coulomb_friction": 0.0, "viscous_friction": 2e-2}, load=load)
    time = 2e-3 * np.arange(4000)
    run = rwn.Recording(name="hold", time=time, signals={"voltage": np.full(time.size, 9.0)})
    angle = rwn.simulate(model, run).signals["position"][-1]
    held = MOTOR["torque_constant"] * 9.0 / MOTOR["resistance"]
    assert held == pytest.approx(0.2 * 9.80665 * 0.1 * np.sin(angle), rel=1e-3)
    free = rwn.simulate(replace(model, load={}), run).signals["position"][-1]
    assert free > 8.0 * np.pi


@pytest.mark.parametrize("saturation_current", [0.05, 0.074, 0.15, 0.5])
def test_a_winding_that_saturates_between_two_rows_is_followed(saturation_current: float) -> None:
    """Its transient is seven times shorter than a row, and the current that follows a step of the voltage saturates it.

    At the start of that step nothing says so yet. Compared with rows 50 times shorter.
    """
    motor = {"resistance": 20.0, "inductance": 7.5e-3, "torque_constant": 0.0247, "back_emf_constant": 0.0247,
             "inertia": 1.14e-6, "viscous_friction": 3.2e-7}  # fmt: skip
    model = rwn.Model(
        kind="dc", parameters=motor, effects={"magnetic-saturation": {"saturation_current": saturation_current}}
    )
    voltage, finer = np.repeat([2.3, -2.5, 0.5, -1.0, 2.5], 60), 50

    def speed(rows: int) -> np.ndarray:
        time = 2.5e-3 / rows * np.arange(voltage.size * rows)
        run = rwn.Recording(name="run", time=time, signals={"voltage": np.repeat(voltage, rows)})
        return rwn.simulate(model, run).signals["speed"][::rows]

    exact = speed(finer)
    np.testing.assert_allclose(speed(1), exact, atol=0.015 * float(np.abs(exact).max()))


def test_a_line_of_a_cogging_torque_is_as_good_as_two_halves_of_it() -> None:
    """Whichever of the further lines the other half is."""
    motor = Model(kind="dc", parameters=MOTOR)
    time = 1e-3 * np.arange(2000)
    driven = rwn.Recording(name="r", time=time, signals={"voltage": 3.0 + np.sin(5.0 * time)})
    line = {"amplitude": 0.02, "periods_per_rev": 9.0, "phase": 0.4}
    whole = rwn.simulate(replace(motor, effects={"cogging-torque": line}), driven)
    for number in (2, 3, 4):
        halves = {**line, "amplitude": 0.01} | {f"{k}_{number}": v for k, v in {**line, "amplitude": 0.01}.items()}
        both = rwn.simulate(replace(motor, effects={"cogging-torque": halves}), driven)
        np.testing.assert_allclose(both.signals["speed"], whole.signals["speed"], rtol=0.0, atol=1e-9)
    plain = rwn.simulate(motor, driven)
    assert np.max(np.abs(plain.signals["speed"] - whole.signals["speed"])) > 1.0
