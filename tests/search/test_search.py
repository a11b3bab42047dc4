"""What a search hands on: what recordings told of themselves, and what it has found to the next one."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.measurement.likeliest_law import stating
from rwn.recording.intersample import HELD
from rwn.recording.speed_measurement import BACKWARD, CENTRAL, INSTANTANEOUS, SpeedMeasurement
from rwn.search import search as search_module
from rwn.search.search import _Assumptions, _stating_speed, search
from rwn.simulate.recorded_run import run_of

MODEL = rwn.Model(kind="dc", parameters=MOTOR)


@pytest.mark.parametrize(("way", "stated"), [(BACKWARD, (1, 0)), (CENTRAL, (1, 1)), (INSTANTANEOUS, (0, 0))])
def test_how_a_speed_was_measured_is_stated_for_others(way: SpeedMeasurement, stated: tuple[int, int]) -> None:
    signals = {"voltage": np.ones(50), "speed": np.linspace(0.0, 1.0, 50)}
    recording = rwn.Recording(name="run", time=1e-3 * np.arange(50), signals=signals)
    run = replace(run_of(recording, MODEL), speed_measured=way)
    assert _stating_speed(MODEL, [run]).recording.speed_rows == stated
    assert _stating_speed(MODEL, [replace(run, speed=np.empty(0))]).recording.speed_rows is None


@pytest.mark.parametrize(("added", "passed"), [(("backlash", "unbalance"), True), (("unbalance",), True), ((), False)])
def test_the_best_explanation_is_known_to_the_next_search(
    added: tuple[str, ...], passed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A search under another law between rows may not come upon it again."""
    leading = SimpleNamespace(added=added)
    ranking = SimpleNamespace(
        fits=[SimpleNamespace(fit=leading)], left=SimpleNamespace(at_the_floor=False),
        problem=SimpleNamespace(whole=[], filters={}),
    )  # fmt: skip
    laws, known = iter(["interpolated", HELD]), list[list[Any]]()

    def explained(*_: object, **options: Any) -> tuple[list[Any], Any]:
        known.append(list(options.get("known", ())))
        return [], ranking

    for name, stands_in in {
        "with_intersample": lambda _recordings, model: model,
        "powered": lambda recordings, *_: recordings,
        "_as_acted": lambda recordings, *_: recordings,
        "_without_sensor_errors": lambda recordings, *_: (recordings, ()),
        "_asked_again": lambda _r, model, late, *_: _Assumptions(late, stating(model, next(laws)), ()),
        "_filters": lambda *_: (),
        "_tells_more": lambda *_: False,
        "contradicted": lambda _: [],
        "beneath_faults": explained,
    }.items():
        monkeypatch.setattr(search_module, name, stands_in)
    search([], MODEL, late=(), say=lambda *_: None)
    assert known == [[], *[[leading] if passed else []] * 2]
