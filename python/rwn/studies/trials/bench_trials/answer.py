"""What is true of a bench trial, for the sealed answers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rwn.studies.trials.bench import Noise, Recording
from rwn.studies.trials.bench_trials.plan import BenchPlan
from rwn.studies.trials.bench_trials.rig import Rig
from rwn.studies.trials.bench_trials.scene import BenchScene
from rwn.studies.trials.conceal import Nominal
from rwn.studies.trials.effects import Effect
from rwn.studies.trials.plant import Trace, Values
from rwn.studies.trials.refit import ENOUGH, Fit
from rwn.studies.trials.trial import description, free_run_error

SAG_IS_LIKE = frozenset({"voltage-saturation"})  # a supply that sags limits the voltage


@dataclass(frozen=True, kw_only=True)
class Findings:
    """Everything that making the trial came to know; `written` and `clean` are training recordings first."""

    plan: BenchPlan
    bench: BenchScene
    cast: list[tuple[Effect, Values]]
    each: dict[str, float]
    noise: Noise
    fit: Fit
    nominal: Nominal
    heldout: list[Trace]
    plant: Values
    rivals: dict[str, float]
    written: Sequence[Recording]
    clean: Sequence[Recording]

    @property
    def clean_heldout(self) -> Sequence[Recording]:
        return self.clean[len(self.bench.scene.train) :]


def answer(f: Findings) -> dict[str, Any]:
    """As the answers of other trials, with background, imperfections and judge."""
    plan, scene = f.plan, f.bench.scene
    named = f.cast[: len(plan.effects)]
    verdict = "missing-physics" if named else "unexplained" if f.cast else "adequate"
    by_signal = {name: round(float(np.hypot(1.0, left)), 3) for name, left in f.fit.left.items()}
    like = {name for each in f.bench.chain for name in each.like}
    like |= SAG_IS_LIKE if plan.background == "supply-sag" else set()
    return {
        "case": plan.name,
        "verdict": verdict,
        "effects": [description(effect, values) for effect, values in named],
        "equivalent": [name for name, left in f.rivals.items() if named and left < ENOUGH],
        "background": _background(f),
        "imperfections": [{"kind": each.kind} | each.sizes() for each in f.bench.chain],
        "also_true": sorted(like - set(plan.effects)),
        "judge": plan.judge,
        "heldout_given": plan.heldout_given,
        "mode": plan.mode,
        "nominal": plan.nominal,
        "visibility": round(f.fit.visibility, 3),
        "visibility_target": plan.most,
        "visibility_each": f.each,
        "visibility_by_signal": {"speed": by_signal["speed"], "current": by_signal.get("current")},
        "rival_residuals": f.rivals,
        "score_signal": "speed",
        "signals": list(scene.situation.signals),
        "motor": scene.setup.motor.name,
        "sample_rate_Hz": scene.setup.rate,
        "coarse": f.bench.coarse,
        "supply": scene.setup.supply if isinstance(scene.setup, Rig) else {},
        "excitation": {"train": [e.kind for e in scene.train], "heldout": [e.kind for e in scene.heldout]},
        "noise": _noise(f),
        "true_parameters": scene.true,
        "refitted_parameters": f.fit.nominal,
        **_errors(f),
        "heldout_clean_speed": [[float(f"{w:.6g}") for w in r.speed] for r in f.clean_heldout],
        "plant": f.plant,
    }


def _background(f: Findings) -> dict[str, Any] | None:
    if not f.plan.background:
        return None
    effect, values = f.cast[-1]
    said = description(effect, values)
    return {"kind": said.pop("name"), "visibility": f.each[effect.name]} | said


def _noise(f: Findings) -> dict[str, Any]:
    """Of the sensors, and what of it is in the speed as recorded: half of the errors are within 0.6745 sigma."""
    pairs = zip(f.written, f.clean, strict=True)
    off = np.concatenate([np.abs(dirty.speed - clean.speed) for dirty, clean in pairs])
    return {
        "kind": "encoder" if f.bench.scene.situation.encoder else "gaussian",
        "counts": f.noise.counts,
        "speed_rms": f.noise.speed,
        "current_rms": f.noise.current,
        "speed_rms_relative": f.noise.speed / f.bench.scene.situation.speed,
        "recorded_speed_rms": float(np.median(off)) / 0.6745,
    }


def _errors(f: Findings) -> dict[str, list[float]]:
    """What the refitted and the given nominal model leave of the held-out speeds."""
    rate = f.bench.scene.setup.rate
    refitted = [free_run_error(f.fit.nominal, t, rate) / f.noise.speed for t in f.heldout]
    given = [free_run_error(f.nominal.values, t, rate) / float(np.std(t.speed)) for t in f.heldout]
    return {
        "heldout_effect_in_noise": [round(error, 3) for error in refitted],
        "heldout_E_nominal": [round(error, 5) for error in given],
    }
