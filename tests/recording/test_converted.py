"""Files that are read once another tool has converted them: the refusal says how."""

from __future__ import annotations

from pathlib import Path

import pytest

from rwn.errors import InputError
from rwn.recording.recording import read_recording


@pytest.mark.parametrize("name", ["run.db3", "run.DB3"])
def test_a_bag_in_sqlite_is_converted_to_mcap(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(b"SQLite format 3\0" + bytes(84))
    with pytest.raises(InputError) as refusal:
        read_recording(tmp_path / name)
    said = str(refusal.value)
    assert f"mcap convert {tmp_path / name} run.mcap" in said
    assert "ros2 bag convert" in said
    assert "CSV" not in said


def test_the_folder_of_a_bag_in_sqlite_is_answered_as_its_file(tmp_path: Path) -> None:
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "run_0.db3").write_bytes(b"SQLite format 3\0" + bytes(84))
    with pytest.raises(InputError, match=r"mcap convert .*run_0\.db3 run_0\.mcap, or ros2 bag convert"):
        read_recording(tmp_path / "run")
    (tmp_path / "run" / "run_0.mcap").write_bytes(b"not yet")  # what it was converted to goes before
    with pytest.raises(InputError, match="not MCAP"):
        read_recording(tmp_path / "run")


def test_any_other_file_is_exported_as_csv(tmp_path: Path) -> None:
    (tmp_path / "run.sqlite").write_bytes(b"SQLite format 3\0")
    with pytest.raises(InputError, match="export the recording as CSV"):
        read_recording(tmp_path / "run.sqlite")
