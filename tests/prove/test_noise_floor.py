"""The noise floor of a row of the proof is what its description says."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from rwn.recording.noise import noise_from_differences

MOTOR = {
    "resistance": 1.1, "inductance": 4.5e-4, "torque_constant": 0.037, "back_emf_constant": 0.037, "inertia": 2.9e-5,
    "viscous_friction": 6e-6,
}  # fmt: skip
NOISE = 0.4


def _run(seed: int) -> rwn.Recording:
    time = 1e-3 * np.arange(2000)
    voltage = 8.0 * np.sin(7.0 * time) * np.sign(np.sin(23.0 * time))
    given = rwn.Recording(name=f"run{seed}", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(rwn.Model(kind="dc", parameters=MOTOR), given).signals["speed"]
    noisy = speed + NOISE * np.random.default_rng(seed).standard_normal(time.size)
    return rwn.Recording(name=f"run{seed}", time=time, signals={"voltage": voltage, "speed": noisy})


@pytest.mark.slow
def test_it_is_the_noise_of_the_signal_and_at_most_the_error() -> None:
    sheet = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1})
    kept = _run(2)
    found = rwn.diagnose(_run(1), sheet, heldout=kept)
    (row,) = [r for r in found.heldout if (r.region, r.signal) == ("all", "speed")]
    assert row.noise_floor == pytest.approx(NOISE, rel=0.05)
    assert row.noise_floor <= row.refitted
    assert row.noise_floor <= max(noise_from_differences(np.asarray(kept.signals["speed"])), row.refitted)


def test_every_number_of_the_proof_is_described_in_the_schema() -> None:
    rows = rwn.Diagnosis.schema()["$defs"]["HeldoutRow"]["properties"]
    numbers = ("samples", "nominal", "refitted", "corrected", "noise_floor", "gain", "gain_interval")
    assert all(rows[name].get("description") for name in numbers)
    assert "second differences" in rows["noise_floor"]["description"]
