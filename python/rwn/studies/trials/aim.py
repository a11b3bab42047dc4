"""Sets the strength of an effect, or the noise of the bench, so that the effect is as visible as planned."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rwn.studies.trials.bench import Experiment, Noise, Setup
from rwn.studies.trials.effects import Effect, Situation
from rwn.studies.trials.motors import plant_of
from rwn.studies.trials.plant import Trace, Values
from rwn.studies.trials.refit import Fit, Problem

QUIET, LOUD = 0.0015, 0.012  # rms noise of an analogue speed signal over the rms speed
TOLERANCE = 0.08  # of the visibility
ROUNDS = 12

Refit = Callable[[Sequence[Trace], Noise, Values | None], Fit]


class UnsuitableError(Exception):
    """This draw of motor, bench and effect does not make the planned trial; draw again."""


@dataclass(frozen=True)
class Scene:
    """Everything about a trial but its effects."""

    setup: Setup
    train: tuple[Experiment, ...]
    heldout: tuple[Experiment, ...]
    true: Values
    uncertainty: Values
    situation: Situation

    def plant(self, effects: Sequence[tuple[Effect, Values]]) -> Values:
        plant = plant_of(self.true)
        for effect, values in effects:
            plant |= effect.build(values, self.true)
        return plant

    def run(self, experiments: Sequence[Experiment], plant: Values) -> list[Trace]:
        try:
            traces = [self.setup.run(experiment, plant) for experiment in experiments]
        except ValueError as error:  # two effects that leave no inertia on the motor side
            raise UnsuitableError("no such machine") from error
        top = 3.0 * self.situation.voltage / self.setup.motor.torque_constant
        if not all(np.all(np.isfinite(t.speed)) and np.max(np.abs(t.speed)) < top for t in traces):
            raise UnsuitableError("the drive runs away")
        return traces


@dataclass(frozen=True)
class Aimed:
    values: Values
    noise: Noise
    traces: list[Trace]
    fit: Fit


def refit(scene: Scene, traces: Sequence[Trace], noise: Noise, guess: Values | None = None) -> Fit:
    """The nominal structure fitted about its true values."""
    problem = Problem(
        traces, centre=scene.true, uncertainty=scene.uncertainty, noise=noise, situation=scene.situation
    )
    return problem.solve(guess=None if guess is None else problem.pack(guess))[0]


def aim(
    effect: Effect, values: Values, target: float, scene: Scene, noise: Noise, *, noise_is_free: bool,
    tolerance: float = TOLERANCE, refitted: Refit | None = None,
) -> Aimed:
    """Changes the noise within its usual range first, then the strength of the effect; `refitted`: a quicker refit."""
    wanted = float(np.sqrt(target**2 - 1.0))
    guess: Values | None = None
    for _ in range(ROUNDS):
        traces = scene.run(scene.train, scene.plant([(effect, values)]))
        fit = refit(scene, traces, noise, guess) if refitted is None else refitted(traces, noise, guess)
        guess = fit.nominal
        if effect.scale is None and fit.visibility >= 2.0:
            return Aimed(values, noise, traces, fit)
        if abs(fit.visibility / target - 1.0) < tolerance:
            return Aimed(values, noise, traces, fit)
        if effect.scale is None:
            raise UnsuitableError(f"{effect.name} does not show here and has no strength")
        factor = wanted / max(fit.left["speed"], 1e-9)
        if noise_is_free:
            speed = float(np.sqrt(np.mean(np.concatenate([t.speed for t in traces]) ** 2)))
            fitting = float(np.clip(noise.speed / factor, QUIET * speed, LOUD * speed))
            factor *= fitting / noise.speed
            noise = replace(noise, speed=fitting)
        if abs(factor - 1.0) > 0.5 * tolerance:
            values = effect.scale(values, float(np.clip(factor, 0.08, 8.0)))
            if not effect.believable(values):
                raise UnsuitableError(f"{effect.name} would have to be unbelievably strong")
    raise UnsuitableError(f"the visibility of {effect.name} does not settle")
