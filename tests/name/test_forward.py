"""How explanations are searched and weighed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

import rwn
from rwn.fit import residuals as evidence
from rwn.fit.fit import Fitted
from rwn.fit.hypothesis import Candidate, candidate, fit
from rwn.fit.preparation import Setup, prepare
from rwn.fit.prior_weight import tempered
from rwn.model.model import Model
from rwn.name.backward import with_simpler
from rwn.name.forward import NOTHING, _beside, _no_window, _varied, explain
from rwn.name.initial_guesses import spectra as hints
from rwn.name.screening import Search
from rwn.recording.speed_measurement import SpeedMeasurement

DEMO = Path(rwn.__file__).parent / "demo"


def _silent(what: str, done: float) -> None:
    pass


@pytest.fixture(scope="module")
def setup() -> Setup:
    model = rwn.read_model(DEMO / "model.toml")
    return prepare([rwn.read_recording(DEMO / "train.csv", layout=model.recording)], model)


def _fitted(setup: Setup, name: str) -> Fitted:
    search = Search.of(setup)
    return search.explain(search.fit_nominal(), [name])[0]


@pytest.mark.parametrize(
    ("name", "shape", "limit"), [("stribeck-friction", "stribeck_speed", "upper"), ("backlash", "gap", "lower")]
)
def test_a_law_on_a_limit_of_its_parameters_is_known(setup: Setup, name: str, shape: str, limit: str) -> None:
    """Friction that never falls is Coulomb's, and a backlash without a gap a shaft."""
    fitted = _fitted(setup, name)
    k = [u.name for u in fitted.candidate.unknowns].index(f"{name}.{shape}")
    for at, met in ((1.0, (f"{name}.{shape}",)), (0.9 if limit == "upper" else 1.1, ())):
        values = fitted.minimum.values.copy()
        values[k] = at * getattr(fitted.candidate.unknowns[k], limit)
        assert replace(fitted, minimum=replace(fitted.minimum, values=values)).limits_met == met


@pytest.mark.parametrize(("begin", "end", "none"), [(0.3, 0.6, False), (0.0005, 0.9995, True), (0.998, 0.9985, True)])
def test_a_load_from_end_to_end_or_for_a_moment_is_none(setup: Setup, begin: float, end: float, none: bool) -> None:
    fitted = _fitted(setup, "load-disturbance")
    names = [u.name for u in fitted.candidate.unknowns]
    at = [names.index(f"load-disturbance.{t}") for t in ("t_start", "t_end")]
    values = fitted.minimum.values.copy()
    values[at] = np.array([begin, end]) * fitted.candidate.unknowns[at[0]].upper
    moved = replace(fitted, minimum=replace(fitted.minimum, values=values))
    assert moved.windows == [pytest.approx((begin, end))]
    assert _no_window(moved, setup) == none
    assert _fitted(setup, "quadratic-drag").windows == []


def test_the_ends_of_a_difference_are_not_compared(setup: Setup) -> None:
    def error(ends: float) -> list[float]:
        targets = []
        for t in setup.problem.targets:
            speed = t.speed.copy()
            speed[[0, -1]] += ends
            targets.append(replace(t, speed=speed, speed_measured=SpeedMeasurement.CENTRAL))
        problem, this = replace(setup.problem, targets=tuple(targets)), candidate(setup.nominal, (), setup.scales)
        (first, *_) = problem.residuals(this.vector, this.active)
        return [problem.error(this.vector, this.active), float(np.sum(first["speed"] ** 2))]

    assert error(0.0) == error(1e3)


