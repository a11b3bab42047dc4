"""Results are kept by the numbers that they were made from, and by nothing else."""

from __future__ import annotations

import numpy as np
import pytest

from rwn.recording import speed_measurement as module
from rwn.recording.by_content import ByContent
from rwn.recording.speed_measurement import CENTRAL, INSTANTANEOUS, speed_measurement


def test_arrays_that_hold_the_same_are_one_key_and_others_are_not() -> None:
    kept = ByContent[str]()
    time, empty = np.arange(4.0), np.empty(0)
    key = kept.key(time, empty)
    assert key == kept.key(np.arange(8.0)[::2] / 2.0, empty)
    others = [(empty, time), (time[:3], time[3:]), (time.astype(np.float32), empty), (time.reshape(2, 2), empty)]
    others.append((np.nextafter(time, 9.0), empty))
    assert len({key, *(kept.key(*pair) for pair in others)}) == 1 + len(others)


def test_the_oldest_is_forgotten() -> None:
    kept = ByContent[str](kept=2)
    for name in (b"a", b"b", b"c"):
        assert kept.keep(name, name.decode()) == name.decode()
    assert [kept.get(name) for name in (b"a", b"b", b"c")] == [None, "b", "c"]


def test_a_speed_is_looked_at_once_for_all_that_is_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    looked = []
    real = module._measured
    monkeypatch.setattr(module, "_measured", lambda *args: looked.append(1) or real(*args))
    time = 1e-3 * np.arange(400)
    position = np.sin(7.3 * time) + 1e-4 * np.random.default_rng(77).standard_normal(400)
    speed = np.gradient(position, time)
    for _ in range(3):
        assert speed_measurement(time, speed, position) == CENTRAL
    assert len(looked) == 1
    assert speed_measurement(time, np.cos(7.3 * time), np.empty(0)) == INSTANTANEOUS
    assert len(looked) == 2
