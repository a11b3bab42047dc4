"""How explanations are searched and weighed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

import rwn
from ranked import ranked, ranked_from
from rwn.fit.fit import Fit, fit, fit_nominal
from rwn.fit.hypothesis import Hypothesis, hypothesis
from rwn.fit.preparation import prepare
from rwn.fit.prior_weight import with_priors_weighed
from rwn.fit.problem import Problem
from rwn.fit.residuals import EXACT_TO, statistics, statistics_of, structured_of
from rwn.model.model import Model
from rwn.name import extending
from rwn.name.backward import with_simpler
from rwn.name.extending import beside, diverse
from rwn.name.forward import _grown
from rwn.name.initial_guesses import spectra
from rwn.name.ranking import NO_EXTENSIONS, Extensions, Fits
from rwn.name.screening import screen
from rwn.name.weights import weigh
from rwn.recording.noise import Noise
from rwn.recording.speed_measurement import CENTRAL
from rwn.simulate.run import Run

FitWith = Callable[[str], Fit]  # an effect's name -> the demo's recording explained by it


def _silent(what: str, done: float) -> None:
    pass


@pytest.mark.parametrize(
    ("name", "shape", "limit"), [("stribeck-friction", "stribeck_speed", "upper"), ("backlash", "gap", "lower")]
)
def test_a_law_on_a_limit_of_its_parameters_is_known(fit_with: FitWith, name: str, shape: str, limit: str) -> None:
    """Friction that never falls is Coulomb's, and a backlash without a gap a shaft."""
    this = fit_with(name)
    k = [u.name for u in this.hypothesis.unknowns].index(f"{name}.{shape}")
    for at, met in ((1.0, (f"{name}.{shape}",)), (0.9 if limit == "upper" else 1.1, ())):
        values = this.minimum.values.copy()
        values[k] = at * getattr(this.hypothesis.unknowns[k], limit)
        assert replace(this, minimum=replace(this.minimum, values=values)).limits_met == met


@pytest.mark.parametrize(("gain", "kept"), [(1.05, True), (0.95, False)])
def test_more_effects_are_kept_where_they_are_likelier(
    problem: Problem, fit_with: FitWith, monkeypatch: pytest.MonkeyPatch, gain: float, kept: bool
) -> None:
    """By all that they cost less, data sheet and misfit together, in units of what their further unknowns cost."""
    wanted = ["unbalance", "coulomb-friction"]
    single = fit_with("unbalance")
    several = fit(problem, hypothesis(problem.prior, wanted, problem.scales), max_iterations=0)
    left = statistics(problem, several)
    samples = left.effective_with_misfit
    further = several.unknowns_seen - single.unknowns_seen
    price = 0.5 * further * np.log(samples) + np.log(len(wanted))
    squares = left.variance * left.count
    price = gain * price * 2.0 * squares / samples + EXACT_TO * squares
    single = replace(single, minimum=replace(single.minimum, cost=several.cost + price))
    monkeypatch.setattr(extending, "beside", lambda *_, **__: Extensions([several], frozenset()))
    nominal = replace(single, minimum=replace(single.minimum, cost=2.0 * single.cost))
    grown = _grown(
        Fits(problem, nominal, [single]), [single], wanted, NO_EXTENSIONS, at_once=2, begun=0, progress=_silent
    )  # fmt: skip
    assert grown.paired is kept
    assert (several in grown.fits) is kept


def test_the_ends_of_a_difference_are_not_compared(problem: Problem) -> None:
    def error(ends: float) -> list[float]:
        runs = []
        for run in problem.runs:
            speed = run.speed.copy()
            speed[[0, -1]] += ends
            runs.append(replace(run, speed=speed, speed_measured=CENTRAL))
        other, this = replace(problem, runs=tuple(runs)), problem.as_given()
        (first, *_) = other.residuals(this.vector, this.active)
        return [other.error(this.vector, this.active), float(np.sum(first["speed"] ** 2))]

    assert error(0.0) == error(1e3)


def test_a_drifting_position_is_no_sign_of_a_law() -> None:
    noise, drift = np.random.default_rng(2).standard_normal(4000), np.sin(np.linspace(0.0, 9.0, 4000))
    run = Run(name="drifting", time=np.arange(4000.0), input=noise, speed=noise, position=drift)
    left = [{"speed": noise, "position": drift}]
    transfer = SimpleNamespace(coefficients=True)  # of which no torque is told
    problem: Any = SimpleNamespace(residuals=lambda *_: left, noise={}, runs=[run], drive=transfer)
    this: Any = SimpleNamespace(vector=None, active=[])
    assert statistics(problem, this).structured == ("position",)
    assert statistics(problem, this, drift=False).structured == ()
    problem.residuals = lambda *_: [{"position": drift}]
    assert statistics(problem, this, drift=False).structured == ("position",)


