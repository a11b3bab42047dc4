"""The command line, run in a folder with two recordings and a model."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from rwn import cli
from rwn.recording.recording import write_csv

Run = Callable[..., tuple[int, str, str]]
MODEL = """[motor]
kind = "dc"
resistance = 0.8
inductance = 1.5e-3
torque_constant = 0.1
back_emf_constant = 0.1
inertia = 3e-4
viscous_friction = 7e-5
"""


def running(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs the command line in a folder with a.csv, b.csv and model.toml: (exit code, stdout, stderr)."""
    t = np.arange(300) / 1000
    for k, name in enumerate(("a.csv", "b.csv")):
        write_csv(tmp_path / name, t, {"voltage": np.sin(30 * t + k), "speed": np.cos(30 * t + k)})
    (tmp_path / "model.toml").write_text(MODEL)
    monkeypatch.chdir(tmp_path)

    def call(*arguments: str) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["rwn", *arguments])
        with pytest.raises(SystemExit) as end:
            cli.main()
        said = capsys.readouterr()
        return int(str(end.value.code)), said.out, said.err

    return call
