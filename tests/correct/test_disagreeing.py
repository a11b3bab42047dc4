"""Recordings kept back that contradict each other about what was found are named."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, recorded


def found(others: int) -> rwn.Diagnosis:
    """Of one machine with friction two recordings, one kept back; of another, which cogs instead, so many before it."""
    fitted, alike = (recorded(k, lambda w, _: -0.02 * np.sign(w), samples=1500) for k in (5, 6))
    cogging = [recorded(7 + k, lambda _, angle: 0.02 * np.sin(angle), samples=1500) for k in range(others)]
    kept_back = [*(replace(r, name=f"other {k}") for k, r in enumerate(cogging)), replace(alike, name="alike")]
    model = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1})
    return rwn.diagnose([fitted], model, heldout=kept_back)


@pytest.mark.slow
def test_the_verdict_names_the_recording_that_says_the_contrary_of_the_first() -> None:
    one = found(1)
    assert one.added
    assert "On alike it goes from" in str(one)
    assert "these two recordings contradict each other" in str(one)


@pytest.mark.slow
def test_a_correction_that_is_left_out_names_the_recordings_that_it_helps() -> None:
    most = found(4)
    assert not most.added
    assert any("alike is simulated better and other 0, other 1, " in warning for warning in most.warnings)
