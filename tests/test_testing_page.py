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

NAMES = re.findall(
    r"^([\w-]+):.*\n(?:\t.*\n)*?\t\$\(TRUST\)", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE
)


def test_each_command_has_a_section() -> None:
    assert len(NAMES) == 9
    check_sections(ROOT / "docs/testing.md", page.COMMAND, NAMES)


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
    summary = {f"{kind}_{what}": 50 for kind in ("line", "function", "branch") for what in ("total", "percent")}
    (tmp_path / "found.json").write_text(json.dumps(summary))
    assert "| branches | 50 | 50.0% |" in of_cpp(tmp_path / "found.json")[0]
