"""A bristle of friction may be far faster than the rows: its simulation stays what it is over finer ones."""

from __future__ import annotations

import numpy as np
import pytest

import rwn

ROW, FINER = 5e-3, 32

# inertia, stiffness, damping, Coulomb torque: of an FRC mechanism in its own units, and of two motors made up
STIFF = [(1.75e-3, 24.0, 15.5, 0.6), (3.09e-5, 256.7, 0.348, 0.0412), (9.27e-5, 6.32, 0.853, 0.1436)]


@pytest.mark.parametrize(("inertia", "stiffness", "damping", "coulomb"), STIFF)
def test_a_bristle_faster_than_the_rows_does_not_run_away(
    inertia: float, stiffness: float, damping: float, coulomb: float
) -> None:
    bristle = {"bristle_stiffness": stiffness, "bristle_damping": damping, "coulomb_torque": coulomb}
    model = rwn.Model(
        kind="axis", parameters={"inertia": inertia, "viscous_friction": 0.01 * damping},
        effects={"presliding-hysteresis": bristle},
    )  # fmt: skip
    time = ROW * np.arange(600)
    torque = 2.0 * coulomb * np.sin(2.0 * np.pi * 0.4 * time)

    def speed(times: int) -> np.ndarray:
        run = rwn.Recording(
            name="run", time=ROW / times * np.arange(time.size * times), signals={"torque": np.repeat(torque, times)}
        )
        return np.asarray(rwn.simulate(model, run).signals["speed"][::times])

    fine = speed(FINER)
    assert np.max(np.abs(speed(1) - fine)) < 0.02 * np.max(np.abs(fine))


@pytest.mark.parametrize("inductance", [1e-4, 1e-3, 5e-3])
@pytest.mark.parametrize("row", [0.01, 0.02])
def test_a_current_that_rises_within_a_row_turns_a_bristle_that_had_settled(inductance: float, row: float) -> None:
    """At the beginning of a row the current is that of the row before: the motion seems to go on, and reverses."""
    motor = {
        "resistance": 1.0, "inductance": inductance, "torque_constant": 0.05, "back_emf_constant": 0.05,
        "inertia": 1e-5, "viscous_friction": 1e-6,
    }  # fmt: skip
    bristle = {"bristle_stiffness": 100.0, "bristle_damping": 0.02, "coulomb_torque": 0.02}
    model = rwn.Model(kind="dc", parameters=motor, effects={"presliding-hysteresis": bristle})
    voltage = 4.0 * np.sin(2.0 * np.pi * 0.9 * row * np.arange(round(4.0 / row)))

    def speed(times: int) -> np.ndarray:
        time = row / times * np.arange(voltage.size * times)
        run = rwn.Recording(name="run", time=time, signals={"voltage": np.repeat(voltage, times)})
        return np.asarray(rwn.simulate(model, run).signals["speed"][::times])

    fine = speed(FINER)
    assert np.max(np.abs(speed(1) - fine)) < 1e-3 * np.max(np.abs(fine))