def test_a_drifting_position_is_no_sign_of_a_law() -> None:
    noise, drift = np.random.default_rng(2).standard_normal(4000), np.sin(np.linspace(0.0, 9.0, 4000))
    problem: Any = SimpleNamespace(residuals=lambda *_: [{"speed": noise, "position": drift}], noise={})
    fitted: Any = SimpleNamespace(vector=None, candidate=SimpleNamespace(active=[]))
    assert evidence.statistics(problem, fitted).coloured > 10.0
    assert evidence.statistics(problem, fitted, drift=False).coloured < evidence.AT_THE_FLOOR
    problem.residuals = lambda *_: [{"position": drift}]
    assert evidence.statistics(problem, fitted, drift=False).coloured > 10.0


def test_second_effects_are_added_to_explanations_of_different_kinds(setup: Setup) -> None:
    names = ("asymmetric-friction", "stribeck-friction", "coulomb-friction", "actuator-deadzone", "quadratic-drag")
    fits = [replace(_fitted(setup, "quadratic-drag"), added=(name,), candidate=_with(setup, name)) for name in names]
    assert [f.added[0] for f in _varied(fits)] == ["asymmetric-friction", "stribeck-friction", "actuator-deadzone"]


def _with(setup: Setup, name: str) -> Candidate:
    return candidate(setup.nominal, (name,), setup.scales)


def test_an_effect_without_strength_is_idle(setup: Setup) -> None:
    fitted = _fitted(setup, "position-dependent-friction")
    k = [u.name for u in fitted.candidate.unknowns].index("position-dependent-friction.variation")
    values = fitted.minimum.values.copy()
    values[k] = 0.1
    assert replace(fitted, minimum=replace(fitted.minimum, values=values)).idle == ()
    values = values.copy()
    values[k] = 0.0
    assert replace(fitted, minimum=replace(fitted.minimum, values=values)).idle == ("position-dependent-friction",)


@pytest.mark.parametrize("name", ["presliding-hysteresis", "shaft-compliance", "input-delay"])
def test_a_strength_far_from_its_upper_limit_is_a_strength(setup: Setup, name: str) -> None:
    """A stiffness may be a millionth of the stiffest thinkable."""
    effect = setup.nominal.table[name]
    values = {p.name: p.start * 1e-3 for p in effect.parameters}
    this = candidate(setup.nominal, (name,), setup.scales, {name: values})
    weak = Fitted(added=(name,), candidate=this, minimum=fit(setup.problem, this, max_iterations=0))
    assert weak.idle == ()


def test_what_no_recording_depends_on_costs_an_explanation_nothing(setup: Setup) -> None:
    """The offset of a current that nobody recorded."""
    unseen = replace(setup.problem, targets=tuple(replace(t, current=np.empty(0)) for t in setup.problem.targets))
    both = Search.of(setup)
    alone = replace(both, problem=unseen)
    counts = []
    for search in (both, alone):
        found = search.explain(search.fit_nominal(), ["sensor-bias"])
        left = evidence.statistics(search.problem, found[0])
        weighed = evidence.weigh([search.fit_nominal(), *found], left, rivals=1)
        biased = next(h for h in weighed if h.fitted.added)
        counts.append(round((biased.score + biased.misfit) / np.log(max(_effective(search, found[0]), 2.0)), 6))
    assert counts == [-1.0, -0.5]


def _effective(search: Search, fitted: Fitted) -> float:
    left = evidence.statistics(search.problem, fitted)
    return left.effective if left.at_the_floor else min(left.effective, evidence.MISSPECIFIED)


def test_a_current_that_is_not_recorded_is_made_of_voltage_and_speed(setup: Setup) -> None:
    target = setup.problem.targets[0]
    vector = Search.of(setup).fit_nominal().vector
    made = hints.current_of(setup.problem, vector, replace(target, current=np.empty(0)))
    assert np.corrcoef(made, target.current)[0, 1] > 0.99


def test_explanations_are_reported_best_first(setup: Setup) -> None:
    found = explain(setup, progress=_silent, names=["coulomb-friction", "quadratic-drag", "input-delay"])
    assert found.hypotheses[0].fitted.added == ("coulomb-friction",)
    assert [h.score for h in found.hypotheses] == sorted((h.score for h in found.hypotheses), reverse=True)
    assert not any(h.fitted.limits_met for h in found.hypotheses)


