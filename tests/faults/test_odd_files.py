"""A unit or sign that is wrong in some of the files only."""

from __future__ import annotations

import importlib
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

import rwn
from made_up_files import files_of
from ranked import ranked_from
from rwn.faults.fault import SIGN, UNIT, Fault
from rwn.faults.odd_files import without_unseen_mistakes, wrong_in_some
from rwn.faults.plain_faults import plain_faults
from rwn.faults.scale import wrong_scale
from rwn.model.model import Model
from rwn.recording.layout import Layout
from rwn.report.next_steps import _mistake
from rwn.search.search import SearchResult

MOTOR = {
    "resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 2e-5,
    "viscous_friction": 4e-5,
}  # fmt: skip
MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "resistance": 0.1})
diagnose = importlib.import_module("rwn.diagnose")  # rwn.diagnose is the function
RPM = 60.0 / (2.0 * np.pi)


def _times(recording: rwn.Recording, factor: float) -> rwn.Recording:
    signals = {**recording.signals, "speed": factor * recording.signals["speed"]}
    return replace(recording, signals=signals)


@pytest.mark.parametrize(("factor", "name"), [(RPM, UNIT), (-1.0, SIGN)])
def test_the_files_that_have_it_are_named_and_corrected(factor: float, name: str) -> None:
    right = files_of(MODEL, [], (1.0, 1.0, 1.0))
    given = [_times(right[0], factor), right[1], _times(right[2], factor)]
    made, corrected = plain_faults(given, MODEL)
    assert [(f.name, f.recordings) for f in made] == [(name, ("run_0", "run_2"))]
    assert "in run_0, run_2 and not in run_1" in made[0].meaning
    for one, other in zip(corrected, right, strict=True):
        np.testing.assert_allclose(one.signals["speed"], other.signals["speed"])
    assert made[0].in_layout(Layout()) == Layout(), "the columns of a model file are those of all recordings"
    diagnosis = SimpleNamespace(effects=[made[0].found()], next_experiment="", beneath=None)
    said = next(iter(_mistake(cast(Any, diagnosis))))
    assert said.startswith(f"Correct run_0 and run_2: write the speed times {1.0 / factor:.6g}")


def test_files_of_one_name_are_told_by_their_folders() -> None:
    """Without folders, as of tables in Python, nothing tells which of them is meant."""
    first, second = (replace(r, name="run.csv") for r in files_of(MODEL, [], (1.0, 1.0)))
    given = [replace(_times(first, RPM), source="a/run.csv"), replace(second, source="b/run.csv")]
    fault = wrong_in_some(given, MODEL)
    assert fault is not None
    assert fault.recordings == ("a/run.csv",)
    assert fault.undo(given[1]) is given[1]
    assert wrong_in_some([replace(r, source="") for r in given], MODEL) is None


def test_what_all_have_is_a_fault_of_all() -> None:
    given = [_times(r, RPM) for r in files_of(MODEL, [], (1.0, 1.0))]
    assert wrong_in_some(given, MODEL) is None
    fault = wrong_scale(given, MODEL)
    assert fault is not None
    assert fault.recordings == ()


def test_files_that_say_nothing_are_no_witness_that_it_is_right() -> None:
    """A motor that stands still in one file is near its simulation under any unit."""
    moving, other = files_of(MODEL, [], (1.0, 1.0))
    still = replace(other, signals={s: 1e-3 * x for s, x in other.signals.items()})
    still = replace(still, signals={**still.signals, "voltage": np.zeros(len(still))})
    assert wrong_in_some([_times(moving, RPM), still], MODEL) is None


def test_nothing_is_said_of_files_that_agree() -> None:
    assert wrong_in_some(files_of(MODEL, [], (1.0, 1.0)), MODEL) is None
    assert wrong_in_some(files_of(MODEL, [], (1.0,)), MODEL) is None


def test_what_some_of_the_fitted_have_is_not_undone_in_what_is_kept_back() -> None:
    """Tables in Python are all called alike."""
    fitted, other = files_of(MODEL, [], (1.0, 1.0))
    kept_back = replace(other, name=fitted.name)
    ranking = ranked_from([fitted], MODEL, ["coulomb-friction"], at_once=1)
    fault = Fault(name=UNIT, signals=("speed",), meaning="", factor=RPM, recordings=(fitted.name,))
    for faults, divided in (((fault,), 1.0), ((replace(fault, recordings=()),), RPM)):
        found = SearchResult(model=MODEL, late=(), faults=faults, ranking=ranking)
        (run,) = diagnose._unseen([kept_back], [fitted], found).runs
        np.testing.assert_allclose(run.speed, other.signals["speed"] / divided)


def test_a_unit_that_is_wrong_in_what_was_kept_back_is_undone_there() -> None:
    fitted, judged = files_of(MODEL, [], (1.0, 1.0))
    milli = replace(judged, signals={**judged.signals, "current": 1e3 * judged.signals["current"]})
    ((right,), (said,)) = without_unseen_mistakes([fitted], [milli], MODEL)
    np.testing.assert_allclose(right.signals["current"], judged.signals["current"])
    assert (said.recording, said.signals) == ("run_1", ("current",))
    assert said.words == "current in thousandths of the unit (milli) taken for the unit"
    assert without_unseen_mistakes([fitted], [judged], MODEL) == ([judged], [])
