"""The walls between the stages, as pyproject.toml states them, and how long a file and a function may be."""

from __future__ import annotations

import ast
import re
import tomllib
from pathlib import Path

import pytest

import rwn
from rwn.model.drives import KINDS
from rwn.model.drives.drive import MECHANICS
from rwn.model.vocabulary import table

ROOT = Path(__file__).resolve().parents[1]


def test_the_contracts_of_imports_are_kept(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    cli = pytest.importorskip("importlinter.cli")
    monkeypatch.chdir(ROOT)
    assert cli.lint_imports(no_cache=True) == cli.EXIT_STATUS_SUCCESS, capsys.readouterr().out


def test_whatever_stands_at_the_top_may_not_import_the_references() -> None:
    """The contract lists its sources: a room that is added is on the list."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    contracts = project["tool"]["importlinter"]["contracts"]
    (listed,) = (set(c["source_modules"]) for c in contracts if c.get("forbidden_modules") == ["rwn.reference"])
    package = Path(rwn.__file__).parent
    rooms = {p.parent.name for p in package.glob("*/__init__.py")} | {p.stem for p in package.glob("*.py")}
    assert {f"rwn.{room}" for room in rooms - {"__init__", "reference"}} == listed


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


# What the headers and sources of each room of C++ include of other rooms; the kernels are built once per processor.
ROOMS: dict[str, set[str]] = {
    "numerics": set(),
    "kernels": set(),
    "networks": {"numerics", "kernels"},
    "model": {"numerics"},
    "simulate": {"numerics", "model"},
    "fit": {"numerics", "kernels", "simulate"},
}


def test_the_rooms_of_c_plus_plus_include_what_they_may() -> None:
    """No circles, and a wall that is gone is gone from the list."""
    taken: dict[str, set[str]] = {room: set() for room in ROOMS}
    for place in ("cpp/include/rwn", "cpp/src"):
        for path in (ROOT / place).rglob("*.[ch]pp"):
            room = path.relative_to(ROOT / place).parts[0]
            included = re.findall(r'^#include "rwn/(\w+)/', path.read_text(encoding="utf-8"), re.MULTILINE)
            taken[room] |= set(included) - {room}
    assert taken == ROOMS
    for room, others in ROOMS.items():
        assert not any(room in ROOMS[other] for other in others)


def test_no_stage_knows_a_parameter_of_one_kind_of_drive_by_name() -> None:
    """It is the drive that does; what every drive with mechanics has, all may ask for."""
    mechanics = {p.name for p in MECHANICS}
    own = "|".join(sorted({p.name for drive in KINDS.values() for p in drive.parameters} - mechanics))
    assert "torque_constant" in own
    asked = re.compile(rf"""[\[(]["'](?:{own})["']""")
    package = Path(rwn.__file__).parent
    left_out = {"studies", "reference", "networks"}  # the thesis's networks are of one kind of drive
    looked_at = [path for path in package.rglob("*.py") if path.relative_to(package).parts[0] not in left_out]
    found = [str(p) for p in looked_at if asked.search(p.read_text(encoding="utf-8")) and p.parent.name != "drives"]
    assert len(looked_at) > 150
    assert not found


def test_no_stage_knows_an_effect_by_name() -> None:
    """It asks for a trait, which an effect that is added may have too; which experiment tells two apart is a table."""
    named = re.compile("|".join(f'"{name}"' for name in table()))
    package = Path(rwn.__file__).parent
    looked_at = [p for p in package.rglob("*.py") if p.relative_to(package).parts[0] not in ("studies", "reference")]
    found = [p.name for p in looked_at if named.search(p.read_text(encoding="utf-8"))]
    assert found == ["next_experiment.py"]


LONGEST_FILE, LONGEST_FUNCTION = 300, 60  # lines: what a reader can hold at once
SOURCES = [p for top in ("python", "cpp", "tests", "bench", "tools") for p in (ROOT / top).rglob("*.[chp][py]*")]
SOURCES = [path for path in SOURCES if path.suffix in (".py", ".cpp", ".hpp")]


def test_no_file_is_long() -> None:
    assert SOURCES
    lines = {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8").count("\n") for path in SOURCES}
    assert not {name: count for name, count in lines.items() if count > LONGEST_FILE}


def test_no_line_of_c_plus_plus_is_long() -> None:
    """By .clang-format; ruff has the same limit for Python."""
    limit = int(re.search(r"ColumnLimit: (\d+)", (ROOT / ".clang-format").read_text(encoding="utf-8"))[1])  # type: ignore[index]
    lines = {
        f"{path.relative_to(ROOT)}:{k}": len(line)
        for path in SOURCES
        if path.suffix in (".cpp", ".hpp")
        for k, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
    }
    assert not {place: length for place, length in lines.items() if length > limit}


def test_no_function_is_long() -> None:
    """Of Python; `.clang-tidy` has the same limit for C++."""
    found = {
        f"{path.relative_to(ROOT)}: {node.name}": (node.end_lineno or 0) - node.lineno + 1
        for path in SOURCES
        if path.suffix == ".py"
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    }
    assert not {name: count for name, count in found.items() if count > LONGEST_FUNCTION}


def test_the_tests_mirror_the_rooms() -> None:
    """The reference implementations are what other tests compare with."""
    rooms = {path.parent.name for path in Path(rwn.__file__).parent.glob("*/__init__.py")} - {"reference"}
    assert {path.parent.name for path in (ROOT / "tests").glob("*/test_*.py")} == rooms


def test_a_test_that_is_named_for_a_module_stands_in_its_room() -> None:
    """The others are named for what a room, or the whole, does."""
    package, rooms = Path(rwn.__file__).parent, dict[str, set[str]]()
    for path in package.rglob("*"):
        room = "tests" if path.parent == package and path.is_file() else path.relative_to(package).parts[0]
        if room != "reference" and (path.is_dir() or path.suffix == ".py"):
            rooms.setdefault(path.stem, set()).add(room)
    named = [path for path in (ROOT / "tests").rglob("test_*.py") if path.stem.removeprefix("test_") in rooms]
    assert len(named) > 80
    assert not [str(path) for path in named if path.parent.name not in rooms[path.stem.removeprefix("test_")]]
