"""Waveforms of LabVIEW: their times are a step, and when each began."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from one_recording import RADIANS, RPM, TIME, VOLTAGE, imported
from rwn.errors import InputError
from rwn.recording.recording import read_recording


def _waveforms(path: Path, **speed: Any) -> Path:
    nptdms = imported("nptdms")
    began = np.datetime64("2026-03-01T12:00:00.000", "us")
    voltage = {"unit_string": "V", "wf_increment": 0.02, "wf_start_time": began}
    about = {**voltage, "unit_string": "rpm", **speed}
    with nptdms.TdmsWriter(path) as writer:
        channels = (("voltage", VOLTAGE, voltage), ("speed", RPM, about))
        writer.write_segment([nptdms.ChannelObject("G", name, x, properties=says) for name, x, says in channels])
    return path


def test_waveforms_that_began_apart_are_read_at_their_instants(tmp_path: Path) -> None:
    later = np.datetime64("2026-03-01T12:00:00.200", "us")  # ten samples
    read = read_recording(_waveforms(tmp_path / "a.tdms", wf_start_time=later))
    np.testing.assert_allclose(read.time, TIME[10:], atol=1e-9)
    np.testing.assert_allclose(read.signals["voltage"], VOLTAGE[10:])
    np.testing.assert_allclose(read.signals["speed"], RADIANS[:70])


@pytest.mark.parametrize("step", [0.0, "unknown", float("nan")])
def test_a_waveform_without_a_step_in_time_asks_for_it(step: Any, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"no column 'time'.*sample_time"):
        read_recording(_waveforms(tmp_path / "a.tdms", wf_increment=step))