def test_an_explanation_goes_on_from_single_effects(setup: Setup) -> None:
    names = ["quadratic-drag", "input-delay"]  # neither is what is missing
    at_once = explain(setup, progress=_silent, names=names)
    alone = explain(setup, progress=_silent, names=names, at_once=1)
    assert not alone.complete
    further = explain(setup, progress=_silent, names=names, after=alone)
    assert [h.fitted.added for h in further.hypotheses] == [h.fitted.added for h in at_once.hypotheses]
    assert [h.score for h in further.hypotheses] == [h.score for h in at_once.hypotheses]
    fewer = explain(setup, progress=_silent, names=names[:1], after=alone)
    assert {n for h in fewer.hypotheses for n in h.fitted.added} <= set(names[:1])


def test_pairs_that_were_tried_are_not_tried_again(setup: Setup, monkeypatch: pytest.MonkeyPatch) -> None:
    names = ["quadratic-drag", "input-delay"]  # neither is what is missing
    pairs = explain(setup, progress=_silent, names=names, at_once=2)
    assert pairs.pairs.fits
    tried: list[str] = []

    def none(self: Search, base: Fitted, wanted: list[str], **_: float) -> list[Fitted]:  # noqa: ARG001
        tried.extend(wanted)
        return []

    monkeypatch.setattr(Search, "explain", none)
    again = explain(setup, progress=_silent, names=names, at_once=2, after=pairs)
    assert tried == []
    assert [h.score for h in again.hypotheses] == [h.score for h in pairs.hypotheses]


@pytest.mark.parametrize("at_the_floor", [True, False])
def test_beside_an_explanation_of_all_its_parts_alone_are_tried(
    setup: Setup, monkeypatch: pytest.MonkeyPatch, at_the_floor: bool
) -> None:
    search, names = Search.of(setup), ["coulomb-friction", "quadratic-drag", "input-delay", "sensor-bias"]
    first, part, other = (_fitted(setup, name) for name in names[:3])
    pair = replace(first, added=(first.added[0], part.added[0]), minimum=replace(first.minimum, cost=0.0))
    noise = np.random.default_rng(1).normal(size=1000)
    left = evidence.statistics_of({"speed": noise if at_the_floor else 9.0 * np.cumsum(noise)})
    monkeypatch.setattr(evidence, "statistics", lambda *_: left)
    tried: dict[str, list[str]] = {}

    def found(_: Search, base: Fitted, wanted: list[str], **__: float) -> list[Fitted]:
        tried[base.added[0]] = list(wanted)
        return [pair]

    monkeypatch.setattr(Search, "explain", found)
    _beside(search, [first, part, other], names, [first, part, other], NOTHING)
    met = names[:3]
    assert tried == {names[0]: names, names[1]: met, names[2]: names[:2] if at_the_floor else met}


def test_priors_give_way_where_nothing_but_noise_is_left() -> None:
    """A data sheet that is wrong by nine standard deviations, and a fit that weak priors leave at the noise."""
    motor = {"resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05,
             "inertia": 2e-5, "viscous_friction": 2e-5}  # fmt: skip
    sheet = Model(
        kind="dc", parameters={**motor, "viscous_friction": 2e-5 * np.exp(0.9)}, uncertainty={"viscous_friction": 0.1}
    )
    rng = np.random.default_rng(5)
    time = 1e-3 * np.arange(3000)
    voltage = 3.0 * np.repeat(rng.uniform(-1.0, 1.0, 60), 50)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(Model(kind="dc", parameters=motor), run).signals["speed"]
    noisy = replace(run, signals={"voltage": voltage, "speed": speed + 0.05 * rng.standard_normal(time.size)})
    search = Search.of(prepare([noisy], sheet))
    for noise, gives_way in ((0.05, True), (0.01, False)):  # at the noise, and where something is missing
        strong = replace(search, problem=replace(search.problem, noise={"speed": noise}, colour=1000.0))
        held = strong.fit_nominal()
        other, free = tempered(strong, held)
        assert (other.problem.colour < 1.1) == gives_way == (free is not held)
        if gives_way:  # the search need not find the way once more
            assert free.value("viscous_friction") == pytest.approx(motor["viscous_friction"], rel=0.01)
            assert held.value("viscous_friction") > 1.2 * motor["viscous_friction"]


