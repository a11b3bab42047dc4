"""What holds of any drive, whatever its parameters: the mirror image, the clock, the units, and the energy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rwn
from rwn.model.vocabulary import table
from started_effects import started

TIME = np.arange(400) * 1e-3
MOTOR = {
    "resistance": 0.8, "inductance": 1.5e-3, "torque_constant": 0.1, "back_emf_constant": 0.1, "inertia": 3e-4,
    "viscous_friction": 7e-5,
}  # fmt: skip
QUANTITIES = {  # of this drive, that parameters are measured against
    "torque": 0.2, "speed": 50.0, "voltage": 6.0, "current": 2.0, "inertia": 3e-4, "time_step": 1e-3, "duration": 0.4,
    "loss": 5.0,
}  # fmt: skip


def _voltage(scale: float = 1.0) -> np.ndarray:
    return scale * (6.0 * np.sin(25.0 * TIME) + 3.0 * np.sign(np.sin(70.0 * TIME + 0.3)))


def _run(model: rwn.Model, voltage: np.ndarray, time: np.ndarray = TIME) -> rwn.Simulation:
    done = rwn.simulate(model, rwn.Recording(name="run", time=time, signals={"voltage": voltage}))
    assert done.status == "ok"
    return done


def _with(name: str, *, offset: bool = True) -> rwn.Model:
    """The motor with one effect at the size that the effect's own table starts a search from.

    `offset`: with what has a sign beside the effect's strength, as the preload of a spring.
    """
    values = started(table()[name], QUANTITIES)
    offsets = {p.name for p in table()[name].parameters if p.lower < 0.0 and not p.strength}
    values |= {} if offset else dict.fromkeys(offsets, 0.0)
    return rwn.Model(kind="dc", parameters=MOTOR, effects={name: values})


def _applicable() -> list[str]:
    names = []
    for name in table():
        try:
            _with(name)
        except rwn.InputError:
            continue  # of another kind of drive, or of a load
        names.append(name)
    return names


@pytest.mark.parametrize("name", _applicable())
def test_the_mirror_image_of_a_drive_is_that_drive_unless_an_effect_is_one_sided(name: str) -> None:
    """Minus the voltage is minus every signal, where an effect does not tell one direction from the other."""
    model = _with(name, offset=table()[name].one_sided)
    there, back = _run(model, _voltage()), _run(model, -_voltage())
    off = {
        signal: float(np.abs(back.signals[signal] + values).max() / np.abs(values).max())
        for signal, values in there.signals.items()
    }
    assert max(off.values()) > 1e-4 if table()[name].one_sided else max(off.values()) < 2e-9, off


@pytest.mark.parametrize("name", _applicable())
def test_the_hour_at_which_a_recording_starts_does_not_matter(name: str) -> None:
    model = _with(name)
    now, later = _run(model, _voltage()), _run(model, _voltage(), TIME + 64.0)
    for signal, values in now.signals.items():
        # steps differ in the last bits of the times, 64 s * 2^-53 / 1 ms = 7e-12 of a step, which switching widens
        atol = 1e-6 * float(np.abs(values).max())
        np.testing.assert_allclose(later.signals[signal], values, rtol=0.0, atol=atol, err_msg=signal)


@settings(deadline=None, max_examples=25)
@given(
    st.floats(0.1, 10.0), st.floats(1e-4, 1e-2), st.floats(0.01, 0.5), st.floats(1e-5, 1e-3), st.floats(0.0, 1e-3),
    st.floats(0.0, 0.02),
)  # fmt: skip
def test_what_goes_in_is_stored_or_turned_to_heat(
    resistance: float, inductance: float, constant: float, inertia: float, viscous: float, coulomb: float
) -> None:
    """The electrical work is the change of what winding and inertia store, and the heat of winding and friction."""
    values = {
        "resistance": resistance, "inductance": inductance, "torque_constant": constant, "back_emf_constant": constant,
        "inertia": inertia, "viscous_friction": viscous,
    }  # fmt: skip
    time = np.arange(20001) * 2e-5  # the integrals below are sums over these steps
    voltage = 6.0 * np.sin(25.0 * time)
    model = rwn.Model(kind="dc", parameters=values, effects={"coulomb-friction": {"coulomb_torque": coulomb}})
    done = _run(model, voltage, time)
    current, speed = done.signals["current"], done.signals["speed"]

    def total(power: np.ndarray) -> float:
        return float(np.sum(np.diff(time) * 0.5 * (power[:-1] + power[1:])))

    # the voltage of a row holds until the next: its work takes the mean of the current
    work = float(np.sum(voltage[:-1] * np.diff(time) * 0.5 * (current[:-1] + current[1:])))
    heat = total(resistance * current**2 + viscous * speed**2 + coulomb * np.abs(speed))
    stored = 0.5 * (inductance * current[-1] ** 2 + inertia * speed[-1] ** 2)
    turned_over = total(np.abs(voltage * current))
    # the trapezoidal rule is off by a twelfth of (step x rate)^2: of the winding, or of winding against inertia
    rate = max(resistance / inductance, constant / np.sqrt(inertia * inductance))
    fast = (2e-5 * rate) ** 2 / 12.0
    assert abs(work - heat - stored) <= (1e-4 + fast) * turned_over


UNITS = {
    "SI": ("time [s],voltage [V],current [A],speed [rad/s]", (1.0, 1.0, 1.0, 1.0)),
    "of a data sheet": ("time [ms],voltage [mV],current [mA],speed [rpm]", (1e3, 1e3, 1e3, 30.0 / np.pi)),
}
SHEETS = {
    "SI": "".join(f"{name} = {value}\n" for name, value in MOTOR.items()),
    "of a data sheet": (
        'resistance = "800 mohm"\ninductance = "1.5 mH"\ntorque_constant = "100 mN m/A"\n'
        f'back_emf_constant = "{0.1 * 1000 * np.pi / 30!r} V/krpm"\ninertia = "3000 g cm^2"\n'
        'viscous_friction = "70 uN m s/rad"\n'
    ),
}  # fmt: skip


def test_the_units_in_which_a_drive_is_written_down_do_not_matter(tmp_path: Path) -> None:
    """The same recording and data sheet in other units: the same fit, to the digits in which they were written."""
    model = rwn.Model(kind="dc", parameters={**MOTOR, "inertia": 3.6e-4})
    made = _run(model, _voltage())
    noise = np.random.default_rng(0).normal(0.0, 0.05, TIME.size)
    columns = [TIME, _voltage(), made.signals["current"], made.signals["speed"] + noise]
    fits = []
    for name, (header, factors) in UNITS.items():
        rows = np.column_stack([values * factor for values, factor in zip(columns, factors, strict=True)])
        path = tmp_path / f"{name}.csv"
        np.savetxt(path, rows, fmt="%.15g", delimiter=",", header=header, comments="")
        (tmp_path / f"{name}.toml").write_text(f'[motor]\nkind = "dc"\n{SHEETS[name]}[uncertainty]\ninertia = 0.5\n')
        fits.append(rwn.identify(path, tmp_path / f"{name}.toml").parameters["inertia"])
    assert fits[0].value == pytest.approx(fits[1].value, rel=1e-7)
    assert fits[0].interval == pytest.approx(fits[1].interval, rel=1e-5)


def test_a_motor_twice_as_large_in_every_torque_moves_alike() -> None:
    """Twice every constant and twice the voltage: the same speed and current."""
    large = {name: 2.0 * value for name, value in MOTOR.items()}
    one = _run(rwn.Model(kind="dc", parameters=MOTOR), _voltage())
    two = _run(rwn.Model(kind="dc", parameters=large), _voltage(2.0))
    np.testing.assert_allclose(two.signals["speed"], one.signals["speed"], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(two.signals["current"], one.signals["current"], rtol=1e-9, atol=1e-9)
