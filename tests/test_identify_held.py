"""Parameters fitted beside a speed that its sensor holds between updates, as a diagnosis takes it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, recorded

SHEET = rwn.Model(kind="dc", parameters=MOTOR | {"inertia": 3.6e-4}, uncertainty={"inertia": 0.2, "resistance": 0.1})


def test_held_values_are_left_out_of_a_fit_and_said() -> None:
    run = recorded(1, lambda *_: 0.0)
    held = np.repeat(run.signals["speed"][::10], 10)[: run.time.size]
    found = rwn.identify([replace(run, signals={**run.signals, "speed": held})], SHEET)
    assert found.parameters["inertia"].value == pytest.approx(MOTOR["inertia"], rel=0.01)
    assert found.residual_over_noise < 1.3
    assert [finding.kind for finding in found.findings] == ["held"]


def test_a_spike_that_is_left_out_is_not_in_what_is_explained() -> None:
    run = recorded(1, lambda *_: 0.0)
    speed = np.array(run.signals["speed"])
    speed[700] = 1e5
    found = rwn.identify([replace(run, signals={**run.signals, "speed": speed})], SHEET)
    assert any(finding.kind == "spikes" for finding in found.findings)
    assert found.failure == ""
    (row,) = [row for row in found.explained if row.signal == "speed"]
    assert row.explained > 0.9
