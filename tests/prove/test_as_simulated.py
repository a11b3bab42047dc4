"""What rwn simulate errs by on recordings that were judged with numbers of their own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_files import files_of
from ranked import ranked
from rwn.fit.preparation import prepare
from rwn.measurement.levels import all_levels, with_levels
from rwn.prove.as_simulated import as_simulated
from rwn.prove.heldout import HeldoutRow
from rwn.prove.proof import compared
from rwn.simulate.recorded_run import judging_run

MOTOR = {
    "resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 2e-5,
    "viscous_friction": 4e-5,
}  # fmt: skip
MODEL = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1})


def _rows(inertias: tuple[float, ...], *, levels: bool) -> tuple[HeldoutRow, ...]:
    *known, unseen = files_of(MODEL, ["inertia"], inertias)
    problem = prepare(known, MODEL)
    (level,) = (level for level in all_levels(problem) if level.quantity == "inertia")
    ranking = ranked(with_levels(problem, level) if levels else problem, ["coulomb-friction"], at_once=1)
    run = judging_run(unseen, MODEL)
    rows = compared(ranking, ranking.nominal_fit, ranking.nominal_fit, [run], seed=0)
    return as_simulated(rows, ranking.problem, [run], [run], ranking.nominal_fit)


def test_a_recording_with_a_number_of_its_own_has_the_error_without_it_too() -> None:
    (row,) = (r for r in _rows((1.0, 1.02, 2.0), levels=True) if r.region == "all" and r.signal == "speed")
    assert row.simulated is not None
    assert row.simulated > 3.0 * row.refitted
    assert row.simulated == pytest.approx(row.nominal, rel=0.2)  # that of the fitted files is about as given


def test_where_nothing_is_its_own_there_is_no_other_error() -> None:
    assert {row.simulated for row in _rows((1.0, 1.0, 1.0), levels=False)} == {None}


def test_an_input_that_the_motion_told_is_its_own() -> None:
    *known, unseen = files_of(MODEL, ["inertia"], (1.0, 1.0, 1.0))
    ranking = ranked(prepare(known, MODEL), ["coulomb-friction"], at_once=1)
    alone = judging_run(unseen, MODEL)
    told = replace(alone.with_intersample("halves"), start=alone.start)
    rows = compared(ranking, ranking.nominal_fit, ranking.nominal_fit, [told], seed=0)
    (row, *_) = as_simulated(rows, ranking.problem, [told], [alone], ranking.nominal_fit)
    (own, *_) = compared(ranking, ranking.nominal_fit, ranking.nominal_fit, [alone], seed=0)
    assert row.simulated == pytest.approx(own.refitted)
    assert not np.isclose(row.refitted, own.refitted, rtol=1e-3)
