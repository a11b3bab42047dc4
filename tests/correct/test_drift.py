"""Parameters of a decision where the position drifts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from ranked import ranked
from rwn.correct.drift import free_of_drift
from rwn.decide.decision import Decision, decide
from rwn.fit.fit import Fit
from rwn.fit.preparation import prepare
from rwn.model.model import Model
from rwn.simulate.recorded_run import judging_run
from rwn.simulate.run import Run

AXIS = {"inertia": 9e-4, "viscous_friction": 1.2e-3, "coulomb_friction": 0.05}
DRAG = {"drag_coefficient": 3e-5}
SHEET = Model(
    kind="axis", parameters={"inertia": 8e-4, "viscous_friction": 1e-3, "coulomb_friction": 0.055},
    uncertainty={"inertia": 0.1, "viscous_friction": 0.3, "coulomb_friction": 0.2},
)  # fmt: skip


def _recording(seed: int, *, wandering: float) -> rwn.Recording:
    """The axis with a drag, under a torque that is recorded and one that wanders and is not."""
    rng = np.random.default_rng(seed)
    time = 1e-3 * np.arange(4000)
    torque = 0.4 * np.sign(np.sin(5.0 * time + 0.2)) + 0.1 * np.repeat(rng.uniform(-1.0, 1.0, 40), 100)
    unseen = wandering * np.cumsum(rng.standard_normal(time.size)) / np.sqrt(time.size)
    acted = rwn.Recording(name="acted", time=time, signals={"torque": torque + unseen})
    true = Model(kind="axis", parameters=AXIS, effects={"quadratic-drag": DRAG})
    made = rwn.simulate(true, acted).signals
    count = 2.0 * np.pi / 20_000
    speed = made["speed"] + 0.1 * rng.standard_normal(time.size)
    position = count * np.round(made["position"] / count)
    return rwn.Recording(name=f"run{seed}", time=time, signals={"torque": torque, "speed": speed, "position": position})


def _decided(wandering: float) -> tuple[Decision, list[Run]]:
    problem = prepare([_recording(1, wandering=wandering)], SHEET)
    ranking = ranked(problem, ["quadratic-drag"], at_once=1)
    unseen = [judging_run(_recording(2, wandering=0.0), SHEET)]
    return decide(ranking, unseen, SHEET, seed=0), unseen


def _off(this: Fit) -> float:
    return float(np.max(np.abs([this.value(name) / true - 1.0 for name, true in AXIS.items()])))


def _error(decision: Decision) -> float:
    (row,) = (r for r in decision.rows if r.signal == "speed" and r.region == "all")
    assert row.corrected is not None
    return row.corrected


def test_parameters_of_what_is_stated_follow_no_drift() -> None:
    decision, unseen = _decided(3e-3)
    again = free_of_drift(decision, unseen, seed=0)
    assert again.account.stated == decision.account.stated, "what is stated was decided before"
    assert again.chosen.added == decision.chosen.added == ("quadratic-drag",)
    assert _off(again.chosen.final) < 0.5 * _off(decision.chosen.final)
    assert again.ranking.nominal_fit is again.ranking.nothing_missing.final
    assert again.account.leading in again.ranking.fits
    assert _error(again) < _error(decision)


def test_where_nothing_drifts_nothing_is_fitted_again() -> None:
    decision, unseen = _decided(0.0)
    assert free_of_drift(decision, unseen, seed=0) is decision


def test_what_predicts_worse_what_was_kept_back_is_not_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    decision, unseen = _decided(3e-3)
    refitted = free_of_drift(decision, unseen, seed=0)
    swapped = replace(decision, chosen=refitted.chosen)  # as if the plain fit were the one that predicts better
    bent = decision.chosen.final
    monkeypatch.setattr("rwn.correct.drift.refit", lambda this, _, *, share: bent if this.added else this)  # noqa: ARG005
    assert free_of_drift(swapped, unseen, seed=0) is swapped
