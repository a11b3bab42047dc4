"""`make check` runs the tests of what changed."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from tools.changed import ALWAYS, NO_MODULES, ROOT, paths_for


@pytest.mark.parametrize(
    ("file", "expected"),
    [
        ("python/rwn/fit/residual_noise.py", "tests/fit"),
        ("python/rwn/recording/formats/csv.py", "tests/recording"),
        ("cpp/src/networks/rates/thesis.cpp", "tests/networks"),
        ("cpp/include/rwn/model/effects/backlash.hpp", "tests/model"),
        ("python/rwn/diagnose.py", "tests/test_diagnose.py"),
        ("tests/name/test_forward.py", "tests/name/test_forward.py"),
        ("tests/made_up_motor.py", "tests/mismatch_map/test_dependence.py"),
        ("README.md", "tests/test_docs.py"),
    ],
)
def test_a_file_has_the_paths_for_its_room(file: str, expected: str) -> None:
    assert expected in paths_for([file])


def test_every_source_has_tests() -> None:
    """But for what is no module of its own; what all import has all."""
    command = ["git", "ls-files", "python/rwn/*.py", "cpp/src/*.cpp"]
    sources = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    assert len(sources) > 300
    bare = [source for source in sources if len(paths_for([source])) == len(ALWAYS)]
    assert {Path(source).name for source in bare} <= set(NO_MODULES)
    assert "tests" in paths_for(["python/rwn/errors.py"])


def test_the_walls_belong_to_all_and_what_is_gone_is_left_out() -> None:
    assert paths_for(["tests/test_gone.py"]) == list(ALWAYS)
