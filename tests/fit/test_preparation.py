"""From recordings to the problem of a fit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, recorded
from rwn.fit.preparation import prepare
from rwn.recording.speed_measurement import BACKWARD, CENTRAL, INSTANTANEOUS, SpeedMeasurement
from rwn.simulate import recorded_run

SHEET = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "resistance": 0.05})


@pytest.mark.slow
def test_recordings_with_different_signals_are_fitted_together() -> None:
    both = recorded(1, lambda w, _: -0.004 * np.sign(w))
    speed_alone = recorded(2, lambda w, _: -0.004 * np.sign(w))
    signals = {s: v for s, v in speed_alone.signals.items() if s != "current"}
    found = rwn.diagnose([replace(speed_alone, signals=signals), both], SHEET)
    assert [e.name for e in found.effects] == ["coulomb-friction"]
    assert found.effects[0].parameters["coulomb_torque"].value == pytest.approx(0.004, rel=0.03)


def test_each_signal_has_a_noise_level_whichever_recording_has_it() -> None:
    run = recorded(1, lambda *_: 0.0)
    names = (("voltage", "speed"), ("voltage", "current"))
    parts = [replace(run, name=str(k), signals={s: run.signals[s] for s in kept}) for k, kept in enumerate(names)]
    assert set(prepare(parts, SHEET).noise) == {"speed", "current"}


def test_one_sensor_measures_one_way_in_all_recordings(monkeypatch: pytest.MonkeyPatch) -> None:
    """A voltage that is held for five samples leaves the gaps of an average over five in the spectrum of the speed."""
    ways = iter([SpeedMeasurement(5, 0), CENTRAL, CENTRAL, BACKWARD, SpeedMeasurement(5, 0)])
    monkeypatch.setattr(recorded_run, "speed_measurement", lambda *_, **__: next(ways))
    model = rwn.Model(kind="dc", parameters=MOTOR)
    three = prepare([recorded(k, lambda *_: 0.0, 200) for k in range(3)], model)
    assert {run.speed_measured for run in three.runs} == {CENTRAL}
    two = prepare([recorded(k, lambda *_: 0.0, 200) for k in range(2)], model)
    assert {run.speed_measured for run in two.runs} == {BACKWARD}  # as many: what takes fewest samples


def test_a_difference_that_one_recording_shows_of_its_position_is_that_of_all(monkeypatch: pytest.MonkeyPatch) -> None:
    ways = iter([SpeedMeasurement(20, 0), INSTANTANEOUS, INSTANTANEOUS])
    monkeypatch.setattr(recorded_run, "speed_measurement", lambda *_, **__: next(ways))
    turned = [recorded(k, lambda *_: 0.0, 200) for k in range(3)]
    runs = [replace(r, signals=dict(r.signals) | {"position": np.cumsum(r.signals["speed"]) * 1e-3}) for r in turned]
    prepared = prepare(runs, rwn.Model(kind="dc", parameters=MOTOR))
    assert {run.speed_measured for run in prepared.runs} == {SpeedMeasurement(20, 0)}
