"""Makes one blind trial: draws the scene, conceals the effects, measures, and writes down the truth."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rwn.studies.trials.aim import Aimed, UnsuitableError, aim, refit
from rwn.studies.trials.bench import Experiment, Noise, Recording, measure
from rwn.studies.trials.conceal import Nominal, nominal_as
from rwn.studies.trials.effects import EFFECTS, Effect
from rwn.studies.trials.motors import plant_of
from rwn.studies.trials.plan import SPLITS, Plan, redealt, split_of
from rwn.studies.trials.plant import Trace, Values, simulate
from rwn.studies.trials.refit import ENOUGH, Fit, Problem, fit_rival, left_over
from rwn.studies.trials.scene import draw_noise, draw_scene

Rng = np.random.Generator
Cast = list[tuple[Effect, Values]]

NEEDED = 1.3  # of two effects, each alone must leave at least this
PATIENCE = 12  # benches that are tried before other effects are dealt
ATTEMPTS = 20 * PATIENCE


@dataclass(frozen=True)
class Trial:
    """`notes`: small files that lie with the recordings, name to text."""

    nominal: Nominal
    train: tuple[Recording, ...]
    heldout: tuple[Recording, ...]
    answer: dict[str, Any]
    notes: dict[str, str] = field(default_factory=dict)


def make_trial(plan: Plan) -> Trial:
    """The trial of `plan`; draws again until motor, bench and effect make it possible."""
    for attempt in range(ATTEMPTS):
        if attempt and attempt % PATIENCE == 0:
            plan = redealt(plan, attempt)
        stream = (SPLITS.index(split_of(plan.seed)), plan.seed, plan.index, attempt)
        try:
            return _Composer(plan, stream).compose()
        except UnsuitableError:
            continue
    raise RuntimeError(f"{plan.name}: no bench found for {plan.effects} at visibility {plan.visibility}")


def must_move(traces: Sequence[Trace]) -> None:
    """Raises UnsuitableError where a recording stands still throughout: it proves nothing."""
    if not all(np.ptp(t.speed) > 0.0 for t in traces):
        raise UnsuitableError("a recording never moves")


class _Composer:
    def __init__(self, plan: Plan, stream: tuple[int, ...]) -> None:
        self.plan = plan
        self.rng = np.random.default_rng(stream)
        self.effects = [EFFECTS[name] for name in plan.effects]
        self.scene, self.encoder = draw_scene(self.rng, stream, self.effects)

    def compose(self) -> Trial:
        noise = draw_noise(self.rng, self.scene, encoder=self.encoder)
        cast, noise, each = self._cast(noise)
        plant = self.scene.plant(cast)
        train = self.scene.run(self.scene.train, plant)
        heldout = self.scene.run(self.scene.heldout, plant)
        must_move(heldout)
        fit = refit(self.scene, train, noise)
        if len(cast) > 1:
            self._both_needed(cast, train, noise)
        nominal = nominal_as(self.plan.mode, self.rng, self.scene.true, self.scene.uncertainty, fit.nominal)
        rivals = self._rivals(cast, train, noise, nominal, fit)
        if self.plan.mode == "novel" and min(rivals.values(), default=np.inf) < ENOUGH:
            raise UnsuitableError("a named effect reproduces the unnamed one")
        answer = self._answer(cast, noise, fit, each, nominal, heldout, plant)
        if rivals:
            truth = self._truth(plant, train, noise)
            answer["rival_residuals"] = {"truth": truth, "nominal": round(fit.total, 4)} | rivals
        answer["equivalent"] = [name for name, left in rivals.items() if left < ENOUGH]
        return Trial(
            nominal,
            self._measured(self.scene.train, plant, noise),
            self._measured(self.scene.heldout, plant, noise),
            answer,
        )

    def _cast(self, noise: Noise) -> tuple[Cast, Noise, dict[str, float]]:
        """The effects with their strengths; the noise follows the first one where it may."""
        cast: Cast = []
        each: dict[str, float] = {}
        for number, effect in enumerate(self.effects):
            free = number == 0 and not self.encoder
            drawn = effect.draw(self.rng, self.scene.situation)
            aimed: Aimed = aim(effect, drawn, self.plan.visibility, self.scene, noise, noise_is_free=free)
            noise = aimed.noise
            each[effect.name] = round(aimed.fit.visibility, 3)
            cast.append((effect, aimed.values))
        return cast, noise, each

    def _both_needed(self, cast: Cast, train: list[Trace], noise: Noise) -> None:
        """Neither of the two effects, with the nominal values refitted, does the other's work."""
        for effect, values in cast:
            problem = Problem(
                train,
                centre=self.scene.true,
                uncertainty=self.scene.uncertainty,
                noise=noise,
                situation=self.scene.situation,
                effect=effect,
                start=values,
            )
            if problem.solve(evaluations=15)[0].total < NEEDED:
                raise UnsuitableError(f"{effect.name} alone does it")

    def _rivals(
        self, cast: Cast, train: list[Trace], noise: Noise, nominal: Nominal, fit: Fit
    ) -> dict[str, float]:
        """What named rivals of a single effect leave, in noise units, over all signals."""
        if len(cast) != 1:
            return {}
        effect, values = cast[0]
        candidates = [EFFECTS[name] for name in effect.rivals]
        return {
            rival.name: round(
                fit_rival(
                    rival,
                    train,
                    centre=nominal.values,
                    uncertainty=nominal.uncertainty,
                    noise=noise,
                    situation=self.scene.situation,
                    near=fit,
                    known=values,
                    rng=self.rng,
                ),
                4,
            )
            for rival in candidates
            if rival.named and rival.suits(self.scene.situation)
        }

    def _truth(self, plant: Values, train: list[Trace], noise: Noise) -> float:
        """The same for the true plant: what the coarser steps of the fits alone leave."""
        s = self.scene.situation
        left = left_over(plant, train, noise, s.signals, s.rate)
        return round(float(np.hypot(1.0, np.sqrt(np.mean([v**2 for v in left.values()])))), 4)

    def _measured(
        self, experiments: tuple[Experiment, ...], plant: Values, noise: Noise
    ) -> tuple[Recording, ...]:
        """The recordings; a sensor that rounds does so after the noise, so the plant must not."""
        quantum = plant.get("speed_quantum", 0.0)
        traces = self.scene.run(experiments, plant | {"speed_quantum": 0.0})
        return tuple(measure(trace, self.scene.setup, noise, quantum, self.rng) for trace in traces)

    def _answer(
        self,
        cast: Cast,
        noise: Noise,
        fit: Fit,
        each: dict[str, float],
        nominal: Nominal,
        heldout: list[Trace],
        plant: Values,
    ) -> dict[str, Any]:
        scene, named = self.scene, self.plan.mode != "novel"
        signals = scene.situation.signals
        verdict = "adequate" if not cast else "missing-physics" if named else "unexplained"
        by_signal = {name: round(float(np.hypot(1.0, left)), 3) for name, left in fit.left.items()}
        return {
            "case": self.plan.name,
            "verdict": verdict,
            "effects": [description(effect, values) for effect, values in cast],
            "equivalent": [],
            "mode": self.plan.mode,
            "visibility": round(fit.visibility, 3),
            "visibility_target": self.plan.visibility,
            "visibility_each": each,
            "visibility_by_signal": {"speed": by_signal["speed"], "current": by_signal.get("current")},
            "score_signal": "speed",
            "signals": list(signals),
            "motor": scene.setup.motor.name,
            "sample_rate_Hz": scene.setup.rate,
            "excitation": {
                "train": [e.kind for e in scene.train],
                "heldout": [e.kind for e in scene.heldout],
            },
            "noise": {
                "kind": "encoder" if noise.counts else "gaussian",
                "counts": noise.counts,
                "speed_rms": noise.speed,
                "current_rms": noise.current,
                "speed_rms_relative": noise.speed / scene.situation.speed,
            },
            "true_parameters": scene.true,
            "refitted_parameters": fit.nominal,
            "heldout_effect_in_noise": [
                round(free_run_error(fit.nominal, t, scene.setup.rate) / noise.speed, 3) for t in heldout
            ],
            "heldout_E_nominal": [
                round(free_run_error(nominal.values, t, scene.setup.rate) / float(np.std(t.speed)), 5)
                for t in heldout
            ],
            "plant": plant,
        }


def free_run_error(nominal: Values, truth: Trace, rate: float) -> float:
    """Rms free-run speed error of a nominal model on a noise-free recording [rad/s]."""
    model = simulate(plant_of(nominal), truth.voltage, rate=rate)
    return float(np.sqrt(np.mean((model.speed - truth.sensed_speed) ** 2)))


def description(effect: Effect, values: Values) -> dict[str, Any]:
    return {
        "name": effect.name,
        "equation": effect.equation,
        "parameters": {name: {"value": values[name], "unit": unit} for name, unit in effect.units.items()},
    }
