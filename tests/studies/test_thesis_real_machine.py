from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import scipy.io

from rwn.errors import InputError
from rwn.studies.thesis.real_machine import FORCE, compare


def write(path: Path, frequency: float) -> None:
    """A carriage of 95 kg with a friction that drops with speed."""
    t = np.arange(4000) * 1e-3
    q = 0.1 * np.sin(2 * np.pi * frequency * t)
    v = np.gradient(q, t)
    friction = np.tanh(50 * v) * (20 + 15 * np.exp(-((v / 0.05) ** 2))) + 200 * v
    force = 95 * np.gradient(v, t) + friction
    scipy.io.savemat(str(path), {"t": t, "qm": q, "vir": force / FORCE})


def test_the_networks_explain_what_coulomb_and_viscous_friction_do_not(tmp_path: Path) -> None:
    write(tmp_path / "DATA_EMPS.mat", 0.5)
    write(tmp_path / "DATA_EMPS_PULSES.mat", 0.4)
    found = compare(tmp_path, iterations=15)
    plain, static, recurrent = (heldout for _, heldout in found.values())
    assert static < 0.7 * plain
    assert recurrent < 0.7 * plain


def test_a_folder_without_the_recordings_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such recording"):
        compare(tmp_path)
