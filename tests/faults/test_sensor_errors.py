"""Spikes that the motion hid, told by what the best explanation leaves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import rwn
from made_up_files import files_of
from ranked import ranked_from
from rwn.faults.fault import SHIFT, UNIT, Fault
from rwn.faults.sensor_errors import _far_off, _of_steps, without_sensor_errors
from rwn.fit.fit import fit_nominal
from rwn.fit.preparation import prepare
from rwn.model.model import Model
from rwn.search.search import _without_sensor_errors, search

MOTOR = {
    "resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 2e-5,
    "viscous_friction": 4e-5,
}  # fmt: skip
MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "resistance": 0.1})
STEP = 300  # a sample at which the voltage steps


def _recordings(spikes: Mapping[str, Sequence[int]], size: float = 1.5) -> list[rwn.Recording]:
    """Two runs; in the first, spikes of so many times the range of a signal at some samples."""
    first, second = files_of(MODEL, [], (1.0, 1.0))
    signals = dict(first.signals)
    for name, at in spikes.items():
        signals[name] = signals[name].copy()
        signals[name][list(at)] += size * np.ptp(first.signals["current"])
    return [replace(first, signals=signals), second]


def _left_out(recordings: Sequence[rwn.Recording], model: Model = MODEL) -> dict[str, list[int]]:
    """The samples of the first recording that the fitted model says are spikes."""
    problem = prepare(recordings, model)
    found = without_sensor_errors(recordings, problem.in_free_run(), fit_nominal(problem))
    assert not found.recordings[1].missing
    assert sum(f.count for f in found.findings) == sum(int(m.sum()) for m in found.recordings[0].missing.values())
    return {s: np.flatnonzero(m).tolist() for s, m in found.recordings[0].missing.items()}


@pytest.mark.parametrize("late", [0, 1, 2, 25])
def test_a_spike_that_steps_of_the_current_hide_is_told_by_what_a_fit_leaves(late: int) -> None:
    assert _left_out(_recordings({"current": [STEP + late]}, size=0.1)) == {"current": [STEP + late]}


def test_several_of_both_signals_are_found() -> None:
    spikes = {"current": [101, 102 + 50, 401], "speed": [301, 450]}
    assert _left_out(_recordings(spikes)) == spikes


def test_an_error_at_either_end_has_nothing_beside_it_to_be_told_by() -> None:
    error = 1e-3 * np.random.default_rng(4).standard_normal(400)
    error[[0, -1]] = 5.0
    assert not _far_off(error, 1e-3).any()
    error[[0, -1]], error[200] = 0.0, 5.0
    assert np.flatnonzero(_far_off(error, 1e-3)).tolist() == [200]


def test_what_a_model_has_wrong_at_every_step_is_no_spike() -> None:
    """A winding ten times as fast peaks within a sample, at the largest step the most."""
    recordings = _recordings({})
    assert not _left_out(recordings)
    assert not _left_out(recordings, replace(MODEL, parameters={**MOTOR, "inductance": 1e-4}))


def test_what_is_off_at_most_steps_is_the_models() -> None:
    """Rows that are noted a moment late hold a current that has begun to rise, beside each step alone."""
    stepped = np.zeros(600, dtype=bool)
    for begin in range(50, 600, 100):
        stepped[begin : begin + 4] = True
    changed = stepped.copy()
    changed[81] = True  # a small step
    flags = np.zeros(600, dtype=bool)
    flags[[30, 51, 81, 151, 251, 351]] = True
    assert np.flatnonzero(_of_steps(flags, stepped, changed)).tolist() == [51, 81, 151, 251, 351]
    flags[[251, 351]] = False
    assert not _of_steps(flags, stepped, changed).any(), "two of six steps may have one by chance"


def test_a_recording_noted_late_after_steps_has_no_spikes() -> None:
    recordings = _recordings({})
    rows = np.flatnonzero(np.diff(recordings[0].signals["voltage"])) + 1
    assert rows.size > 2
    recordings = _recordings({"current": rows.tolist()}, size=0.2)
    problem = prepare(recordings, MODEL)
    found = without_sensor_errors(recordings, problem.in_free_run(), fit_nominal(problem))
    assert not [f for f in found.findings if f.kind == "spikes"]


def test_the_search_begins_anew_without_them() -> None:
    recordings = _recordings({"current": [STEP]}, size=0.5)
    found = search(recordings, MODEL, late=(), say=lambda *_: None)
    assert [(f.recording, f.signals, f.count) for f in found.findings if f.kind == "spikes"] == [
        ("run_0", ("current",), 1)
    ]
    assert np.flatnonzero(found.ranking.problem.whole[0].not_compared("current")).tolist() == [STEP]
    assert found.ranking.left.at_the_floor


@pytest.mark.parametrize("fault", [{"name": SHIFT, "delay": 2}, {"name": UNIT, "factor": 9.55}])
def test_none_are_left_out_where_a_fault_is_undone(fault: dict[str, Any]) -> None:
    """The samples of these recordings are not those that the explanation is of."""
    recordings = _recordings({"current": [STEP]}, size=0.5)
    ranking = ranked_from(recordings, MODEL, ["coulomb-friction"], at_once=1)
    found = Fault(signals=("speed",), meaning="", **fault)
    assert _without_sensor_errors(recordings, [found], ranking).findings == ()
    assert len(_without_sensor_errors(recordings, [], ranking).findings) == 1


def test_hum_that_the_motion_hides_is_taken_off_and_said() -> None:
    first, second = files_of(MODEL, [], (1.0, 1.0), samples=2400)
    hum = 0.05 * np.sin(2.0 * np.pi * 50.0 * first.time + 0.4)
    noisy = replace(first, signals={**first.signals, "current": first.signals["current"] + hum})
    problem = prepare([noisy, second], MODEL)
    made = without_sensor_errors([noisy, second], problem.in_free_run(), fit_nominal(problem))
    (found,) = made.findings
    assert (found.kind, found.recording, found.signals) == ("hum", "run_0", ("current",))
    assert np.std(noisy.signals["current"] - made.recordings[0].signals["current"] - hum) < 0.1 * np.std(hum)
    assert made.recordings[1] is second
