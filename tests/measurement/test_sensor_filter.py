"""Filters of the sensors, seen in the noise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.fit.fit import Fit, fit, fit_nominal
from rwn.fit.hypothesis import hypothesis
from rwn.fit.nominal import weighted_by_nominal
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.refitting import refitted_beside
from rwn.fit.residual_noise import with_noise_of
from rwn.fit.unknown import prior_cost
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered, known_filters
from rwn.measurement.sensor_filter import _all_at_once, _bases, filters_again, sensor_filters
from rwn.model.model import Model
from rwn.recording.filters import as_filtered

STEP = 1e-3  # [s]

MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "viscous_friction": 0.1})

UNCERTAIN = {
    "resistance": 0.1, "torque_constant": 0.04, "back_emf_constant": 0.04, "inertia": 0.06, "viscous_friction": 0.7
}  # fmt: skip


def _problem(
    share: float, samples: int = 4000, *, analog: bool = False, step: float = STEP, model: Model = MODEL,
    friction: float = 0.0,
) -> Problem:  # fmt: skip
    """A run whose speed, with its noise, went through a filter; `friction` [N m] is none of the model's."""
    rng, time = np.random.default_rng(7), step * np.arange(samples)
    voltage = np.repeat(3.0 * rng.uniform(-1.0, 1.0, samples // 50), 50)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    lag = {"speed-sensor-lag": {"time_constant": -step / np.log(share)}} if analog else {}
    missing = {"coulomb-friction": {"coulomb_torque": friction}} if friction else {}
    speed = rwn.simulate(replace(model, effects=lag | missing), run).signals["speed"]
    noise = 0.2 * rng.standard_normal(samples)
    shown = speed + as_filtered(time, noise, -step / np.log(share)) if share else speed + noise
    if share and not analog:
        shown = as_filtered(time, speed + noise, -step / np.log(share))
    return prepare([replace(run, signals={"voltage": voltage, "speed": shown})], model)


@pytest.mark.parametrize("share", [0.4, 0.6])
def test_a_filter_of_samples_is_told_to_a_few_per_cent(share: float) -> None:
    problem, nominal = weighted_by_nominal(_problem(share))
    (found,) = sensor_filters(problem, nominal)
    assert found.signal == "speed"
    assert found.digital
    assert found.share == pytest.approx(share, abs=0.02)


def test_a_sensor_with_a_lag_of_its_own_is_no_filter_of_samples() -> None:
    problem, nominal = weighted_by_nominal(_problem(0.6, analog=True))
    (found,) = sensor_filters(problem, nominal)
    assert not found.digital
    assert found.time_constant == pytest.approx(-STEP / np.log(0.6), rel=0.35)


@pytest.mark.parametrize(("step", "digital"), [(2e-4, False), (5e-4, True)])
def test_a_filter_that_may_have_filtered_between_the_rows_is_taken_for_one_that_did(step: float, digital: bool) -> None:
    """The digital one is likelier by e^5 at 0.2 ms, by e^46 at 0.5 ms: only there do the rows tell it."""
    problem, nominal = weighted_by_nominal(_problem(0.5, 1000, step=step))
    (found,) = sensor_filters(problem, nominal)
    assert found.digital == digital


def test_what_is_missing_makes_fewer_samples_speak_for_a_digital_filter() -> None:
    """It is likelier by e^30, by 2000 samples of which 92 are independent."""
    problem, nominal = weighted_by_nominal(_problem(0.5, 2000, step=3e-4, friction=2e-3))
    (found,) = sensor_filters(problem, nominal)
    assert not found.digital


def test_a_spring_that_was_found_in_place_of_a_filter_does_not_hide_it() -> None:
    """At few rows a time constant a second mass beside a lag of the sensor does what the filter did."""
    step = 5e-3
    model = replace(MODEL, uncertainty={"inertia": 0.02, "viscous_friction": 0.1})
    problem, nominal = weighted_by_nominal(_problem(0.4, 2000, step=step, model=model))
    start = {
        "shaft-compliance": {"stiffness": 2.0, "damping": 1e-3, "load_inertia": 1e-5, "load_viscous_share": 0.5},
        "speed-sensor-lag": {"time_constant": step},
    }
    mimic = fit(problem, hypothesis(problem.prior, tuple(start), problem.scales, start, nominal.motor))
    assert mimic.cost < 0.1 * nominal.cost
    (found,) = sensor_filters(problem, mimic)
    assert found.digital
    assert found.share == pytest.approx(0.4, abs=0.02)


@pytest.mark.parametrize(("step", "share"), [(4e-3, 0.65), (8e-3, 0.54), (12e-3, 0.65)])
def test_parameters_that_leave_the_data_sheet_are_no_filter(step: float, share: float) -> None:
    """At few rows a time constant several times the inertia does what the filter did, against all that is declared."""
    model = replace(MODEL, uncertainty=UNCERTAIN)
    problem, nominal = weighted_by_nominal(_problem(share, 2000, step=step, model=model))
    assert nominal.value("inertia") > 4.0 * MOTOR["inertia"]
    (found,) = sensor_filters(problem, nominal)
    assert found.digital
    assert found.share == pytest.approx(share, abs=0.01)


def test_what_priors_cost_is_what_a_fit_pays_for_them() -> None:
    problem, nominal = weighted_by_nominal(_problem(0.54, 2000, step=8e-3, model=replace(MODEL, uncertainty=UNCERTAIN)))
    paid = (nominal.minimum.cost - nominal.minimum.chi2) / problem.inflation
    assert paid > 100.0
    assert prior_cost(nominal.hypothesis.unknowns, nominal.minimum.values) == pytest.approx(paid, rel=1e-9)


def test_white_noise_shows_no_filter_and_neither_does_a_model_that_is_wrong() -> None:
    problem, nominal = weighted_by_nominal(_problem(0.0))
    assert sensor_filters(problem, nominal) == ()
    (run,) = problem.runs
    wrong = replace(problem, runs=(replace(run, speed=run.speed + 3.0 * np.sin(0.05 * np.arange(run.time.size))),))
    assert sensor_filters(wrong, nominal) == ()


def test_a_filter_is_undone_and_is_no_missing_physics() -> None:
    problem, plain = weighted_by_nominal(_problem(0.6))
    known = filtered(problem, sensor_filters(problem, plain))
    assert list(known.filters) == ["speed"]
    fitted = fit_nominal(with_noise_of(known, fit_nominal(known)))
    assert fitted.hypothesis.effects == ()
    off, before = (abs(f.value("inertia") / MOTOR["inertia"] - 1.0) for f in (fitted, plain))
    assert off < 0.01
    assert before > 5.0 * off


def test_filters_that_a_problem_was_given_are_those_it_knows() -> None:
    problem, nominal = weighted_by_nominal(_problem(0.6))
    (found,) = sensor_filters(problem, nominal)
    for given in (found, replace(found, digital=False)):
        (known,) = known_filters(filtered(problem, [given]))
        assert (known.signal, known.digital) == (given.signal, given.digital)
        assert known.time_constant == given.time_constant
        assert known.share == pytest.approx(given.share)
    assert known_filters(problem) == ()


def test_a_lag_of_the_sensor_is_fitted_with_whatever_else() -> None:
    problem, plain = weighted_by_nominal(_problem(0.6, analog=True))
    nuisance = filtered(problem, sensor_filters(problem, plain))
    fitted = fit_nominal(with_noise_of(nuisance, fit_nominal(nuisance)))
    assert fitted.added == ()
    assert fitted.value("speed-sensor-lag.time_constant") == pytest.approx(-STEP / np.log(0.6), rel=0.1)


def test_explanations_by_several_effects_go_on_beside_a_filter() -> None:
    """What was found before the filter was is not lost; the lag that is the filter is no part of it any more."""
    for analog, measured in ((True, ("speed-sensor-lag",)), (False, ())):
        problem, plain = weighted_by_nominal(_problem(0.6, analog=analog))
        added = ("coulomb-friction", "speed-sensor-lag")
        before = fit(problem, hypothesis(problem.prior, added, problem.scales))
        (again,) = refitted_beside([before], filtered(problem, sensor_filters(problem, plain)))
        assert again.added == ("coulomb-friction",)
        assert again.hypothesis.effects == (*measured, "coulomb-friction")


def test_a_filter_that_was_told_beside_too_little_physics_is_told_anew() -> None:
    """A friction that is missing makes the filter another one; beside the friction the right one is far likelier."""
    problem = _problem(0.6, friction=4e-3)
    right, wrong = (
        SensorFilter(signal="speed", share=share, time_constant=-STEP / np.log(share), digital=True)
        for share in (0.6, 0.4)
    )
    under = weighted_by_nominal(filtered(problem, [wrong]))[0]
    rubbed = fit(under, hypothesis(problem.prior, ("coulomb-friction", "speed-sensor-lag"), problem.scales))
    (found,) = filters_again(problem, rubbed, (wrong,))
    assert found.digital
    assert found.share == pytest.approx(0.6, abs=0.02)
    under = weighted_by_nominal(filtered(problem, [right]))[0]
    rubbed = fit(under, hypothesis(problem.prior, ("coulomb-friction",), problem.scales))
    assert filters_again(problem, rubbed, (right,)) == (right,)


def test_filters_of_two_signals_are_told_beside_a_late_input_and_a_start_from_rest() -> None:
    """The delay takes up what one filter lacks while the other is not known; noise of a sample looks like a motion."""
    rng, time = np.random.default_rng(5), STEP * np.arange(4000)
    voltage = np.repeat(3.0 * rng.uniform(-1.0, 1.0, 80), 50)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    late = replace(MODEL, effects={"input-delay": {"delay": 3.1 * STEP}})
    signals = rwn.simulate(late, run).signals
    noise = rng.standard_normal((2, time.size))
    noise[:, 0] = 2.0  # of the first sample, which a filter passes whole
    shares = {"speed": 0.6, "current": 0.35}
    shown = {
        s: as_filtered(time, signals[s] + level * eps, -STEP / np.log(shares[s]))
        for (s, level), eps in zip({"speed": 0.2, "current": 0.01}.items(), noise, strict=True)
    }
    problem = prepare([replace(run, signals={"voltage": voltage, **shown})], MODEL)
    assert problem.runs[0].in_motion
    problem, nominal = weighted_by_nominal(problem)
    start = {"input-delay": {"delay": 4.0 * STEP}}
    delayed = fit(problem, hypothesis(problem.prior, tuple(start), problem.scales, start, nominal.motor))
    found = sensor_filters(problem, delayed)
    assert {f.signal: f.share for f in found if f.digital} == pytest.approx(shares, abs=0.02)
    undone = filtered(problem, found)
    assert not undone.runs[0].in_motion
    again = fit(undone, hypothesis(undone.prior, tuple(start), undone.scales, start, nominal.motor))
    assert again.values_of("input-delay")["delay"] == pytest.approx(3.1 * STEP, rel=0.01)


@pytest.fixture(scope="module")
def twice_filtered() -> tuple[Problem, Fit]:
    """A drive with friction whose speed and current went through filters of 4 and 2 ms, and the friction."""
    rng, time = np.random.default_rng(1), 2e-3 * np.arange(2500)
    voltage = np.repeat(3.0 * rng.uniform(-1.0, 1.0, 50), 50)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    friction = {"coulomb-friction": {"coulomb_torque": 4e-3}}
    signals = rwn.simulate(replace(MODEL, effects=friction), run).signals
    shown = {
        s: as_filtered(time, signals[s] + level * rng.standard_normal(time.size), tau)
        for s, level, tau in (("speed", 0.2, 4e-3), ("current", 0.01, 2e-3))
    }
    problem, nominal = weighted_by_nominal(prepare([replace(run, signals={"voltage": voltage, **shown})], MODEL))
    return problem, fit(problem, hypothesis(problem.prior, tuple(friction), problem.scales, friction, nominal.motor))


def test_filters_that_hide_each_other_are_told_together(twice_filtered: tuple[Problem, Fit]) -> None:
    """Beside a filter of the speed that is too short the current seems to have none."""
    problem, this = twice_filtered
    short, of_current = (
        SensorFilter(signal=s, share=np.exp(-2e-3 / tau), time_constant=tau, digital=True)
        for s, tau in (("speed", 2.6e-3), ("current", 1.5e-3))
    )
    found = _all_at_once(problem, this, {"speed": short}, [short, of_current], {})
    assert {f.signal: f.time_constant for f in found} == pytest.approx({"speed": 4e-3, "current": 2e-3}, rel=0.03)
    assert _all_at_once(problem, this, {"speed": short}, [short], {}) == (short,)


def test_only_what_comes_late_may_stand_in_for_a_filter(twice_filtered: tuple[Problem, Fit]) -> None:
    problem, _ = twice_filtered
    added = ("coulomb-friction", "voltage-saturation", "input-delay", "current-sensor-lag")
    whole = fit(problem, hypothesis(problem.prior, added, problem.scales), share=1e-3)
    assert [base.added for base in _bases(problem, whole)] == [added, added[:2], ()]


def test_beside_a_spring_a_filter_is_told_without_it() -> None:
    """A chirp under a drive's filter: a stiff second mass and a lag of the sensor do nearly what the filter does."""
    time = STEP * np.arange(1500)
    voltage = 3.0 * np.sin(2.0 * np.pi * (2.0 + 15.0 * time) * time)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    noise = 0.2 * np.random.default_rng(3).standard_normal(time.size)
    model = replace(MODEL, uncertainty=UNCERTAIN)
    shown = as_filtered(time, rwn.simulate(model, run).signals["speed"] + noise, 1.6 * STEP)
    problem, nominal = weighted_by_nominal(prepare([replace(run, signals={"voltage": voltage, "speed": shown})], model))
    start = {"shaft-compliance": {"stiffness": 2.0, "damping": 1e-3, "load_inertia": 1e-5, "load_viscous_share": 0.5}}
    mimic = fit(problem, hypothesis(problem.prior, tuple(start), problem.scales, start, nominal.motor))
    assert [base.added for base in _bases(problem, mimic)] == [("shaft-compliance",), ()]
    (found,) = sensor_filters(problem, mimic)
    assert found.digital
    assert found.time_constant == pytest.approx(1.6 * STEP, rel=0.03)
