from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import scipy.io

import rwn
from rwn.errors import InputError
from rwn.networks.trainers import StructuredFit
from rwn.studies.thesis import real_machine
from rwn.studies.thesis.real_machine import compare, free_run

MOTOR = rwn.MotorParameters(
    resistance=3.4, inductance=2.853e-3, torque_constant=0.048, inertia=1.1e-5, viscous_friction=3.3e-5
)


def as_fit(network: rwn.StructuredNetwork) -> StructuredFit:
    none = np.zeros(1)
    return StructuredFit(
        network=network, slope=0.0, status="converged", advice="", mse=none, deviation=none, condition=1.0
    )


def with_friction(c: float) -> StructuredFit:
    """A motor with friction near standstill and a wide one; with c its friction goes on from its own past."""
    m, d = np.zeros(2), np.array([8.0, 150.0])
    network = rwn.StructuredNetwork.from_motor(
        MOTOR, sample_time=5e-4, w=np.array([-0.02, -0.01]), m=m, d=d, c=np.array([c, 0.0])
    )
    return as_fit(network)


def write(folder: Path, truth: StructuredFit) -> None:
    """Four recordings as the users of FRA233 have them."""
    t = np.arange(8000) * 5e-4
    voltages = {
        "sine": 6 * np.sin(2 * np.pi * t),
        "ramp": np.minimum(3 * t[:6000], 10.0),
        "step": np.where(t[:2000] < 0.2, 0.0, 5.0),
        "stair": 1 + np.floor(2 * t[:5000]),
    }
    for name, voltage in voltages.items():
        speed = free_run(truth, voltage, np.zeros(2))
        raw = {"Time": t[: len(voltage)], "Input": voltage, "Velo": speed}
        scipy.io.savemat(str(folder / f"{name}_1.mat"), {"RawData": raw})


@pytest.mark.parametrize("c", [0.0, 6.0, -12.0])
def test_a_free_run_is_the_simulation_fed_with_its_own_speed(c: float) -> None:
    voltage, fit = 3 * np.sin(0.01 * np.arange(2000)), with_friction(c)
    speed = free_run(fit, voltage, np.zeros(2))
    np.testing.assert_allclose(fit.network.simulate(voltage, speed), speed, rtol=1e-9, atol=1e-9)
    if c == 0:
        np.testing.assert_allclose(fit.free_run(voltage), speed, rtol=1e-9, atol=1e-9)


@pytest.mark.slow
def test_every_network_is_better_than_none_where_there_is_friction(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(real_machine, "SIZES", (5,))
    write(tmp_path, with_friction(6.0))
    stands, heldout = compare(tmp_path, iterations=60)
    assert heldout == {"step_1.mat", "stair_1.mat"}
    error = {stand.name: max(stand.free[name] for name in heldout) for stand in stands}
    none = error.pop("no network")
    assert len(error) == 4
    assert max(error.values()) < 0.7 * none


def test_a_folder_without_the_recordings_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="not here"):
        compare(tmp_path)
