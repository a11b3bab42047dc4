"""What continuous integration runs: the tests, then the fuzzing of the corpus in what time is left."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
MAKE = """#!/bin/sh
echo "$*" >>made
echo $(($(cat clock) + $TOOK)) >clock
[ "$1" != "$FAILS" ]
"""


def _made(tmp_path: Path, *, took: int, fails: str = "") -> tuple[int, list[str]]:
    """Exit code, and what make was asked for, where it takes so long [s]; the clock begins at 1000."""
    (tmp_path / ".ci").mkdir()
    (tmp_path / "bin").mkdir()
    shutil.copy(ROOT / ".ci/run", tmp_path / ".ci/run")
    (tmp_path / "clock").write_text("1000")
    for name, text in {"make": MAKE, "date": "#!/bin/sh\ncat clock\n"}.items():
        (tmp_path / "bin" / name).write_text(text)
        (tmp_path / "bin" / name).chmod(0o755)
    known = {"PATH": f"{tmp_path / 'bin'}:/usr/bin:/bin", "TOOK": str(took), "FAILS": fails}
    done = subprocess.run(["bash", ".ci/run"], cwd=tmp_path, env=known, capture_output=True, text=True, check=False)
    assert done.stderr == ""
    return done.returncode, (tmp_path / "made").read_text().splitlines()


@pytest.mark.parametrize(("took", "until"), [(200, 1740), (300, 1870), (450, 1870)])
def test_fuzzing_follows_the_tests_until_a_last_moment(took: int, until: int, tmp_path: Path) -> None:
    code, made = _made(tmp_path, took=took)
    assert code == 0
    assert made == ["test", "test-slow", f"fuzz-corpus SECONDS=600 UNTIL={until} PAGE="]


def test_a_finding_fails(tmp_path: Path) -> None:
    code, made = _made(tmp_path, took=1, fails="fuzz-corpus")
    assert code != 0
    assert len(made) == 3


@pytest.mark.parametrize("fails", ["test", "test-slow"])
def test_nothing_is_fuzzed_where_a_test_fails(fails: str, tmp_path: Path) -> None:
    code, made = _made(tmp_path, took=1, fails=fails)
    assert code == 1
    assert made[-1] == fails
