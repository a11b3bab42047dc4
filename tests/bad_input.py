"""A recording and a model without fault, and what is refused once one of them has one."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from rwn import cli

Refuse = Callable[..., str]
MODEL = """
[motor]
kind = "dc"
resistance = 0.81
inductance = "1.5 mH"
torque_constant = 0.105
back_emf_constant = 0.105
inertia = 3.2e-4
viscous_friction = 7e-5

[uncertainty]
resistance = 0.05
inertia = 0.1
"""


def run_rows(n: int = 200) -> list[list[float]]:
    """Rows of time, voltage, current and speed."""
    return [[k / 1000, 5 * np.sin(k / 20), 0.1 * np.cos(k / 20), 30 * np.sin(k / 20 - 1)] for k in range(n)]


def csv_text(
    header: str = "time [s],voltage [V],current [A],speed [rad/s]", rows: list[list[float]] | None = None
) -> str:
    return header + "\n" + "".join(",".join(f"{x:.9g}" for x in row) + "\n" for row in rows or run_rows())


def refused_line(arguments: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> str:
    """The one line that a refused command prints."""
    monkeypatch.setattr(sys, "argv", ["rwn", *arguments])
    with pytest.raises(SystemExit) as end:
        cli.main()
    said = capsys.readouterr()
    assert end.value.code == 2
    assert said.out == ""
    (line,) = said.err.splitlines()
    assert line.startswith("rwn: ")
    return line


def refusing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Refuse:
    """Runs `rwn diagnose` on these files; asserts that it refuses and leaves the folder as it was."""

    def run(
        recording: str | None = None,
        model: str | None = MODEL,
        *,
        name: str = "run.csv",
        extra: tuple[str, ...] = (),
    ) -> str:
        if recording is not None:
            (tmp_path / name).write_text(recording, encoding="utf-8")
        if model is not None:
            (tmp_path / "model.toml").write_text(model, encoding="utf-8")
        before = sorted(tmp_path.rglob("*"))
        files = [
            str(tmp_path / name),
            "--model",
            str(tmp_path / "model.toml"),
            "--out",
            str(tmp_path / "out"),
        ]
        line = refused_line(
            ["diagnose", *files, *(text.replace("TMP", str(tmp_path)) for text in extra)], monkeypatch, capsys
        )
        assert sorted(tmp_path.rglob("*")) == before
        return line

    return run
