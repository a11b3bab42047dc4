"""Damaged files of other formats than CSV: one line, and nothing of what a library logs beside it."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
import pytest

from rwn.errors import InputError
from rwn.recording.formats.extra import quiet
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