def test_second_effects_are_added_to_explanations_of_different_kinds(problem: Problem, fit_with: FitWith) -> None:
    names = ("asymmetric-friction", "stribeck-friction", "coulomb-friction", "actuator-deadzone", "quadratic-drag")
    drag = fit_with("quadratic-drag")
    fits = [replace(drag, hypothesis=_with(problem, name)) for name in names]
    assert [f.added[0] for f in diverse(fits)] == ["asymmetric-friction", "stribeck-friction", "actuator-deadzone"]


def _with(problem: Problem, name: str) -> Hypothesis:
    return hypothesis(problem.prior, (name,), problem.scales)


def test_an_effect_without_strength_is_idle(fit_with: FitWith) -> None:
    this = fit_with("position-dependent-friction")
    k = [u.name for u in this.hypothesis.unknowns].index("position-dependent-friction.variation")
    values = this.minimum.values.copy()
    values[k] = 0.1
    assert replace(this, minimum=replace(this.minimum, values=values)).idle == ()
    values = values.copy()
    values[k] = 0.0
    assert replace(this, minimum=replace(this.minimum, values=values)).idle == ("position-dependent-friction",)


@pytest.mark.parametrize("name", ["presliding-hysteresis", "shaft-compliance", "input-delay"])
def test_a_strength_far_from_its_upper_limit_is_a_strength(problem: Problem, name: str) -> None:
    """A stiffness may be a millionth of the stiffest thinkable."""
    effect = problem.prior.table[name]
    values = {p.name: p.start * 1e-3 for p in effect.parameters}
    this = hypothesis(problem.prior, (name,), problem.scales, {name: values})
    weak = fit(problem, this, max_iterations=0)
    assert weak.idle == ()


def test_what_no_recording_depends_on_costs_an_explanation_nothing(problem: Problem) -> None:
    """The offset of a current that nobody recorded."""
    unseen = replace(problem, runs=tuple(replace(r, current=np.empty(0)) for r in problem.runs))
    counts = []
    for on in (problem, unseen):
        fits = [fit_nominal(on), *screen(on, fit_nominal(on), ["sensor-bias"])]
        left = statistics(on, fits[1])
        biased = next(r for r in weigh(fits, left, rivals=1) if r.added)
        effective = left.effective_with_misfit
        squares = left.variance * left.count
        lost = biased.fit.cost - min(f.cost for f in fits) - EXACT_TO * squares
        misfit = max(lost, 0.0) * effective / (2.0 * squares)
        counts.append(round((biased.score + misfit) / np.log(effective), 6))
    assert counts == [-1.0, -0.5]


def test_a_current_that_is_not_recorded_is_made_of_voltage_and_speed(problem: Problem) -> None:
    run = problem.runs[0]
    vector = fit_nominal(problem).vector
    made = spectra.current_of(problem, vector, replace(run, current=np.empty(0)))
    assert np.corrcoef(made, run.current)[0, 1] > 0.99


def test_explanations_are_reported_best_first(problem: Problem) -> None:
    ranking = ranked(problem, ["coulomb-friction", "quadratic-drag", "input-delay"])
    assert ranking.fits[0].added == ("coulomb-friction",)
    assert [r.score for r in ranking.fits] == sorted((r.score for r in ranking.fits), reverse=True)
    assert not any(r.fit.limits_met for r in ranking.fits)


def test_an_explanation_goes_on_from_single_effects(problem: Problem) -> None:
    names = ["quadratic-drag", "input-delay"]  # neither is what is missing
    at_once = ranked(problem, names)
    alone = ranked(problem, names, at_once=1)
    assert not alone.complete
    further = ranked(problem, names, after=alone)
    assert [r.added for r in further.fits] == [r.added for r in at_once.fits]
    assert [r.score for r in further.fits] == [r.score for r in at_once.fits]
    fewer = ranked(problem, names[:1], after=alone)
    assert {n for r in fewer.fits for n in r.added} <= set(names[:1])


def test_pairs_that_were_tried_are_not_tried_again(problem: Problem, monkeypatch: pytest.MonkeyPatch) -> None:
    names = ["quadratic-drag", "input-delay"]  # neither is what is missing
    pairs = ranked(problem, names, at_once=2)
    assert pairs.extensions.fits
    tried: list[str] = []

    def none(_: Problem, __: Fit, wanted: list[str], **___: float) -> list[Fit]:
        tried.extend(wanted)
        return []

    monkeypatch.setattr("rwn.name.extending.screen", none)
    again = ranked(problem, names, at_once=2, after=pairs)
    assert tried == []
    assert [r.score for r in again.fits] == [r.score for r in pairs.fits]


