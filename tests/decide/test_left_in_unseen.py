"""What intervals go by where recordings that were kept back show more misfit than those that were fitted."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from ranked import ranked_from
from rwn.decide.account import Account, Remainder
from rwn.decide.decision import Decision
from rwn.fit.preparation import prepare
from rwn.fit.residuals import MISSPECIFIED, Statistics, statistics
from rwn.name.ranking import Ranking
from rwn.simulate.run import Run

MODEL = rwn.Model(kind="dc", parameters=MOTOR)
N = 3000


def _recorded(name: str, volts: float, drag: float, seed: int) -> rwn.Recording:
    time = 1e-3 * np.arange(N)
    voltage = volts * np.sin(2 * np.pi * 0.7 * time)
    run = rwn.Recording(name=name, time=time, signals={"voltage": voltage})
    truth = replace(MODEL, effects={"quadratic-drag": {"drag_coefficient": drag}}) if drag else MODEL
    rng = np.random.default_rng(seed)
    seen = rwn.simulate(truth, run).signals
    noisy = {s: seen[s] + 0.05 * np.std(seen[s]) * rng.standard_normal(N) for s in ("current", "speed")}
    return replace(run, signals={"voltage": voltage, **noisy})


@pytest.fixture(scope="module")
def ranking() -> Ranking:
    return ranked_from([_recorded("slow", 2.0, 0.0, 1)], MODEL, ["coulomb-friction"])


def _runs(drag: float) -> tuple[Run, ...]:
    return prepare([_recorded("fast", 12.0, drag, 2)], MODEL).runs


def _left(ranking: Ranking, heldout: tuple[Run, ...]) -> Statistics:
    nothing = ranking.nothing_missing
    return Decision(
        ranking=ranking, account=Account(effects=(), leading=nothing), chosen=nothing, remainder=Remainder(),
        verdict="adequate", rows=(), heldout=heldout,
    ).left  # fmt: skip


def test_misfit_of_a_recording_that_was_kept_back_is_counted(ranking: Ranking) -> None:
    fitted = statistics(ranking.weighted, ranking.nothing_missing.final)
    assert fitted.misfit == 0.0
    assert _left(ranking, ()) == fitted
    assert _left(ranking, _runs(drag=0.0)) == fitted, "noise alone"
    left = _left(ranking, _runs(drag=1e-6))
    assert "speed" in left.structured
    assert left.variance > 2.0
    assert (left.count, left.correlation_time) == (fitted.count, fitted.correlation_time)
    assert left.effective_with_misfit < 2.0 * MISSPECIFIED < fitted.effective_with_misfit


def test_a_recording_that_runs_away_gives_no_size(ranking: Ranking, monkeypatch: pytest.MonkeyPatch) -> None:
    fitted = statistics(ranking.weighted, ranking.nothing_missing.final)
    away = replace(fitted, variance=np.inf, structured=("speed",))
    told = {id(ranking.weighted): fitted}
    monkeypatch.setattr("rwn.decide.decision.statistics", lambda problem, _this, **_: told.get(id(problem), away))
    assert _left(ranking, _runs(drag=0.0)) == fitted
