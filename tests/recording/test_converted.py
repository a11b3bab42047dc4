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


def test_any_other_file_is_exported_as_csv(tmp_path: Path) -> None:
    (tmp_path / "run.sqlite").write_bytes(b"SQLite format 3\0")
    with pytest.raises(InputError, match="export the recording as CSV"):
        read_recording(tmp_path / "run.sqlite")
