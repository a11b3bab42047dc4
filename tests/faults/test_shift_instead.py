"""A channel that is late where a filter of another one hides it from a look at the nominal model."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

import rwn
from ranked import ranked, ranked_from
from rwn.faults import delay
from rwn.faults.delay import shift_instead
from rwn.fit.preparation import prepare
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered
from rwn.measurement.levels import all_levels, with_levels
from rwn.model.model import Model

DEMO = Path(rwn.__file__).parent / "demo"
KEPT = 0.5  # by the filter of the current


@pytest.fixture(scope="module")
def model() -> Model:
    return rwn.read_model(DEMO / "model.toml")


def _recording(model: Model, *, late: int, lag: float) -> rwn.Recording:
    """A run of the model itself: its speed so many rows late, or behind its sensor's lag; its current filtered."""
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    recording = recording.beginning(len(recording) // 2)
    rng = np.random.default_rng(1)
    effects = {"speed-sensor-lag": {"time_constant": lag}} if lag else {}
    out = rwn.simulate(replace(model, effects=effects), recording).signals
    noisy = {s: out[s] + 0.01 * out[s].std() * rng.standard_normal(out[s].size) for s in ("current", "speed")}
    speed = np.concatenate([np.full(late, noisy["speed"][0]), noisy["speed"][: noisy["speed"].size - late]])
    signals = {
        "voltage": recording.signals["voltage"],
        "current": lfilter([1.0 - KEPT], [1.0, -KEPT], noisy["current"]),
        "speed": speed,
    }
    return rwn.Recording(name="run", time=recording.time, signals=signals)


@pytest.mark.parametrize(("late", "lag"), [(2, 0.0), (0, 4e-3)])
def test_a_speed_is_late_where_that_fits_as_well_as_the_law_of_its_sensor(model: Model, late: int, lag: float) -> None:
    recordings = [_recording(model, late=late, lag=lag)]
    step = float(np.median(np.diff(recordings[0].time)))
    known = [SensorFilter(signal="current", share=KEPT, time_constant=-step / np.log(KEPT), digital=True)]
    problem = filtered(prepare(recordings, model), known)
    names = ["speed-moving-average", "speed-sensor-lag"]
    ranking = ranked(problem, names, at_once=1)
    assert ranking.fits[0].added[0] in names
    fault = shift_instead(recordings, model, known, ranking)
    if late:
        assert fault is not None
        assert (fault.signals[0], fault.delay) == ("speed", late)
        assert fault.removes is not None
        assert fault.removes.share > 0.9
    else:
        assert fault is None


def test_a_bias_of_a_sensor_is_no_lag_that_a_late_channel_may_be_instead(
    model: Model, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What was named does not delay: nothing asks for a shift in its place."""
    late = _recording(model, late=2, lag=0.0)
    late = replace(late, signals={**late.signals, "current": late.signals["current"] + 0.1})
    ranking = ranked_from([late], model, ["sensor-bias"], at_once=1)
    biased = next(r for r in ranking.fits if r.added == ("sensor-bias",))
    monkeypatch.setattr(delay, "_shifts", lambda *_: pytest.fail("it was asked"))
    assert shift_instead([late], model, [], replace(ranking, fits=(biased,))) is None


@pytest.mark.parametrize("late", [True, False])
def test_a_current_is_late_where_that_fits_as_well_as_an_input_that_is(model: Model, late: bool) -> None:
    """The inductance gives way to the delay that was named, and the speed hardly shows it."""
    model = replace(model, uncertainty={**model.uncertainty, "inductance": 0.2})
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    recording = recording.beginning(len(recording) // 2)
    step = float(np.median(np.diff(recording.time)))
    effects = {} if late else {"input-delay": {"delay": step}}
    out = rwn.simulate(replace(model, effects=effects), recording).signals
    rng = np.random.default_rng(1)
    noisy = {s: out[s] + 0.01 * out[s].std() * rng.standard_normal(out[s].size) for s in ("current", "speed")}
    if late:
        noisy["current"] = np.append(noisy["current"][0], noisy["current"][:-1])
    signals = {"voltage": recording.signals["voltage"], **noisy}
    recordings = [rwn.Recording(name="run", time=recording.time, signals=signals)]
    ranking = ranked_from(recordings, model, ["input-delay"], at_once=1)
    assert ranking.fits[0].added == ("input-delay",)
    fault = shift_instead(recordings, model, [], ranking)
    assert (fault and (fault.signals, fault.delay)) == ((("current",), 1) if late else None)


def test_what_differs_between_files_stays_known(model: Model) -> None:
    """Without the levels both errors are large, and the half sample by which the speed lags is lost in them."""
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    step = float(np.median(np.diff(recording.time)))
    recordings = [
        replace(_recording(replace(model, parameters=warmer), late=0, lag=0.5 * step), name=f"{k}")
        for k in (0.77, 1.3)
        for warmer in [{**model.parameters, "resistance": k * model.parameters["resistance"]}]
    ]
    known = [SensorFilter(signal="current", share=KEPT, time_constant=-step / np.log(KEPT), digital=True)]
    bare = prepare(recordings, model)
    (level,) = (level for level in all_levels(bare) if level.quantity == "resistance")
    ranking = ranked(filtered(with_levels(bare, level), known), ["speed-moving-average"], at_once=1)
    assert ranking.fits[0].added == ("speed-moving-average",)
    assert shift_instead(recordings, model, known, ranking) is None
