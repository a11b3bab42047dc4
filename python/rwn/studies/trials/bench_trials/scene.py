"""Draws a motor, a rig, its instruments with their imperfections, and the experiments."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rwn.studies.trials import excitations
from rwn.studies.trials.aim import LOUD, QUIET, Scene, UnsuitableError
from rwn.studies.trials.bench import Experiment, Noise
from rwn.studies.trials.bench_trials import imperfections
from rwn.studies.trials.bench_trials.imperfections import EncoderDifference, Imperfection, Instruments
from rwn.studies.trials.bench_trials.plan import ACTUATORS, BenchPlan
from rwn.studies.trials.bench_trials.rig import Rig
from rwn.studies.trials.conceal import draw_uncertainty
from rwn.studies.trials.effects import BACKGROUND, EFFECTS, Situation
from rwn.studies.trials.motors import Motor, draw_motor, plant_of
from rwn.studies.trials.plant import Values
from rwn.studies.trials.scene import draw_amplitude, draw_noise, draw_signals, situation_of

Rng = np.random.Generator
Experiments = tuple[Experiment, ...]

RATES = tuple(100.0 * r for r in (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 7.5, 8, 10, 15, 20, 25, 30, 40, 50))  # Hz
USUAL, COARSE = (8.0, 150.0), (4.0, 8.0)  # rows per mechanical time constant
COARSE_SHARE = 0.2  # of the trials
SAG_SHARE = 0.15  # of the trials: a supply that sags, where the drive reports what it applies
TRAIN_ROWS = (2_500, 7_000)  # all training recordings together
MOST_ROWS = 6_000  # of one recording
MOST_TICKS = 12_000  # of all training recordings, before an imperfection takes rows away
ENCODER_NOISE = (QUIET / 3.0, 4.0 * LOUD)  # rms of a counted and smoothed speed over the rms speed


@dataclass(frozen=True, kw_only=True)
class BenchScene:
    """A scene as the aiming of effects takes it, and what records it."""

    scene: Scene
    chain: tuple[Imperfection, ...]
    noise: Noise
    noise_is_free: bool  # within its usual range: nobody counts
    coarse: bool


def draw_bench(rng: Rng, stream: tuple[int, ...], plan: BenchPlan) -> BenchScene:
    """A bench that suits the plan; raises UnsuitableError where this draw does not."""
    effects = [EFFECTS[name] for name in plan.effects]
    motor = draw_motor(rng)
    dry = bool(rng.random() < 0.5)
    true = motor.nominal(dry=dry)
    coarse = bool(rng.random() < COARSE_SHARE)
    rate = _draw_rate(rng, motor, coarse=coarse)
    signals, encoder = draw_signals(rng)
    counts = (1 + int(rng.choice(3, p=[0.4, 0.4, 0.2])), 1 + int(rng.random() < 0.6))
    instruments = Instruments(signals=signals, encoder=encoder, rate=rate, coarse=coarse, recordings=sum(counts))
    chain = imperfections.draw(rng, instruments, unlike=plan.effects)
    kept = float(np.prod([each.kept for each in chain]))
    slow = bool(effects) and all(effect.slow for effect in effects)
    amplitude = draw_amplitude(rng, motor, slow=slow, dry=dry)
    rig = Rig(motor, rate, signals)
    train, heldout = _draw_experiments(rng, rig, amplitude, stream, counts, kept)
    differenced = [each for each in chain if isinstance(each, EncoderDifference)]
    rig, situation = _supplied(rng, rig, plan, (train, heldout), true, counted=encoder or bool(differenced))
    for effect in [*effects, *([BACKGROUND[plan.background]] if plan.background else [])]:
        if not effect.suits(situation):
            raise UnsuitableError(f"{effect.name} does not suit this bench")
    scene = Scene(rig, train, heldout, true, draw_uncertainty(rng, true), situation)
    noise = draw_noise(rng, scene, encoder=encoder and not differenced)
    if differenced:
        noise = _counting(noise, differenced[0], situation)
    return BenchScene(
        scene=scene, chain=chain, noise=noise, noise_is_free=not situation.encoder, coarse=coarse
    )


def _draw_rate(rng: Rng, motor: Motor, *, coarse: bool) -> float:
    low, high = COARSE if coarse else USUAL
    fitting = [rate for rate in RATES if low <= motor.time_constant * rate <= high]
    if not fitting:
        raise UnsuitableError("no sample rate fits this motor")
    return float(rng.choice(fitting))


def _draw_experiments(
    rng: Rng, rig: Rig, amplitude: float, stream: tuple[int, ...], counts: tuple[int, int], kept: float
) -> tuple[Experiments, Experiments]:
    """For training and held out, all of different kinds; longer where an imperfection takes rows away."""
    kinds = [str(kind) for kind in rng.permutation(excitations.KINDS)]
    train, heldout = counts
    shortest = 30.0 * rig.motor.time_constant * rig.rate
    rows = min(max(rng.uniform(*TRAIN_ROWS) / train, shortest), MOST_ROWS) / kept
    rows = int(min(rows, MOST_TICKS / train))
    lengths = [rows] * train + [int(max(0.6 * rows, 1500 / kept))] * heldout
    made = tuple(
        Experiment(kind, length, amplitude * float(rng.uniform(0.8, 1.0)), (*stream, number))
        for number, (kind, length) in enumerate(zip(kinds, lengths, strict=False))
    )
    return made[:train], made[train:]


def _supplied(
    rng: Rng, rig: Rig, plan: BenchPlan, experiments: tuple[Experiments, Experiments], true: Values, *, counted: bool
) -> tuple[Rig, Situation]:
    """The rig, some with a supply that sags and a drive that reports it, and how the motor runs on it."""
    train, heldout = experiments
    duration = min(e.samples for e in (*train, *heldout)) / rig.rate

    def on(rig: Rig) -> Situation:
        traces = [rig.run(experiment, plant_of(true)) for experiment in train]
        return situation_of(rig, true, traces, duration, encoder=counted)

    situation = on(rig)
    sag = BACKGROUND["supply-sag"]
    if rng.random() > SAG_SHARE or ACTUATORS & {*plan.effects, plan.background}:
        return rig, situation
    rig = replace(rig, supply=sag.build(sag.draw(rng, situation), true))
    return rig, on(rig)


def _counting(noise: Noise, encoder: EncoderDifference, situation: Situation) -> Noise:
    """The noise of a speed that a drive counts and smooths."""
    error = encoder.speed_error(situation.rate)
    low, high = ENCODER_NOISE
    if not low < error / situation.speed < high:
        raise UnsuitableError("this encoder does not fit this speed")
    return replace(noise, speed=error, counts=0)
