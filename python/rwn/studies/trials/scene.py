"""Draws a motor, a bench and its experiments."""

from __future__ import annotations

import numpy as np

from rwn.studies.trials import excitations
from rwn.studies.trials.aim import LOUD, QUIET, Scene, UnsuitableError
from rwn.studies.trials.bench import Experiment, Noise, Setup
from rwn.studies.trials.conceal import draw_uncertainty
from rwn.studies.trials.effects import Effect, Situation
from rwn.studies.trials.effects.definition import log_uniform
from rwn.studies.trials.motors import Motor, draw_motor, plant_of
from rwn.studies.trials.plant import Trace, Values

Rng = np.random.Generator

RATES = (500.0, 1000.0, 2000.0, 5000.0)
SIGNALS: dict[tuple[str, ...], float] = {("V", "w"): 0.32, ("V", "i", "w"): 0.43, ("V", "i", "w", "th"): 0.25}
ENCODERS = (512, 1024, 2048, 4096, 8192, 16384, 65536)
TRAIN_ROWS = (4_000, 9_000)  # all training recordings together


def draw_rate(rng: Rng, motor: Motor) -> float:
    """A sample rate that resolves the mechanical time constant without drowning in rows."""
    fitting = [rate for rate in RATES if 8.0 <= motor.time_constant * rate <= 250.0]
    if not fitting:
        raise UnsuitableError("no sample rate fits this motor")
    return float(rng.choice(fitting))


def draw_signals(rng: Rng) -> tuple[tuple[str, ...], bool]:
    """The signals, and whether an encoder makes the speed."""
    signals = list(SIGNALS)[int(rng.choice(len(SIGNALS), p=list(SIGNALS.values())))]
    return signals, "th" in signals or bool(rng.random() < 0.15)


def draw_experiments(
    rng: Rng, setup: Setup, amplitude: float, stream: tuple[int, ...]
) -> tuple[tuple[Experiment, ...], tuple[Experiment, ...]]:
    """One or two recordings for training and two others, of kinds not trained on, held out."""
    kinds = [str(kind) for kind in rng.permutation(excitations.KINDS)]
    recordings = 1 if rng.random() < 0.5 else 2
    shortest = 30.0 * setup.motor.time_constant * setup.rate
    rows = int(max(rng.uniform(*TRAIN_ROWS) / recordings, shortest))
    train = [(kind, rows) for kind in kinds[:recordings]]
    heldout = [(kind, int(max(0.6 * rows, 2000))) for kind in kinds[recordings : recordings + 2]]
    made = [
        Experiment(kind, length, amplitude * float(rng.uniform(0.8, 1.0)), (*stream, number))
        for number, (kind, length) in enumerate(train + heldout)
    ]
    return tuple(made[:recordings]), tuple(made[recordings:])


def draw_amplitude(rng: Rng, motor: Motor, *, slow: bool, dry: bool) -> float:
    """Largest voltage: small where the effect lives at low speed, but enough to overcome dry friction."""
    share = log_uniform(rng, 0.03, 0.2) if slow else log_uniform(rng, 0.1, 0.6)
    stuck = motor.resistance * motor.coulomb_friction / motor.torque_constant if dry else 0.0
    return float(min(max(share * motor.voltage, 3.0 * stuck), motor.voltage))


def situation_of(
    setup: Setup, true: Values, traces: list[Trace], duration: float, *, encoder: bool
) -> Situation:
    current = np.concatenate([t.current for t in traces])
    speed = np.concatenate([t.speed for t in traces])
    return Situation(
        motor=setup.motor,
        nominal=true,
        rate=setup.rate,
        duration=duration,
        voltage=float(max(np.max(np.abs(t.voltage)) for t in traces)),
        speed=float(np.sqrt(np.mean(speed**2))),
        current=float(np.sqrt(np.mean(current**2))),
        current_peak=float(np.max(np.abs(current))),
        signals=setup.signals,
        encoder=encoder,
    )


def draw_scene(rng: Rng, stream: tuple[int, ...], effects: list[Effect]) -> tuple[Scene, bool]:
    """A scene that suits these effects, and whether an encoder measures there; raises UnsuitableError."""
    motor = draw_motor(rng)
    dry = bool(rng.random() < 0.5)
    true = motor.nominal(dry=dry)
    signals, encoder = draw_signals(rng)
    setup = Setup(motor, draw_rate(rng, motor), signals)
    slow = bool(effects) and all(effect.slow for effect in effects)
    amplitude = draw_amplitude(rng, motor, slow=slow, dry=dry)
    train, heldout = draw_experiments(rng, setup, amplitude, stream)
    traces = [setup.run(experiment, plant_of(true)) for experiment in train]
    duration = min(e.samples for e in (*train, *heldout)) / setup.rate
    situation = situation_of(setup, true, traces, duration, encoder=encoder)
    for effect in effects:
        if not effect.suits(situation):
            raise UnsuitableError(f"{effect.name} does not suit this bench")
    return Scene(setup, train, heldout, true, draw_uncertainty(rng, true), situation), encoder


def draw_noise(rng: Rng, scene: Scene, *, encoder: bool) -> Noise:
    """Gaussian noise within the usual range, or an encoder whose error comes into that range."""
    s = scene.situation
    current = s.current * log_uniform(rng, 0.002, 0.012)
    speed = s.speed * log_uniform(rng, 2.0 * QUIET, LOUD)
    if not encoder:
        return Noise(speed, current)
    choices = [Noise.of_encoder(counts, s.rate, current) for counts in ENCODERS]
    nearest = min(choices, key=lambda noise: abs(np.log(noise.speed / speed)))
    if not QUIET / 2.0 < nearest.speed / s.speed < 3.0 * LOUD:
        raise UnsuitableError("no encoder fits this speed")
    return nearest
