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
