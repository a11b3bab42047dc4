"""docs/testing.md has a section for each command that finds figures of the tests, and the figures count right."""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

import pytest

from rwn.studies.sections import check_sections

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))  # tools are no part of the package

from tools.trust import page  # noqa: E402
from tools.trust.coverage import of_cpp, of_python  # noqa: E402
from tools.trust.mutants import FILES  # noqa: E402

NAMES = re.findall(
    r"^([\w-]+):.*\n(?:\t.*\n)*?\t\$\(TRUST\)", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE
)


def test_each_command_has_a_section() -> None:
    assert len(NAMES) == 10
    check_sections(ROOT / "docs/testing.md", page.COMMAND, NAMES)


def test_the_files_and_the_tests_of_the_mutants_are_there() -> None:
    """Where one is not, no mutant is tried: the tests fail on what is not altered."""
    named = [*FILES, *(test for tests in FILES.values() for test in tests)]
    assert not [name for name in named if not (ROOT / name).is_file()]


def test_a_figure_goes_into_its_section_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written = tmp_path / "page.md"
    written.write_text("a\n<!-- make soak -->\nold\n<!-- end -->\nb\n<!-- make kills -->\nkept\n<!-- end -->\n")
    page.show("soak", written, "1 diagnosis", page.table(("x",), [(1,)]))
    text = written.read_text()
    assert "old" not in text
    assert "1 diagnosis\n\n| x |\n| --- |\n| 1 |\n<!-- end -->\nb\n<!-- make kills -->\nkept\n" in text
    assert "1 diagnosis" in capsys.readouterr().out


def test_coverage_counts_lines_and_branches(tmp_path: Path) -> None:
    keys = ("num_statements", "covered_lines", "num_branches", "covered_branches")
    counts = {"rwn/fit/a.py": (10, 9, 4, 2), "rwn/cli.py": (10, 5, 0, 0), "rwn/reference/x.py": (9, 0, 9, 0)}
    files = {name: {"summary": dict(zip(keys, numbers, strict=True))} for name, numbers in counts.items()}
    (tmp_path / "found.json").write_text(json.dumps({"files": files}))
    rows, least = of_python(tmp_path / "found.json")
    assert "| fit | 10 | 90.0% | 4 | 50.0% |" in rows
    assert "| all | 20 | 70.0% | 4 | 50.0% |" in rows
    assert least.startswith("Most branches are not reached in fit/a.py (2 of 4)")


def test_a_condition_of_a_template_counts_once(tmp_path: Path) -> None:
    """Two instances of a template took one way each; a condition that only the compiler asks took none."""
    branches = [[7, 3, 7, 9, 5, 0, 0, 0, 4], [7, 3, 7, 9, 0, 2, 0, 0, 4], [8, 3, 8, 9, 0, 0, 0, 0, 4]]
    files = [
        {"filename": f"/x/cpp/{name}", "summary": {"lines": {"count": 10, "covered": covered}}, "branches": found}
        for name, covered, found in (
            ("include/rwn/fit/a.hpp", 9, branches), ("src/fit/a.cpp", 10, []), ("kernels/b.cpp", 5, branches[:1]),
        )
    ]  # fmt: skip
    (tmp_path / "found.json").write_text(json.dumps({"data": [{"files": files}]}))
    rows, least = of_cpp(tmp_path / "found.json")
    assert "| fit | 20 | 95.0% | 4 | 50.0% |" in rows
    assert "| kernels | 10 | 50.0% | 2 | 50.0% |" in rows
    assert "| all | 30 | 80.0% | 6 | 50.0% |" in rows
    assert least.startswith("Most branches are not reached in include/rwn/fit/a.hpp (2 of 4)")