@pytest.mark.parametrize("at_the_floor", [True, False])
def test_beside_an_explanation_of_all_its_parts_alone_are_tried(
    problem: Problem, fit_with: FitWith, monkeypatch: pytest.MonkeyPatch, at_the_floor: bool
) -> None:
    names = ["coulomb-friction", "quadratic-drag", "input-delay", "sensor-bias"]
    first, part, other = (fit_with(name) for name in names[:3])
    both = replace(first.hypothesis, added=(first.added[0], part.added[0]))
    pair = replace(first, hypothesis=both, minimum=replace(first.minimum, cost=0.0))
    noise = np.random.default_rng(1).normal(size=1000)
    joined = {"speed": noise if at_the_floor else 9.0 * np.cumsum(noise)}
    left = statistics_of(joined, structured=structured_of(joined))
    monkeypatch.setattr("rwn.name.extending.statistics", lambda *_: left)
    tried: dict[str, list[str]] = {}

    def found(_: Problem, base: Fit, wanted: list[str], **__: float) -> list[Fit]:
        tried[base.added[0]] = list(wanted)
        return [pair]

    monkeypatch.setattr("rwn.name.extending.screen", found)
    beside(problem, [first, part, other], names, [first, part, other], NO_EXTENSIONS)
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
    problem = prepare([noisy], sheet)
    for noise, gives_way in ((0.05, True), (0.01, False)):  # at the noise, and where something is missing
        strong = replace(problem, noise={"speed": Noise(level=noise)}, inflation=1000.0)
        held = fit_nominal(strong)
        other, free = with_priors_weighed(strong, held)
        assert (other.inflation < 1.1) == gives_way == (free is not held)
        if gives_way:  # the search need not find the way once more
            assert free.value("viscous_friction") == pytest.approx(motor["viscous_friction"], rel=0.01)
            assert held.value("viscous_friction") > 1.2 * motor["viscous_friction"]


@pytest.mark.slow
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
    ranking = ranked_from([recorded], sheet, ["cogging-torque", "coulomb-friction"])
    best = ranking.fits[0].fit
    assert best.added == ("cogging-torque",)
    assert best.value("cogging-torque.amplitude") == pytest.approx(cog["amplitude"], rel=0.02)


@pytest.mark.parametrize(
    ("effect", "values"),
    [
        ("sensor-bias", {"speed_offset": 2.0, "current_offset": 0.0}),
        ("speed-sensor-lag", {"time_constant": 0.01}),
    ],
)
def test_the_angle_is_followed_without_what_the_sensor_adds(effect: str, values: dict[str, float]) -> None:
    motor = {"resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05,
             "inertia": 2e-5, "viscous_friction": 2e-5}  # fmt: skip
    time = 1e-3 * np.arange(3000)
    run = rwn.Recording(name="run", time=time, signals={"voltage": 3.0 * np.sin(2 * np.pi * 1.3 * time)})
    seen = rwn.simulate(Model(kind="dc", parameters=motor, effects={effect: values}), run).signals
    shown = replace(run, signals={**run.signals, "speed": seen["speed"]})
    problem = prepare([shown], Model(kind="dc", parameters=motor))
    right = hypothesis(problem.prior, (effect,), problem.scales, {effect: values})
    followed = spectra.along_the_shaft(problem, right.vector, right.active).runs[0].angle
    assert np.max(np.abs(problem.runs[0].angle - seen["position"])) > 0.5
    assert np.max(np.abs(followed - seen["position"])) < 0.05


def test_simpler_explanations_are_sought_until_none_is_better(monkeypatch: pytest.MonkeyPatch) -> None:
    def ended(cost: float, *added: str) -> SimpleNamespace:
        return SimpleNamespace(added=added, cost=cost, unknowns_seen=len(added))

    simpler = {3: [ended(9.9, "constant-load", "load-disturbance")], 2: [ended(9.95, "load-disturbance")]}
    monkeypatch.setattr("rwn.name.backward._simpler", lambda _, best: simpler[len(best.added)])
    three = ended(10.0, "constant-load", "load-disturbance", "backlash")
    one = SimpleNamespace(samples=1)  # of which an unknown counts nothing
    found = with_simpler(cast(Any, one), cast(Any, ended(99.0)), cast(Any, [three]))
    assert [f.added for f in found] == [
        ("constant-load", "load-disturbance"), ("load-disturbance",), ("constant-load", "load-disturbance", "backlash")
    ]  # fmt: skip
