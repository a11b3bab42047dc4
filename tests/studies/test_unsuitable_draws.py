"""What makes a draw of a blind trial unsuitable, so that another one is drawn; and what ends the drawing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from rwn.studies.trials import trial as plain_trial
from rwn.studies.trials.aim import Scene, UnsuitableError, aim
from rwn.studies.trials.bench import Noise, Recording
from rwn.studies.trials.bench_trials import plan as bench_plan
from rwn.studies.trials.bench_trials import scene as bench_scene
from rwn.studies.trials.bench_trials import trial as bench_trial
from rwn.studies.trials.bench_trials.imperfections import EncoderDifference
from rwn.studies.trials.effects import EFFECTS
from rwn.studies.trials.motors import MOTORS
from rwn.studies.trials.plan import Plan
from rwn.studies.trials.plant import Trace
from rwn.studies.trials.refit import Fit
from rwn.studies.trials.scene import draw_noise, draw_rate, draw_scene


@pytest.fixture(scope="module")
def scene() -> Scene:
    return draw_scene(np.random.default_rng(1), (0, 1, 1), [])[0]


def test_a_drive_that_runs_away_is_no_machine(scene: Scene) -> None:
    pushed = scene.plant([]) | {"viscous_friction": -1e3 * scene.true["viscous_friction"] - 1.0}
    with pytest.raises(UnsuitableError, match="the drive runs away"):
        scene.run(scene.train, pushed)


def seen(*left: float) -> Callable[..., Fit]:
    """A refit that leaves these, in noise units, one after the other."""
    turns = iter(left)
    return lambda traces, noise, guess: Fit({}, {}, {"speed": next(turns)}, 1.0)  # noqa: ARG005


@pytest.mark.parametrize(
    ("changed", "left", "said"),
    [
        ({"scale": None}, (0.1,), "quadratic-drag does not show here and has no strength"),
        ({"limits": {"drag_coefficient": (0.0, 1e-12)}}, (0.1,), "quadratic-drag would have to be unbelievably strong"),
        ({}, (0.1, 99.0) * 50, "the visibility of quadratic-drag does not settle"),
    ],
)
def test_an_effect_that_cannot_be_aimed(
    changed: dict[str, Any], left: tuple[float, ...], said: str, scene: Scene
) -> None:
    known = EFFECTS["quadratic-drag"]
    values = known.draw(np.random.default_rng(0), scene.situation)
    with pytest.raises(UnsuitableError, match=said):
        aim(
            replace(known, **changed), values, 10.0, scene, Noise(0.1, 0.01), noise_is_free=False,
            refitted=seen(*left),
        )  # fmt: skip


def test_an_effect_without_a_strength_is_taken_as_it_shows(scene: Scene) -> None:
    effect = replace(EFFECTS["quadratic-drag"], scale=None)
    values = effect.draw(np.random.default_rng(0), scene.situation)
    aimed = aim(effect, values, 10.0, scene, Noise(0.1, 0.01), noise_is_free=False, refitted=seen(3.0))
    assert aimed.values == values
    assert all(isinstance(trace, Trace) for trace in aimed.traces)


def test_a_motor_that_no_rate_resolves(scene: Scene) -> None:
    quick = replace(MOTORS[0], inertia=1e-6 * MOTORS[0].inertia)
    rng = np.random.default_rng(0)
    with pytest.raises(UnsuitableError, match="no sample rate fits this motor"):
        draw_rate(rng, quick)
    for coarse in (False, True):
        with pytest.raises(UnsuitableError, match="no sample rate fits this motor"):
            bench_scene._draw_rate(rng, quick, coarse=coarse)
        low, high = bench_scene.COARSE if coarse else bench_scene.USUAL
        rate = bench_scene._draw_rate(rng, scene.setup.motor, coarse=coarse)
        assert low <= rate * scene.setup.motor.time_constant <= high


def test_a_speed_that_no_encoder_measures(scene: Scene) -> None:
    slow = replace(scene, situation=replace(scene.situation, speed=1e-6))
    with pytest.raises(UnsuitableError, match="no encoder fits this speed"):
        draw_noise(np.random.default_rng(0), slow, encoder=True)
    fine = EncoderDifference(counts=4096, window=8)
    error = fine.speed_error(scene.situation.rate)
    fitting = replace(scene.situation, speed=error / 0.01)
    assert bench_scene._counting(Noise(1.0, 0.1, 512), fine, fitting) == Noise(error, 0.1, 0)
    with pytest.raises(UnsuitableError, match="this encoder does not fit this speed"):
        bench_scene._counting(Noise(1.0, 0.1), fine, replace(fitting, speed=1e-3 * fitting.speed))


def test_recordings_that_say_nothing() -> None:
    time = 1e-3 * np.arange(400)
    moving = Recording(time=time, voltage=np.ones(400), speed=np.sin(time), current=np.cos(time))
    bench_trial._readable([moving, replace(moving, current=None)])
    few = {name: getattr(moving, name)[:299] for name in ("time", "voltage", "speed", "current")}
    for useless in (replace(moving, **few), replace(moving, current=np.zeros(400)), replace(moving, speed=0.0 * time)):
        with pytest.raises(UnsuitableError, match="a recording says nothing"):
            bench_trial._readable([moving, useless])


BENCH = next(plan for plan in bench_plan.plans(5, 8) if plan.effects)
PLAIN = Plan(3, 1, "masked", ("quadratic-drag",), 10.0)


@pytest.mark.parametrize(
    ("module", "make", "plan"),
    [(plain_trial, plain_trial.make_trial, PLAIN), (bench_trial, bench_trial.make_bench_trial, BENCH)],
)
def test_others_of_its_kind_are_dealt_before_it_is_given_up(
    module: ModuleType, make: Callable[[Any], Any], plan: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a plan that no bench shows: every attempt has numbers of its own, and after some another plan."""
    tried: list[tuple[Any, tuple[int, ...]]] = []

    def draw(of: Any, stream: tuple[int, ...]) -> None:
        tried.append((of, stream))
        raise UnsuitableError("never")

    monkeypatch.setattr(module, "_Composer", draw)
    with pytest.raises(RuntimeError, match="no bench found"):
        make(plan)
    assert len({stream for _, stream in tried}) == len(tried) == plain_trial.ATTEMPTS
    assert {of.name for of, _ in tried} == {plan.name}
    assert all(of == plan for of, _ in tried[: plain_trial.PATIENCE])
    assert len({of.effects for of, _ in tried}) > 1