def test_a_strong_cog_is_found() -> None:
    motor = {"resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05,
             "inertia": 2e-5, "viscous_friction": 2e-5}  # fmt: skip
    cog = {"amplitude": 0.012, "periods_per_rev": 7.0, "phase": 2.3}
    time = 5e-4 * np.arange(4000)
    voltage = 2.0 * np.sin(2 * np.pi * 1.5 * time)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    seen = rwn.simulate(Model(kind="dc", parameters=motor, effects={"cogging-torque": cog}), run).signals
    rng = np.random.default_rng(3)
    noisy = {s: seen[s] + 0.01 * np.std(seen[s]) * rng.standard_normal(time.size) for s in ("current", "speed")}
    recorded = replace(run, signals={"voltage": voltage, **noisy, "position": seen["position"]})
    sheet = Model(kind="dc", parameters=motor, uncertainty={"viscous_friction": 0.3, "inertia": 0.1})
    found = explain(prepare([recorded], sheet), progress=_silent, names=["cogging-torque", "coulomb-friction"])
    best = found.hypotheses[0].fitted
    assert best.added == ("cogging-torque",)
    assert best.value("cogging-torque.amplitude") == pytest.approx(cog["amplitude"], rel=0.02)


@pytest.mark.parametrize(
    ("effect", "values"), [("sensor-bias", {"speed_offset": 2.0}), ("speed-sensor-lag", {"time_constant": 0.01})]
)
def test_the_angle_is_followed_without_what_the_sensor_adds(effect: str, values: dict[str, float]) -> None:
    motor = {"resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05,
             "inertia": 2e-5, "viscous_friction": 2e-5}  # fmt: skip
    time = 1e-3 * np.arange(3000)
    run = rwn.Recording(name="run", time=time, signals={"voltage": 3.0 * np.sin(2 * np.pi * 1.3 * time)})
    seen = rwn.simulate(Model(kind="dc", parameters=motor, effects={effect: values}), run).signals
    setup = prepare([replace(run, signals={**run.signals, "speed": seen["speed"]})], Model(kind="dc", parameters=motor))
    search = Search.of(setup)
    right = candidate(search.nominal, (effect,), search.scales, {effect: values})
    followed = hints.along_the_shaft(search.problem, right.vector, right.active).targets[0].angle
    assert np.max(np.abs(setup.problem.targets[0].angle - seen["position"])) > 0.5
    assert np.max(np.abs(followed - seen["position"])) < 0.05


def test_simpler_explanations_are_sought_until_none_is_better(monkeypatch: pytest.MonkeyPatch) -> None:
    def ended(cost: float, *added: str) -> SimpleNamespace:
        return SimpleNamespace(added=added, cost=cost)

    simpler = {3: [ended(9.9, "constant-load", "load-disturbance")], 2: [ended(9.95, "load-disturbance")]}
    monkeypatch.setattr("rwn.name.backward._simpler", lambda _, best: simpler[len(best.added)])
    three = ended(10.0, "constant-load", "load-disturbance", "backlash")
    found = with_simpler(cast(Any, None), cast(Any, ended(99.0)), cast(Any, [three]))
    assert [f.added for f in found] == [
        ("constant-load", "load-disturbance"), ("load-disturbance",), ("constant-load", "load-disturbance", "backlash")
    ]  # fmt: skip
