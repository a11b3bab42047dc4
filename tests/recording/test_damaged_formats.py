"""Damaged files of other formats than CSV: one line, and nothing of what a library logs beside it."""

from __future__ import annotations

import logging
import random
import struct
from pathlib import Path

import numpy as np
import pytest
import scipy.io
import scipy.sparse

from rwn.errors import InputError
from rwn.recording.formats.extra import quiet
from rwn.recording.formats.mat_elements import check_elements
from rwn.recording.recording import read_recording


def test_loggers_below_with_levels_of_their_own_are_quiet_too(caplog: pytest.LogCaptureFixture) -> None:
    """As those of npTDMS are."""
    above, below = logging.getLogger("some"), logging.getLogger("some.reader")
    below.setLevel(logging.WARNING)
    with quiet("some"):
        above.error("damaged")
        below.warning("damaged")
    assert not caplog.records
    below.warning("told")
    assert [record.message for record in caplog.records] == ["told"]
    assert below.level == logging.WARNING


def test_arrays_in_a_zip_of_a_later_version_are_refused(tmp_path: Path) -> None:
    """Found by fuzzing: zipfile raises NotImplementedError."""
    np.savez(tmp_path / "a.npz", time=np.arange(3.0))
    content = bytearray((tmp_path / "a.npz").read_bytes())
    content[content.index(b"PK\x01\x02") + 6] = 110  # version 11.0
    (tmp_path / "a.npz").write_bytes(content)
    with pytest.raises(InputError, match=r"a\.npz: the arrays cannot be read"):
        read_recording(tmp_path / "a.npz")


def test_a_unit_of_tdms_that_is_a_number_is_refused(tmp_path: Path) -> None:
    """Found by fuzzing: a property may be of any type."""
    nptdms = pytest.importorskip("nptdms")
    with nptdms.TdmsWriter(tmp_path / "a.tdms") as writer:
        for name, unit in (("time", "s"), ("voltage", "V"), ("speed", 5)):
            channel = nptdms.ChannelObject("Bench", name, np.arange(40.0), properties={"unit_string": unit})
            writer.write_segment([channel])
    with pytest.raises(InputError, match=r"a\.tdms, column 'speed': unknown unit '5'; .*; fix: "):
        read_recording(tmp_path / "a.tdms")


NESTED = {"x": np.arange(40.0), "s": {"a": {"b": np.arange(5)}, "c": "text", "d": np.array([[1, "y"]], dtype=object)}}


@pytest.mark.parametrize("packed", [False, True])
def test_a_mat_file_as_it_must_be_is_left_to_scipy(packed: bool, tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "a.mat", NESTED, do_compression=packed)
    check_elements(tmp_path / "a.mat")
    content = (tmp_path / "a.mat").read_bytes()
    (tmp_path / "a.mat").write_bytes(content[:-9])
    with pytest.raises(ValueError, match="an element of type"):
        check_elements(tmp_path / "a.mat")


@pytest.mark.parametrize(("kind", "size"), [(0x1974, 320), (9, 2**31), (9, 1 << 20)])
def test_a_type_that_there_is_not_does_not_reach_scipy(kind: int, size: int, tmp_path: Path) -> None:
    """Found by fuzzing: scipy 1.17 looks the type up beyond the end of a table, and the process ends with SIGSEGV."""
    scipy.io.savemat(tmp_path / "a.mat", {"x": np.arange(40.0)})
    content = (tmp_path / "a.mat").read_bytes()
    numbers = struct.pack("<II", 9, 320)
    assert content.count(numbers) == 1
    (tmp_path / "a.mat").write_bytes(content.replace(numbers, struct.pack("<II", kind, size)))
    with pytest.raises(InputError, match=r"a\.mat: this is not a \.mat file, or it is damaged"):
        read_recording(tmp_path / "a.mat")


@pytest.mark.parametrize(("flags", "found"), [((6 | 0x800, 0), "its numbers"), ((5, 9), "its numbers"), ((), "flags")])
def test_numbers_that_a_matrix_lacks_are_not_read_behind_it(flags: tuple[int, ...], found: str, tmp_path: Path) -> None:
    """scipy would take the next variable for the imaginary part, and its tag for a type of numbers."""
    scipy.io.savemat(tmp_path / "a.mat", {"x": np.arange(40.0), "y": np.arange(40.0)})
    content = (tmp_path / "a.mat").read_bytes()
    before = struct.pack("<IIII", 6, 8, 6, 0)
    assert content.count(before) == 2
    altered = struct.pack("<IIII", 6, 8, *flags) if flags else struct.pack("<IIII", 6, 4, 6, 0)
    (tmp_path / "a.mat").write_bytes(content.replace(before, altered, 1))
    with pytest.raises(ValueError, match=f"a matrix without {found}"):
        check_elements(tmp_path / "a.mat")
    with pytest.raises(InputError, match=r"a\.mat: this is not a \.mat file, or it is damaged"):
        read_recording(tmp_path / "a.mat")


def test_complex_and_sparse_matrices_are_left_to_scipy(tmp_path: Path) -> None:
    given = {"c": np.arange(4.0) + 1j, "s": scipy.sparse.eye_array(4, format="csc"), "e": np.empty((0, 0)), "t": "text"}
    scipy.io.savemat(tmp_path / "a.mat", given)
    check_elements(tmp_path / "a.mat")


@pytest.mark.parametrize(
    ("at", "put"), [(0, b"MAATLB"), (0, b"Octave"), (124, b"\x02\x01IM"), (124, b"\x01\x02MI"), (124, b"\x00\x01IX")]
)
def test_a_header_that_scipy_does_not_look_at_hides_nothing(at: int, put: bytes, tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "a.mat", {"x": np.arange(40.0)})
    content = bytearray((tmp_path / "a.mat").read_bytes()[:-1])
    content[at : at + len(put)] = put
    (tmp_path / "a.mat").write_bytes(content)
    with pytest.raises(ValueError, match=r"an element of type|a version that there is not"):
        check_elements(tmp_path / "a.mat")


@pytest.mark.parametrize("packed", [pytest.param(False, marks=pytest.mark.slow), True])
def test_whatever_bytes_are_altered_it_ends(packed: bool, tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "a.mat", NESTED, do_compression=packed)
    content, draw = (tmp_path / "a.mat").read_bytes(), random.Random(1)
    for _ in range(60):
        altered = bytearray(content)
        for _ in range(3):
            altered[draw.randrange(128, len(altered))] = draw.randrange(256)
        (tmp_path / "a.mat").write_bytes(altered)
        with pytest.raises(InputError):
            read_recording(tmp_path / "a.mat")


def test_structs_nested_beyond_reason_are_refused(tmp_path: Path) -> None:
    inner = b""
    for _ in range(100):
        inner = struct.pack("<IIIIII", 14, 16 + len(inner), 6, 8, 1, 0) + inner
    (tmp_path / "a.mat").write_bytes(b"MATLAB 5.0".ljust(124) + b"\x00\x01IM" + inner)
    with pytest.raises(ValueError, match="an element of type 14"):
        check_elements(tmp_path / "a.mat")
