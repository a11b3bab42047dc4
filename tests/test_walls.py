"""The walls between the stages, as pyproject.toml states them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import rwn

ROOT = Path(__file__).resolve().parents[1]


def test_the_contracts_of_imports_are_kept(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    cli = pytest.importorskip("importlinter.cli")
    monkeypatch.chdir(ROOT)
    assert cli.lint_imports(no_cache=True) == cli.EXIT_STATUS_SUCCESS, capsys.readouterr().out


def test_from_the_top_stages_take_the_extension_alone() -> None:
    """What the contracts leave out of account: `from rwn import ...`."""
    package = Path(rwn.__file__).parent
    taken = {
        name.strip()
        for path in package.rglob("*.py")
        if path.parent != package
        for names in re.findall(r"^\s*from rwn import ([\w, ]+)", path.read_text(encoding="utf-8"), re.MULTILINE)
        for name in names.split(",")
    }
    assert taken == {"_core"}


def test_few_modules_stand_at_the_top() -> None:
    assert len(list(Path(rwn.__file__).parent.glob("*.py"))) <= 12


def test_the_tests_mirror_the_rooms() -> None:
    """The reference implementations are what other tests compare with."""
    rooms = {path.parent.name for path in Path(rwn.__file__).parent.glob("*/__init__.py")} - {"reference"}
    assert {path.parent.name for path in (ROOT / "tests").glob("*/test_*.py")} == rooms
