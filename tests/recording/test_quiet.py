"""What a format's library logs of a damaged file is not printed beside the one line that refuses it."""

from __future__ import annotations

import logging

import pytest

from rwn.recording.formats.extra import quiet


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
