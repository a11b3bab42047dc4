"""What fuzzing has found is read again, and altered: a reader raises InputError, or nothing."""

from __future__ import annotations

import random
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))  # tools are no part of the package

from tools.trust.cases import damage  # noqa: E402
from tools.trust.fuzz import CORPUS, TARGETS  # noqa: E402
from tools.trust.hostile import GOOD, ended  # noqa: E402

ALTERED = 20  # inputs for each target, made of its corpus


@pytest.mark.parametrize("target", [pytest.param(t, marks=pytest.mark.slow) if t == "mf4" else t for t in TARGETS])
def test_a_reader_refuses_or_reads(target: str) -> None:
    corpus = [path.read_bytes() for path in sorted((CORPUS / target).iterdir())]
    assert corpus
    draw = random.Random(target)
    for data in corpus:
        TARGETS[target](data)
    for _ in range(ALTERED):
        TARGETS[target](damage(draw.choice(corpus), draw))


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="forks a process that has loaded rwn")
def test_the_table_of_hostile_inputs() -> None:
    """The cases by hand; `make hostile` runs damaged files beside them. A small process is soon forked."""
    command = [sys.executable, "-m", "tools.trust.hostile", "--damaged", "0"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    (counted,) = [line for line in done.stdout.splitlines() if line.startswith("| all |")]
    assert int(counted.split("|")[2]) > 400


@pytest.mark.slow
def test_what_does_not_end_well_is_counted_so(tmp_path: Path) -> None:
    """The counts would show a traceback, nonsense and an unclear line."""
    from tools.trust.cases import Case
    from tools.trust.good_files import write_recordings

    write_recordings(tmp_path)
    good = Case(kind="", what="")
    assert ended(good, tmp_path)[0] == "nonsense accepted"
    assert ended(Case(kind="", what="", refuse=False), tmp_path)[0] == "accepted"
    assert ended(Case(kind="", what="", command=("trials",)), tmp_path)[0] == "unclear line"  # a page of help
    assert set(GOOD) == {"clear line", "no result, said", "accepted"}
