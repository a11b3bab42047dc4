"""Each half of a drive by itself tells what acts on it from what stands for something in the other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR
from rwn.decide.account import ActingEffect
from rwn.decide.evidence import Evidence
from rwn.decide.shaft_alone import ShaftAlone, shaft_alone
from rwn.decide.witness import contradicted
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.residuals import LEVEL

MODEL = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.05})
DRAG = {"quadratic-drag": {"drag_coefficient": 1e-5}}
BRUSHES = {"brush-voltage-drop": {"voltage_drop": 1.5, "transition_current": 0.5}}
SPRING = {"shaft-compliance": {"stiffness": 8.0, "damping": 1e-3, "load_inertia": 1.5e-4, "load_viscous_share": 0.5}}


def _recording(effects: Mapping[str, Mapping[str, float]], *, offset: float = 0.0) -> rwn.Recording:
    rng, time = np.random.default_rng(4), 1e-3 * np.arange(3000)
    voltage = 8.0 * np.sin(2.0 * time) + 3.0 * np.sign(np.sin(9.0 * time))
    given = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    out = rwn.simulate(replace(MODEL, effects=effects), given).signals
    current = out["current"] + offset + 0.02 * rng.standard_normal(time.size)
    speed = out["speed"] + 0.1 * rng.standard_normal(time.size)
    return rwn.Recording(name="run", time=time, signals={"voltage": voltage, "current": current, "speed": speed})


def _fitted(recording: rwn.Recording, *names: str) -> tuple[Fit, Problem, rwn.Model]:
    problem = prepare([recording], MODEL)
    return fit(problem, hypothesis(problem.prior, names, problem.scales)), problem, MODEL


@pytest.mark.parametrize("offset", [0.0, 0.2])
@pytest.mark.parametrize("name", ["quadratic-drag", "coulomb-friction"])
def test_what_stands_for_a_loss_of_the_winding_is_contradicted(name: str, offset: float) -> None:
    assert contradicted(*_fitted(_recording(BRUSHES, offset=offset), name)) == {name: "shaft"}


@pytest.mark.parametrize("offset", [0.0, 0.2])
@pytest.mark.parametrize("truth", [DRAG, SPRING, DRAG | BRUSHES], ids=["drag", "spring", "drag and brushes"])
def test_what_acts_on_the_shaft_is_not(truth: Mapping[str, Mapping[str, float]], offset: float) -> None:
    name = next(iter(truth))
    assert contradicted(*_fitted(_recording(truth, offset=offset), name)) == {}


@pytest.mark.parametrize("offset", [0.0, 0.2])
@pytest.mark.parametrize("truth", [DRAG, SPRING | DRAG], ids=["drag", "spring and drag"])
def test_what_stands_for_a_loss_of_the_shaft_is_contradicted(
    truth: Mapping[str, Mapping[str, float]], offset: float
) -> None:
    found = contradicted(*_fitted(_recording(truth, offset=offset), "brush-voltage-drop", "sensor-bias"))
    assert found == {"brush-voltage-drop": "winding"}


@pytest.mark.parametrize("offset", [0.0, 0.2])
@pytest.mark.parametrize("truth", [BRUSHES, BRUSHES | DRAG], ids=["brushes", "brushes and drag"])
def test_what_acts_on_the_winding_is_not(truth: Mapping[str, Mapping[str, float]], offset: float) -> None:
    assert contradicted(*_fitted(_recording(truth, offset=offset), "brush-voltage-drop", "sensor-bias")) == {}


@pytest.mark.parametrize("hiding", ["speed-sensor-lag", "speed-moving-average"])
def test_a_speed_that_comes_late_is_no_witness(hiding: str) -> None:
    assert contradicted(*_fitted(_recording(DRAG), "brush-voltage-drop", hiding)) == {}


@pytest.mark.parametrize("hiding", ["magnetic-saturation", "current-sensor-lag"])
def test_a_current_that_does_not_tell_the_torque_is_no_witness(hiding: str) -> None:
    assert contradicted(*_fitted(_recording(BRUSHES), "quadratic-drag", hiding)) == {}


def test_without_a_current_or_a_motion_there_is_no_witness() -> None:
    whole = _recording(BRUSHES)
    for lost in ("current", "speed"):
        seen = replace(whole, signals={s: x for s, x in whole.signals.items() if s != lost})
        assert contradicted(*_fitted(seen, "quadratic-drag")) == {}


@pytest.mark.parametrize(("truth", "moves"), [(BRUSHES, True), (DRAG, False)], ids=["brushes", "drag"])
def test_the_shaft_alone_tells_which_equation_lacks_something(
    truth: Mapping[str, Mapping[str, float]], moves: bool
) -> None:
    found = shaft_alone(*_fitted(_recording(truth)))
    assert found is not None
    assert found.signal == "speed"
    assert found.moves_as_recorded is moves
    assert found.drive > 1.0  # rad/s; its noise is 0.1
    assert (found.alone < 0.3) is moves


@pytest.mark.parametrize(("alone", "moves"), [(0.9, True), (1.1, False), (0.75, True)])
def test_a_shaft_that_does_not_follow_the_motion_either_clears_nothing(alone: float, moves: bool) -> None:
    """As with a data sheet that is wrong by far: it errs by less than the drive, and by much more than the noise."""
    assert ShaftAlone(alone=alone, drive=10.0, noise=0.1, signal="speed").moves_as_recorded is moves
    assert not ShaftAlone(alone=alone, drive=1.0, noise=0.1, signal="speed").moves_as_recorded


def test_a_recording_that_begins_in_motion_and_has_a_position_is_judged_by_its_speed() -> None:
    """By itself such an axis is judged by its driving force."""
    whole = _recording(BRUSHES)
    position = np.cumsum(whole.signals["speed"]) * 1e-3
    moving = replace(
        whole, time=whole.time[400:] - whole.time[400],
        signals={s: x[400:] for s, x in {**whole.signals, "position": position}.items()},
    )  # fmt: skip
    found = shaft_alone(*_fitted(moving))
    assert found is not None
    assert found.signal == "speed"
    assert found.alone < 0.3  # rad/s
    assert found.moves_as_recorded


def test_what_is_contradicted_keeps_what_chance_leaves_it() -> None:
    evidence = Evidence(share=0.5, unseen=0.5, part=0.5, odds=10.0, curve=1.0)
    effect = ActingEffect(name="quadratic-drag", probability=0.45, together=0.9, share=0.5, evidence=evidence)
    assert not effect.against
    after = effect.contradicted_by("shaft")
    assert after.against == "shaft"
    assert not after.stated
    assert after.together / (1.0 - after.together) == pytest.approx(LEVEL * 0.9 / 0.1)
    assert not replace(effect, together=0.99999).contradicted_by("shaft").stated
    assert after.probability / after.together == pytest.approx(effect.probability / effect.together)
