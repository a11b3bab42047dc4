"""Refits of the nominal structure with derivatives that are taken once for a bench: good enough to aim effects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rwn.studies.trials.aim import Scene
from rwn.studies.trials.bench import Noise
from rwn.studies.trials.motors import plant_of
from rwn.studies.trials.plant import FIT, Array, Trace, Values, simulate
from rwn.studies.trials.refit import REACH, Fit, Problem, left_over

STEP = 0.05  # of a declared standard deviation, for the derivatives
ITERATIONS = 6
GAIN = 1e-3  # least relative gain in cost that is worth another iteration


@dataclass(frozen=True)
class QuickRefit:
    """Gauss-Newton steps; Broyden's update mends the derivatives as the point moves."""

    scene: Scene

    def __call__(
        self, traces: Sequence[Trace], noise: Noise, guess: Values | None = None, *, fixed: Values | None = None
    ) -> Fit:
        """As `aim.refit`; `fixed` overrides parameters of the plant."""
        s = self.scene
        problem = Problem(
            traces, centre=s.true, uncertainty=s.uncertainty, noise=noise, situation=s.situation, fixed=fixed
        )
        x = self._solved(problem, noise, np.zeros(len(problem.free)) if guess is None else problem.pack(guess))
        nominal, effect = problem.unpack(x)
        left = left_over(problem.plant(x), traces, noise, s.situation.signals, s.situation.rate)
        total = float(np.sqrt(np.mean([value**2 for value in left.values()])))
        return Fit(nominal, effect, left, float(np.hypot(1.0, total)))

    def _solved(self, problem: Problem, noise: Noise, x: Array) -> Array:
        slopes, residual = self._slopes(noise), problem.residual(x)
        for _ in range(ITERATIONS):
            wanted = np.linalg.lstsq(slopes, -residual, rcond=None)[0]
            moved = np.clip(x + wanted, -0.99 * REACH, 0.99 * REACH)
            step = moved - x
            reach = float(step @ step)
            if reach < 1e-12:
                break
            found = problem.residual(moved)
            slopes = slopes + np.outer(found - residual - slopes @ step, step / reach)
            before, after = float(residual @ residual), float(found @ found)
            if after < before:
                x, residual = moved, found
            if abs(before - after) < GAIN * before:
                break
        return x

    def _slopes(self, noise: Noise) -> Array:
        """(rows, values): of the prior rows and of the signals in noise units, ordered as the residual is."""
        scales = {"speed": noise.speed, "current": noise.current}
        rows = [part / scales[signal] for signal, part in self._derivatives]
        return np.vstack([np.eye(len(self.scene.uncertainty)), *rows])

    @cached_property
    def _derivatives(self) -> list[tuple[str, Array]]:
        """Of each recorded signal of each recording by the log of each value over its standard deviation."""
        s = self.scene
        out = []
        for trace in s.run(s.train, plant_of(s.true)):
            still = self._simulated(trace.voltage, s.true)
            moved = [
                self._simulated(trace.voltage, s.true | {name: s.true[name] * float(np.exp(STEP * sigma))})
                for name, sigma in s.uncertainty.items()
            ]
            for signal in ("speed", "current") if "i" in s.situation.signals else ("speed",):
                columns = [(each[signal] - still[signal]) / STEP for each in moved]
                out.append((signal, np.column_stack(columns)))
        return out

    def _simulated(self, voltage: Array, nominal: Values) -> dict[str, Array]:
        trace = simulate(plant_of(nominal), voltage, rate=self.scene.situation.rate, effort=FIT)
        return {"speed": trace.sensed_speed, "current": trace.sensed_current}
