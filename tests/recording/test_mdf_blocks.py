"""Lists of blocks of an MDF 4 file that lead back into themselves, as fuzzing found one."""

from __future__ import annotations

import io
import struct
from pathlib import Path

import pytest

from one_recording import imported
from rwn.errors import InputError
from rwn.recording.formats.mdf_blocks import is_version_4, refuse_circles
from rwn.recording.recording import read_recording

FOUND = Path(__file__).parents[1] / "corpus" / "mf4" / "4ad3e8032c0e6dcee34beadb67d4bf61be6b1a4d"


def _file(*blocks: tuple[bytes, tuple[int, ...]]) -> io.BytesIO:
    """Blocks of 64 bytes each, the first at byte 64; links name them by their number from 1, 0: none."""
    text = b"MDF     4.10    ".ljust(64, b"\0")
    for kind, links in blocks:
        head = struct.pack("<4s4xQQ", kind, 64, len(links)) + b"".join(struct.pack("<Q", 64 * link) for link in links)
        text += head.ljust(64, b"\0")
    return io.BytesIO(text)


def test_lists_that_end_are_no_circle() -> None:
    refuse_circles(_file((b"##HD", (2,)), (b"##DG", (3, 4)), (b"##DG", (0, 4)), (b"##CG", (0, 5)), (b"##CN", (0, 0))))
    refuse_circles(_file((b"##HD", (2,)), (b"##TX", ())))
    refuse_circles(_file((b"##HD", (99,))))
    refuse_circles(io.BytesIO(b""))


@pytest.mark.parametrize(
    "blocks",
    [
        [(b"##HD", (2,)), (b"##DG", (2,))],
        [(b"##HD", (2,)), (b"##DG", (3,)), (b"##DG", (2,))],
        [(b"##HD", (2,)), (b"##DG", (0, 3)), (b"##CG", (4, 0)), (b"##CG", (3, 0))],
        [(b"##HD", (2,)), (b"##DG", (0, 3)), (b"##CG", (0, 4)), (b"##CN", (5,)), (b"##CN", (4,))],
        [(b"##HD", (2,)), (b"none", (2,))],
    ],
)
def test_a_circle_is_refused(blocks: list[tuple[bytes, tuple[int, ...]]]) -> None:
    with pytest.raises(ValueError, match="follows itself"):
        refuse_circles(_file(*blocks))


def test_the_file_that_was_found_is_refused_at_once(tmp_path: Path) -> None:
    imported("asammdf")
    with pytest.raises(InputError, match="the file is not MDF, or it is damaged"):
        read_recording(_copied(tmp_path))


def test_a_file_of_version_3_is_told_how_to_be_converted(tmp_path: Path) -> None:
    imported("asammdf")
    assert not is_version_4(io.BytesIO(b"MDF     3.30    ".ljust(64, b"\0") + b"HD"))
    (tmp_path / "a.mdf").write_bytes(b"MDF     3.30    ".ljust(64, b"\0") + b"HD".ljust(200, b"\0"))
    with pytest.raises(InputError, match=r"the file is not MDF 4; .*convert\('4\.10'\)"):
        read_recording(tmp_path / "a.mdf")


def _copied(folder: Path) -> Path:
    (folder / "a.mf4").write_bytes(FOUND.read_bytes())
    return folder / "a.mf4"
