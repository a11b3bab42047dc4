"""Refits the nominal structure, alone or with one candidate effect, to noise-free recordings.

The residual is in noise units: speed and, where measured, current, each divided by the rms of its noise.
On noise-free data sqrt(1 + r^2) is what a fit to the noisy recording would leave: 1 means nothing is left.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from rwn.studies.trials.bench import Noise
from rwn.studies.trials.effects import Effect, Situation
from rwn.studies.trials.motors import plant_of
from rwn.studies.trials.plant import FIT, Array, Trace, Values, simulate

REACH = 3.0  # a nominal value may move by this many declared standard deviations


@dataclass(frozen=True)
class Fit:
    """`nominal` and `effect` values found; rms left in noise units, per signal and over all signals."""

    nominal: Values
    effect: Values
    left: dict[str, float]
    total: float

    @property
    def visibility(self) -> float:
        """Of the speed signal, 1 = nothing left."""
        return float(np.hypot(1.0, self.left["speed"]))


def differences(model: Trace, truth: Trace, noise: Noise, signals: Sequence[str]) -> dict[str, Array]:
    """Residuals in noise units of the signals that are recorded."""
    out = {"speed": (model.sensed_speed - truth.sensed_speed) / noise.speed}
    if "i" in signals:
        out["current"] = (model.sensed_current - truth.sensed_current) / noise.current
    return out


def _rms(x: Array) -> float:
    return float(np.sqrt(np.mean(np.square(x))))


def left_over(
    plant: Values, traces: Sequence[Trace], noise: Noise, signals: Sequence[str], rate: float
) -> dict[str, float]:
    """Rms residual by signal of the plant with these parameters over all recordings."""
    parts: dict[str, list[Array]] = {}
    for truth in traces:
        model = simulate(plant, truth.voltage, rate=rate, effort=FIT)
        for signal, residual in differences(model, truth, noise, signals).items():
            parts.setdefault(signal, []).append(residual)
    return {signal: _rms(np.concatenate(residuals)) for signal, residuals in parts.items()}


class Problem:
    """Least squares over the uncertain nominal values (in log, bounded) and the values of one effect."""

    def __init__(
        self,
        traces: Sequence[Trace],
        *,
        centre: Values,
        uncertainty: Values,
        noise: Noise,
        situation: Situation,
        effect: Effect | None = None,
        start: Values | None = None,
        fixed: Values | None = None,
    ) -> None:
        self.traces, self.centre, self.uncertainty = traces, centre, uncertainty
        self.noise, self.situation = noise, situation
        self.effect, self.start, self.also = effect, dict(start or {}), dict(fixed or {})
        dropped = {"coulomb_friction"} if effect is not None and effect.replaces_coulomb else set()
        self.free = [name for name in uncertainty if name not in dropped]
        self.moving = [name for name in self.start if effect is not None and name not in effect.fixed]

    def unpack(self, x: Array) -> tuple[Values, Values]:
        nominal = self.centre | {
            name: float(self.centre[name] * np.exp(self.uncertainty[name] * x[k]))
            for k, name in enumerate(self.free)
        }
        effect = dict(self.start)
        for k, name in enumerate(self.moving, start=len(self.free)):
            effect[name] = float(self._moved(name, x[k]))
        return nominal, effect

    def pack(self, nominal: Values) -> Array:
        """The point where the nominal values are these and the effect is as it starts."""
        x = [float(np.log(nominal[name] / self.centre[name])) / self.uncertainty[name] for name in self.free]
        return np.array(x + [0.0] * len(self.moving))

    def _moved(self, name: str, step: float) -> float:
        assert self.effect is not None
        start = self.start[name]
        if name not in self.effect.linear:
            return start * float(np.exp(step))
        return start + step * (1.0 if self.effect.units[name] == "rad" else abs(start))

    def plant(self, x: Array) -> Values:
        nominal, values = self.unpack(x)
        plant = plant_of(nominal) | self.also
        return plant | self.effect.build(values, nominal) if self.effect is not None else plant

    def residual(self, x: Array) -> Array:
        """All rows in noise units; a prior row per value holds directions without information in place."""
        rate, signals = self.situation.rate, self.situation.signals
        parts: list[Array] = [x[: len(self.free)]]
        for truth in self.traces:
            try:
                model = simulate(self.plant(x), truth.voltage, rate=rate, effort=FIT)
            except ValueError:  # no such machine
                return np.full(self.rows, 1e6)
            for part in differences(model, truth, self.noise, signals).values():
                parts.append(np.nan_to_num(np.clip(part, -1e6, 1e6), nan=1e6))
        return np.concatenate(parts)

    @property
    def rows(self) -> int:
        signals = 2 if "i" in self.situation.signals else 1
        return len(self.free) + signals * sum(t.voltage.size for t in self.traces)

    def solve(self, *, evaluations: int = 25, guess: Array | None = None) -> tuple[Fit, Array]:
        count = len(self.free) + len(self.moving)
        x0 = np.zeros(count) if guess is None else guess
        reach = np.concatenate([np.full(len(self.free), REACH), np.full(len(self.moving), 6.0)])
        if count:
            found = least_squares(
                self.residual,
                np.clip(x0, -0.99 * reach, 0.99 * reach),
                bounds=(-reach, reach),
                diff_step=1e-4,
                ftol=1e-4,
                xtol=1e-5,
                max_nfev=evaluations,
            )
            x0 = found.x
        nominal, effect = self.unpack(x0)
        s = self.situation
        left = left_over(self.plant(x0), self.traces, self.noise, s.signals, s.rate)
        total = float(np.sqrt(np.mean([value**2 for value in left.values()])))
        return Fit(nominal, effect, left, float(np.hypot(1.0, total))), x0


ENOUGH = 1.02  # a rival that leaves less than this, in noise units, reproduces the recordings
PROMISING = 0.8  # of what the refitted nominal model leaves, after a first look: worth a longer fit
STRENGTHS = (0.1, 1.0)  # of the effect where a fit starts


def fit_rival(
    effect: Effect,
    traces: Sequence[Trace],
    *,
    centre: Values,
    uncertainty: Values,
    noise: Noise,
    situation: Situation,
    near: Fit,
    known: Values,
    rng: np.random.Generator,
) -> float:
    """What the best fit of a candidate effect leaves, in noise units over all signals.

    Starts from the nominal values of the refit `near`, with the effect weak and strong; what no fit moves
    (a number of periods) is taken from `known` where it is there. A short look decides about a long fit.
    """
    best = np.inf
    for strength in STRENGTHS:
        start = effect.draw(rng, situation)
        if effect.scale is not None:
            start = effect.scale(start, strength)
        start |= {key: value for key, value in known.items() if key in start and key in effect.fixed}
        problem = Problem(
            traces,
            centre=centre,
            uncertainty=uncertainty,
            noise=noise,
            situation=situation,
            effect=effect,
            start=start,
        )
        guess = problem.pack(near.nominal)
        fit, found = problem.solve(evaluations=7, guess=guess)
        if fit.total < max(1.0 + PROMISING * (near.total - 1.0), 1.2):
            fit, _ = problem.solve(evaluations=20, guess=found)
        best = min(best, fit.total)
        if best < ENOUGH:
            break
    return best
