"""Files whose one run has a name: it may be said or not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from one_recording import TIME, VOLTAGE, imported
from rwn.errors import InputError
from rwn.recording.recording import read_recording


def test_the_only_group_of_a_tdms_file_may_be_named(tmp_path: Path) -> None:
    nptdms = imported("nptdms")
    named = {"time [s]": TIME, "voltage [V]": VOLTAGE, "speed [rad/s]": VOLTAGE}
    with nptdms.TdmsWriter(tmp_path / "a.tdms") as writer:
        writer.write_segment([nptdms.ChannelObject("G", name, np.asarray(values)) for name, values in named.items()])
    alone, by_name = (read_recording(f"{tmp_path / 'a.tdms'}{part}") for part in ("", "#G"))
    assert np.array_equal(alone.time, by_name.time)
    assert np.array_equal(alone.signals["speed"], by_name.signals["speed"])
    with pytest.raises(InputError, match="there is no part 'H'; expected one of G"):
        read_recording(f"{tmp_path / 'a.tdms'}#H")
