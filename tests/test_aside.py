"""The folders of the commands of trust: gone at their end, and those of killed ones at the next start."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from tools.trust.aside import folder_aside, new_folder, sweep

KILLED = "import os, signal; from tools.trust.aside import new_folder; print(new_folder('x'), flush=True);"


@pytest.fixture(autouse=True)
def temporary(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", None)
    return tmp_path


def test_a_folder_of_a_killed_process_is_removed_at_the_next_start(temporary: Path) -> None:
    command = [sys.executable, "-c", f"{KILLED} os.kill(os.getpid(), signal.SIGKILL)"]
    done = subprocess.run(command, cwd=Path(__file__).parents[1], stdout=subprocess.PIPE, text=True, check=False)
    left = Path(done.stdout.strip())
    assert left.is_dir()
    assert left.parent == temporary
    (left / "recording.csv").touch()
    mine = new_folder("x")
    assert [*temporary.iterdir()] == [mine]


def test_folders_of_others_stay(temporary: Path) -> None:
    kept = {f"rwn-x-{os.getppid()}-abc", f"rwn-x-{os.getpid()}-abc", "rwn-x-abc", "rwn-xy-99999999-abc", "rwn-x-a-b"}
    for name in (*kept, "rwn-x-99999999-abc"):
        (temporary / name).mkdir()
    sweep("x")
    assert {path.name for path in temporary.iterdir()} == kept


def test_a_folder_is_gone_after_the_block_also_where_it_fails(temporary: Path) -> None:
    with folder_aside("x") as made:
        assert made.is_dir()
    assert not [*temporary.iterdir()]
    with pytest.raises(FileExistsError), folder_aside("x") as made:
        made.mkdir()
    assert not [*temporary.iterdir()]
