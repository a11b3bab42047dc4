"""Recordings kept back that contradict each other about what was found are named."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, recorded


@pytest.mark.slow
def test_files_that_contradict_each_other_are_named() -> None:
    """Of one machine with friction two recordings, of another, which cogs instead, one."""
    fitted, alike = (recorded(k, lambda w, _: -0.02 * np.sign(w), samples=1500) for k in (5, 6))
    other = recorded(7, lambda _, angle: 0.02 * np.sin(angle), samples=1500)
    kept_back = [replace(other, name="other"), replace(alike, name="alike")]
    model = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1})
    found = rwn.diagnose([fitted], model, heldout=kept_back)
    assert "alike" in str(found), "also where the file that is listed first decides"
    if not found.added:
        assert any("alike is simulated better and other worse" in warning for warning in found.warnings)
    else:
        assert "On alike it goes from" in str(found)
        assert "these two recordings contradict each other" in str(found)
