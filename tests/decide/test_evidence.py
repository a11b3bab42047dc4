"""Evidence for an effect, where something else is missing that no name has."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import rwn
from ranked import ranked_from
from rwn.decide import evidence as module
from rwn.decide.evidence import CrossValidation
from rwn.name.ranking import Ranking

MODEL = rwn.read_model(Path(rwn.__file__).parent / "demo" / "model.toml")
LOAD = {"torque": 0.08, "t_start": 1.0, "t_end": 2.5}
N, STEP = 3000, 1e-3


def _wandering(seed: int) -> np.ndarray:
    """A voltage (n,) that wanders for half a second at a time, as a torque of some mN m does."""
    kept, noise = 1.0 - STEP / 0.5, np.random.default_rng(seed).standard_normal(N)
    values = [0.0]
    for new in noise[1:]:
        values.append(kept * values[-1] + 0.4 * np.sqrt(1.0 - kept**2) * new)
    return np.array(values)


def _ranking(truth: rwn.Model, names: Sequence[str], *, seed: int, wandering: float = 1.0) -> Ranking:
    time = STEP * np.arange(N)
    voltage = 6.0 * np.sin(2 * np.pi * (0.5 * time + 0.5 * time**2))
    acting = rwn.Recording(name="run", time=time, signals={"voltage": voltage + wandering * _wandering(seed)})
    speed = rwn.simulate(truth, acting).signals["speed"]
    speed = speed + 0.5 * np.random.default_rng(seed + 100).standard_normal(N)
    given = rwn.Recording(name="run", time=time, signals={"voltage": voltage, "speed": speed})
    return ranked_from([given], MODEL, names)


@pytest.mark.parametrize("seed", [0, 3])
def test_a_load_that_follows_what_wanders_has_no_evidence(seed: int) -> None:
    """It fits better by far, and what is new in each error is no less once both are fitted to that."""
    ranking = _ranking(MODEL, ["load-disturbance"], seed=seed)
    load = next(r for r in ranking.fits if r.added)
    assert load.score > ranking.nothing_missing.score + 5.0
    assert CrossValidation(ranking, load, [], MODEL).evidence("load-disturbance", ()).odds < 0.0


@pytest.mark.parametrize("seed", [3, 5])
def test_a_load_that_sets_in_beside_what_wanders_has(seed: int) -> None:
    ranking = _ranking(replace(MODEL, effects={"load-disturbance": LOAD}), ["load-disturbance"], seed=seed)
    load = next(r for r in ranking.fits if r.added)
    assert CrossValidation(ranking, load, [], MODEL).evidence("load-disturbance", ()).odds > 10.0


def test_an_effect_is_compared_with_the_rest_of_its_explanation_also_where_that_is_not_ranked(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(module, "_innovations", lambda *_: SimpleNamespace(log_odds=lambda *_: np.inf))
    truth = replace(MODEL, effects={"coulomb-friction": {"coulomb_torque": 0.02}, "load-disturbance": LOAD})
    ranking = _ranking(truth, list(truth.effects), seed=0, wandering=0.0)
    both = next(r for r in ranking.fits if len(r.added) == 2)
    ranked = CrossValidation(ranking, both, [], MODEL).evidence("coulomb-friction", ())
    pruned = replace(ranking, fits=(both, ranking.nothing_missing))
    found = CrossValidation(pruned, both, [], MODEL).evidence("coulomb-friction", ())
    assert found.odds == pytest.approx(ranked.odds, rel=0.05)
    assert both.score - ranking.nothing_missing.score > 2.0 * found.odds


def test_halves_disagree_in_what_both_of_them_show(monkeypatch: pytest.MonkeyPatch) -> None:
    """A load that only one half meets may be anything in the other, where it has no deviation."""
    values = [np.array([1.0, 2.0, 0.3]), np.array([1.3, 2.0, 90.0])]
    spread = {id(v): s for v, s in zip(values, [np.array([0.06, 0.1, 0.01]), np.array([0.08, 0.1, 0.0])], strict=True)}
    unknowns = [SimpleNamespace(nuisance=False)] * 3
    halves = [
        SimpleNamespace(
            problem=None,
            fit=SimpleNamespace(minimum=SimpleNamespace(values=v), hypothesis=SimpleNamespace(unknowns=unknowns)),
        )
        for v in values
    ]
    monkeypatch.setattr(module, "statistics", lambda *_: None)
    monkeypatch.setattr(module, "deviations", lambda this, _: spread[id(this.minimum.values)])
    assert module._birge(halves) == pytest.approx(3.0 / np.sqrt(2.0))  # 0.3 / 0.1 of the first, 0 of the second
