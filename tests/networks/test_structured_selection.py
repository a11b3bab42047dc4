from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from test_structured_trainers import simultaneous

import rwn
from motor_networks import MOTOR, SAMPLE_TIME, drive, friction
from rwn.networks.initialisation import StructuredSelection
from rwn.networks.initialisation.structured_selection import select
from rwn.networks.trainers import StructuredLevenbergMarquardt


def test_selection_equals_greedy_least_squares() -> None:
    """Each column taken is the one that leaves the smallest residual of a full least-squares fit."""
    rng = np.random.default_rng(0)
    columns, known, wanted = rng.normal(size=(60, 9)), rng.normal(size=(60, 2)), rng.normal(size=60)
    chosen: list[int] = []
    for _ in range(4):

        def left(j: int) -> float:
            A = np.column_stack([known, columns[:, [*chosen, j]]])
            return float(np.sum((wanted - A @ np.linalg.lstsq(A, wanted)[0]) ** 2))

        chosen.append(min((j for j in range(9) if j not in chosen), key=left))
    assert select(columns, wanted, known, 4) == chosen


def test_dependent_columns_are_left_out() -> None:
    rng = np.random.default_rng(1)
    base = rng.normal(size=(40, 3))
    assert len(select(np.hstack([base, 2 * base]), rng.normal(size=40), np.empty((40, 0)), 6)) == 3


def test_noise_ends_the_selection() -> None:
    rng = np.random.default_rng(2)
    columns = rng.normal(size=(4000, 20))
    wanted = columns[:, 7] + 0.5 * columns[:, 2] + rng.normal(size=4000)
    assert select(columns, wanted, np.empty((4000, 0)), 20, noise=1.0) == [7, 2]


@pytest.mark.slow
def test_selected_wavelets_give_the_friction_of_table_20() -> None:
    """Wanted: J within 0.01 %, total slope within 1e-4 %, friction curve within 4e-5 N m, in 60 iterations."""
    _, u, y, slope = simultaneous()
    motor = rwn.StructuredNetwork.from_motor(
        replace(MOTOR, inertia=2.16e-4, viscous_friction=0.048), sample_time=SAMPLE_TIME
    )
    start = StructuredSelection().start(motor, u, y, wavelets=15, linear=("v1", "v2"))
    fit = StructuredLevenbergMarquardt(iterations=60).fit(start, u, y, learn=("v1", "v2", "w", "m", "d"))
    rms = float(np.sqrt(np.mean((fit.friction(y) - friction(y) - 0.06 * y) ** 2)))
    print(f"friction rms {rms:.2g} N m")
    assert abs(fit.network.motor(SAMPLE_TIME).inertia / MOTOR.inertia - 1) < 1e-4
    assert abs(fit.network.v[0] / slope - 1) < 1e-6
    assert rms < 4e-5


def test_too_small_a_library_is_named() -> None:
    u, y = drive(1000)
    motor = rwn.StructuredNetwork.from_motor(MOTOR, sample_time=SAMPLE_TIME)
    with pytest.raises(ValueError, match="of 15 wavelets are independent"):
        StructuredSelection(levels=1).start(motor, u, y, wavelets=15)
    few = StructuredSelection(levels=6, noise=0.1).start(motor, u, y, wavelets=15)
    assert 0 < few.wavelets < 15


def test_nothing_but_noise_selects_nothing() -> None:
    rng = np.random.default_rng(3)
    assert select(rng.normal(size=(500, 5)), rng.normal(size=500), np.empty((500, 0)), 5, noise=3.0) == []
    u, y = drive(500)
    motor = rwn.StructuredNetwork.from_motor(MOTOR, sample_time=SAMPLE_TIME)
    assert StructuredSelection(noise=100.0).start(motor, u, y, wavelets=5).wavelets == 0
