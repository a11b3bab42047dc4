"""Shared fixtures."""

from __future__ import annotations

import builtins
import gc
import os
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

from bad_input import Refuse, refusing
from command_line import Run, running
from rwn import _core

SHARED = Path(os.environ.get("RWN_SHARED", Path(__file__).resolve().parents[2] / "shared"))

# The same examples in every run, so that a failure is the change's and not the day's; new ones by hand with
# `pytest --hypothesis-profile default`.
settings.register_profile("repeatable", derandomize=True)
settings.load_profile("repeatable")


def pytest_report_header() -> str:
    """`make test` builds the kernels of this processor alone, beside the plainest."""
    return f"rwn: kernels of {_core.isa()}"


def pytest_collection_finish() -> None:
    """What was imported and collected lives to the end: no collection of garbage need walk through it again."""
    gc.collect()
    gc.freeze()


@pytest.fixture
def without_pandas(monkeypatch: pytest.MonkeyPatch) -> None:
    """As where pandas is not installed."""
    real = builtins.__import__

    def imported(name: str, *rest: Any) -> Any:
        if name == "pandas":
            raise ModuleNotFoundError(name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", imported)


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of real recordings and example cases beside the checkout."""
    if not (SHARED / "data").is_dir():
        pytest.skip(f"real recordings are not here ({SHARED}); set RWN_SHARED to the folder that holds them")
    return SHARED


@pytest.fixture
def refuse(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Refuse:
    """Runs `rwn diagnose` on a recording and a model that it must refuse; returns the line that it prints."""
    return refusing(tmp_path, monkeypatch, capsys)


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs the command line in a folder with a.csv, b.csv and model.toml: (exit code, stdout, stderr)."""
    return running(tmp_path, monkeypatch, capsys)
