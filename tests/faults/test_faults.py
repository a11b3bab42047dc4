"""Mistakes in the recordings are found before any physics."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from ranked import ranked_from
from rwn.decide.next_experiment import separated_by
from rwn.faults.delay import SuspectedFault, accepted, first_effects, rivals, suspected
from rwn.faults.fault import SHIFT, Fault
from rwn.faults.fault import without as undone
from rwn.faults.scale import wrong_scale
from rwn.fit.preparation import prepare
from rwn.report.diagnosis_data import Beneath
from rwn.report.fitted_filter import fitted_filters
from rwn.report.next_steps import next_steps
from rwn.report.sentences import verdict_sentence
from rwn.search.beneath_faults import beneath_faults

DEMO = Path(rwn.__file__).parent / "demo"
MOTION = ("speed", "position")


@pytest.fixture(scope="module")
def model() -> rwn.Model:
    return rwn.read_model(DEMO / "model.toml")


@pytest.fixture(scope="module")
def friction(model: rwn.Model) -> rwn.Recording:
    """A quarter of a run of the demonstration, whose dry friction the model lacks: a search on it is shorter."""
    whole = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    return whole.beginning(len(whole) // 4)


@pytest.fixture(scope="module")
def right(model: rwn.Model) -> rwn.Recording:
    """A run of the model itself with noise: nothing is wrong and nothing is missing."""
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    rng = np.random.default_rng(1)
    out = rwn.simulate(model, recording)
    signals = {"voltage": recording.signals["voltage"]}
    for name in ("current", "speed"):
        clean = out.signals[name]
        signals[name] = clean + 0.01 * clean.std() * rng.standard_normal(clean.size)
    return replace(recording, signals=signals)


@pytest.fixture(scope="module")
def with_position(model: rwn.Model, friction: rwn.Recording) -> rwn.Recording:
    """The same with a position, of a motor three times as heavy as its model: its size is unlike that of a free run."""
    heavy = replace(model, parameters={**model.parameters, "inertia": 3.0 * model.parameters["inertia"]})
    run = rwn.simulate(heavy, friction).signals
    signals = {"voltage": friction.signals["voltage"], **{s: run[s] for s in ("current", "speed", "position")}}
    return replace(friction, signals=signals)


def altered(recording: rwn.Recording, names: tuple[str, ...], factor: float = 1.0, delay: int = 0) -> rwn.Recording:
    signals = {name: np.array(values) for name, values in recording.signals.items()}
    for name in names:
        if name in signals:
            rolled = np.roll(signals[name], delay)
            if delay > 0:
                rolled[:delay] = signals[name][0]
            elif delay < 0:
                rolled[delay:] = signals[name][-1]
            signals[name] = factor * rolled
    return replace(recording, signals=signals)


def silent(what: str, done: float) -> None:
    """Progress that nobody asked for."""


@pytest.mark.parametrize("signal", MOTION)
@pytest.mark.parametrize(("factor", "name"), [(np.pi / 180.0, "wrong-unit"), (-1.0, "wrong-sign"), (0.2, "")])
def test_which_of_two_that_contradict_each_other_is_wrong_is_left_to_the_model(
    signal: str, factor: float, name: str, with_position: rwn.Recording, model: rwn.Model
) -> None:
    found = wrong_scale([altered(with_position, (signal,), factor)], model)
    if name:
        assert found is not None
        assert (found.name, found.signals, found.factor) == (name, (signal,), pytest.approx(factor))
    else:  # no unit is five times another: a gear between the two sensors, which is said and not undone
        assert found is None


@pytest.mark.parametrize(
    ("names", "factor", "name"),
    [
        (MOTION, 60.0 / (2.0 * np.pi), "wrong-unit"),
        (MOTION, 180.0 / np.pi, "wrong-unit"),
        (MOTION, 1.0 / (2.0 * np.pi), "wrong-unit"),
        (MOTION, -60.0 / (2.0 * np.pi), "wrong-unit"),
        (("current",), 1e3, "wrong-unit"),
        (MOTION, -1.0, "wrong-sign"),
        (("current",), -1.0, "wrong-sign"),
        (("voltage",), -1.0, "wrong-sign"),
    ],
)
def test_units_and_signs(
    model: rwn.Model, right: rwn.Recording, names: tuple[str, ...], factor: float, name: str
) -> None:
    wrong = altered(right, names, factor)
    found = wrong_scale([wrong], model)
    assert found is not None
    assert (found.name, found.factor) == (name, pytest.approx(factor))
    for signal, values in found.undo(wrong).signals.items():
        assert values == pytest.approx(right.signals[signal])


def test_nothing_is_doubted_where_nothing_is_wrong(model: rwn.Model, right: rwn.Recording) -> None:
    assert wrong_scale([right], model) is None
    unseen = replace(right, signals={k: v for k, v in right.signals.items() if k != "current"})
    assert wrong_scale([unseen], model) is None


def test_missing_physics_is_no_mistake(model: rwn.Model) -> None:
    """tests/test_diagnose.py holds the verdict on this recording."""
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    assert wrong_scale([recording], model) is None
    assert suspected([recording], model) is None


@pytest.mark.slow
def test_a_motion_that_is_early(model: rwn.Model, right: rwn.Recording) -> None:
    faults, ranking = beneath_faults([altered(right, MOTION, delay=-5)], model, say=silent)
    assert [(f.name, f.signals[0], f.delay) for f in faults] == [("time-shift", "speed", -5)]
    assert not ranking.fits[0].added


@pytest.mark.slow
@pytest.mark.parametrize(("of", "delay", "beneath"), [(MOTION, 15, ()), (("current",), 6, ("coulomb-friction",))])
def test_a_channel_that_is_late_by_a_few_rows_is_one_of_a_late_sensor(
    of: tuple[str, ...], delay: int, beneath: tuple[str, ...], model: rwn.Model, request: pytest.FixtureRequest
) -> None:
    """With what is missing besides; no mistake is needed for it."""
    recording = request.getfixturevalue("friction" if beneath else "right")
    faults, ranking = beneath_faults([altered(recording, of, delay=delay)], model, say=silent)
    late = f"{of[0]}-sensor-delay"
    assert not faults
    assert set(ranking.fits[0].added) == {late, *beneath}
    step = float(np.median(np.diff(recording.time)))
    assert ranking.fits[0].final.values_of(late)["delay"] == pytest.approx(delay * step, rel=0.02)


@pytest.mark.slow
def test_nothing_is_compared_where_an_early_channel_was_not_measured(model: rwn.Model, friction: rwn.Recording) -> None:
    """Its first value in place of the unknown ones made what lies beneath `unexplained`."""
    run = replace(friction, time=friction.time[:-6], signals={s: v[:-6] for s, v in friction.signals.items()})
    early = replace(run, signals={**run.signals, "current": friction.signals["current"][6:]})
    faults, ranking = beneath_faults([early], model, say=silent)
    assert [(f.name, f.delay) for f in faults] == [("time-shift", -6)]
    assert ranking.fits[0].added == ("coulomb-friction",)
    assert ranking.left.at_the_floor
    (recording,) = undone([early], faults[0])
    assert list(recording.missing) == ["current"]
    assert list(np.flatnonzero(recording.missing["current"])) == list(range(6))
    assert np.array_equal(recording.signals["current"][6:], run.signals["current"][6:])

    def errors(guess: float) -> list[float]:
        current = recording.signals["current"].copy()
        current[:6] += guess
        problem = prepare([replace(recording, signals={**recording.signals, "current": current})], model)
        problem = replace(problem, noise=ranking.problem.noise)
        best = ranking.closest
        (left,) = problem.residuals(best.vector, best.active)
        return [problem.error(best.vector, best.active), float(np.sum(left["current"] ** 2))]

    assert errors(0.0) == errors(1e3)


@pytest.mark.parametrize(
    ("names", "factor"), [(("current",), 1e3), (("speed",), 60.0 / (2.0 * np.pi)), (("speed",), 180.0 / np.pi)]
)
def test_units_are_seen_through_physics_that_slows_the_motor(
    model: rwn.Model, names: tuple[str, ...], factor: float
) -> None:
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    braked = replace(model, parameters={**model.parameters, "viscous_friction": 2.5e-4})
    out = rwn.simulate(braked, recording).signals
    signals = {"voltage": recording.signals["voltage"], "current": out["current"], "speed": out["speed"]}
    found = wrong_scale([altered(replace(recording, signals=signals), names, factor)], model)
    assert found is not None
    assert (found.name, found.signals, found.factor) == ("wrong-unit", names, pytest.approx(factor))


def _filtered(friction: rwn.Recording) -> rwn.Recording:
    time, speed = friction.time, np.array(friction.signals["speed"])
    share = 1.0 - np.exp(-float(time[1] - time[0]) / 4e-3)
    for k in range(1, time.size):
        speed[k] = speed[k - 1] + share * (speed[k] - speed[k - 1])
    return replace(friction, signals={**friction.signals, "speed": speed})


@pytest.mark.slow
def test_a_filtered_speed_above_dry_friction_is_not_called_late(model: rwn.Model, friction: rwn.Recording) -> None:
    """A delay and one effect explain nearly as much of it as a lag and that effect, but not as much."""
    faults, ranking = beneath_faults([_filtered(friction)], model, say=silent)
    assert faults == []
    best = ranking.fits[0]
    assert best.added == ("coulomb-friction",), "and nothing beside the filter, which is how it was measured"
    (passed,) = fitted_filters(best.final, ranking.counted, {})  # as one that filters all the time
    assert passed.time_constant.value == pytest.approx(1e-3 / (np.exp(1e-3 / 4e-3) - 1.0), rel=0.03), "its lag"
    assert ranking.left.at_the_floor, "its noise went through the same filter"


def test_only_what_looks_like_a_mistake_is_suspected(model: rwn.Model, right: rwn.Recording) -> None:
    assert suspected([right], model) is None
    suspect = suspected([altered(right, ("current",), delay=-6)], model)
    assert suspect is not None
    assert (suspect.fault.name, suspect.fault.delay) == ("time-shift", -6)


def test_a_gear_of_the_size_of_a_unit_is_not_told_from_it(model: rwn.Model, right: rwn.Recording) -> None:
    found = wrong_scale([altered(right, MOTION, 1.0 / 6.2)], model)
    assert found is not None
    assert (found.name, found.also) == ("wrong-unit", ("wrong-gear-ratio",))
    assert found.found().probability == pytest.approx(0.495)


def test_scales_are_judged_by_the_signal_they_belong_to(model: rwn.Model, right: rwn.Recording) -> None:
    rectified = replace(right, signals={**right.signals, "speed": np.abs(right.signals["speed"])})
    assert wrong_scale([rectified], model) is None, "what shows no direction has no sign to be wrong"
    for names, factor, name in ((("speed",), 60.0 / (2.0 * np.pi), "wrong-unit"), (("current",), -1.0, "wrong-sign")):
        wrong = altered(rectified, names, factor)
        found = wrong_scale([wrong], model)
        assert found is not None
        assert (found.name, found.signals, found.factor) == (name, names, pytest.approx(factor))
        assert wrong_scale(undone([wrong], found), model) is None


@pytest.mark.slow
def test_the_verdict_names_the_mistake_before_the_physics(model: rwn.Model) -> None:
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    found = rwn.diagnose([altered(recording, MOTION, 60.0 / (2.0 * np.pi))], model)
    assert found.verdict == "recording-mistake"
    assert found.equation == "recording"
    assert [e.name for e in found.effects] == ["wrong-unit", "coulomb-friction"]
    assert found.effects[0].parameters["factor"].value == pytest.approx(9.5493, rel=1e-4)
    assert found.beneath == Beneath(verdict="missing-physics", set=("coulomb-friction",))
    mistake, beneath = verdict_sentence(found).split(". With it undone: ")
    assert mistake == "The recordings hold a mistake: speed in rpm taken for rad/s"
    assert beneath.startswith("The model lacks Coulomb friction")


@pytest.mark.slow
def test_a_drive_that_is_hardly_moved_says_nothing(model: rwn.Model, right: rwn.Recording) -> None:
    rng = np.random.default_rng(2)
    n = len(right)
    signals = {
        "voltage": np.append(np.zeros(n - 1), 1e-6),
        "current": 1e-2 * rng.standard_normal(n),
        "speed": 0.5 * rng.standard_normal(n),
    }
    found = rwn.diagnose([replace(right, signals=signals)], model)
    assert found.verdict == "insufficient-excitation"
    assert "no motion" in found.next_experiment


@pytest.mark.slow
def test_what_fits_best_alone_is_a_rival_though_its_law_is_on_a_limit(model: rwn.Model) -> None:
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    ranking = ranked_from([recording], model, at_once=1)
    least = min(ranking.alone.fits, key=lambda f: f.cost).added
    others = tuple(h for h in ranking.fits if not set(h.added) & set(least))
    without_it = replace(ranking, fits=others)  # what is at a limit is not ranked
    assert set(least) <= set(first_effects(without_it)) <= set(rivals(without_it))
    assert set(others[0].added) <= set(first_effects(without_it))


@pytest.mark.parametrize(("physics", "told"), [(0.087, True), (0.03, False), (0.0, False)])
def test_a_delay_that_leaves_noise_alone_beats_an_effect_that_leaves_more(physics: float, told: bool) -> None:
    """An early speed looks much like that of a motor before its shaft, but for a tenth of the noise."""
    fault = Fault(name=SHIFT, signals=("speed",), delay=-7, step=5e-4, meaning="")
    suspect = SuspectedFault(fault=fault, noise={}, before=8.0, after=0.012)
    assert not accepted(suspect, left=suspect.after, physics=physics)
    assert accepted(suspect, left=suspect.after, physics=physics, little=suspect.little) == told


@pytest.mark.slow
def test_beneath_a_mistake_the_experiment_is_named_as_well(model: rwn.Model) -> None:
    """What is left of a noisy second says not which of two frictions acts."""
    time = 1e-3 * np.arange(1000)
    voltage = 4.0 * np.sin(13.0 * time)
    given = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    truth = replace(model, uncertainty={}, effects={"coulomb-friction": {"coulomb_torque": 4e-3}})
    noise = 6.0 * np.random.default_rng(2).standard_normal(time.size)
    speed = -(rwn.simulate(truth, given).signals["speed"] + noise)
    found = rwn.diagnose([replace(given, signals={"voltage": voltage, "speed": speed})], model)
    assert found.verdict == "recording-mistake"
    assert found.beneath is not None
    assert len(found.beneath.set) > 1
    assert found.next_experiment == separated_by(found.beneath.set) != ""
    assert any(found.next_experiment in step for step in next_steps(found))
