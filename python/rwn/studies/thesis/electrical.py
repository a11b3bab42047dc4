"""Appendix E and the future work of section 6.2 (ours): R, L, Kt, J, B and the friction curve together,
with noise.

Not done in the thesis. Chosen here: 12 V chirp 0.1-60 Hz over 1 s, noise so that the ratio of the
signal's to the noise's mean square is the stated one [dB] on speed and current; start 20 % off in every
parameter, alternating in sign; static wavelets, orthogonal to the speed, selected from a library until the
next would explain no more than noise (7 to 31), a prior of 0.1 N m on every w. The network is fed with the
speed that the model itself simulates (output error), which cures the bias of a noisy input; at 40 dB beside
it with the measured speed. The viscous part is the total slope <tau, speed>/<speed, speed> along the smoothed speed: B
alone needs a convention. Kt and Kb are one parameter, as in the thesis. What voltage and speed alone
allow is the last group: R, L, Kt, J and the friction scaled together leave the speed as it is, so only
the prior on w decides the scale.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rwn.networks.arrays import Array
from rwn.networks.trainers import StructuredFit
from rwn.studies.thesis.drive import FRICTION, MOTOR, T, chirp
from rwn.studies.thesis.experiment import Experiment, Outcome, Row, Settings
from rwn.studies.thesis.noisy import RATIOS, Estimate, Feed, Noisy, noisy, rows_of
from rwn.studies.thesis.simultaneous import total_slope, true_torque

LINEAR = ("v1", "v2", "v3", "v4", "v5")
WRONG = replace(
    MOTOR,
    resistance=0.48,
    inductance=0.64e-3,
    torque_constant=0.066,
    inertia=1.44e-4,
    viscous_friction=0.072,
)


def simulate(u: Array) -> tuple[Array, Array]:
    """Speed and current of the true motor with friction."""
    speed = current = 0.0
    out = np.empty((2, len(u)))
    for n, volts in enumerate(u):
        out[:, n] = speed, current
        torque = MOTOR.torque_constant * current - MOTOR.viscous_friction * speed - float(FRICTION.torque(speed))
        current += T / MOTOR.inductance * (volts - MOTOR.resistance * current - MOTOR.torque_constant * speed)
        speed += T / MOTOR.inertia * torque
    return out[0], out[1]


def estimate(fit: StructuredFit, along: Array) -> Estimate:
    """Errors [%] of R, R/L, L, Kt, J and the total slope along a speed, and deviations of what is fitted (not R)."""
    found, v, s = fit.network.motor(T), fit.network.v, fit.deviation
    slope = total_slope(true_torque(along), along)
    ratio = found.resistance / found.inductance * MOTOR.inductance / MOTOR.resistance
    relative = {
        "R/L": (ratio, s[4] / (1 - v[4])),
        "L": (found.inductance / MOTOR.inductance, s[3] / v[3]),
        "Kt": (found.torque_constant / MOTOR.torque_constant, s[2] / v[2]),
        "J": (found.inertia / MOTOR.inertia, s[1] / v[1]),
        "total slope": (v[0] / slope, s[0] / slope),
    }
    errors = {name: 100 * float(value - 1) for name, (value, _) in relative.items()}
    return Estimate(
        error={"R": 100 * (found.resistance / MOTOR.resistance - 1), **errors},
        deviation={name: 100 * float(deviation) for name, (_, deviation) in relative.items()},
    )


def one(u: Array, speed: Array, current: Array | None, decibel: float, seed: int, feed: Feed, steps: int) -> Estimate:
    """One noisy recording, fitted."""
    rng = np.random.default_rng(seed)
    y, sigma = noisy(speed, decibel, rng)
    i, sigma_i = noisy(current, decibel, rng) if current is not None else (None, 1.0)
    recording = Noisy(voltage=u, speed=y, noise=sigma, current=i, noise_current=sigma_i)
    fit = recording.fit(WRONG, LINEAR, feed, steps)
    return estimate(fit, y if feed == "measured" else recording.source)


def run(settings: Settings) -> Outcome:
    """With and without the current, at 60 to 10 dB."""
    u = chirp(12.0, 0.1, 60.0)
    speed, current = simulate(u)
    seeds, steps = settings.pick(12, 1), settings.pick(60, 2)
    rows: list[Row] = []
    cases: list[tuple[str, Feed, float]] = [("voltage, speed, current", "simulated", d) for d in RATIOS]
    cases += [("voltage, speed, current", "measured", 40.0), ("voltage, speed", "simulated", 40.0)]
    for k, (signals, feed, decibel) in enumerate(cases[: settings.pick(len(cases), 2)]):
        with_current = current if "current" in signals else None
        found = [one(u, speed, with_current, decibel, seed, feed, steps) for seed in range(seeds)]
        goal = 1.0 if decibel == 40.0 and feed == "simulated" and with_current is not None else None
        label = f"{signals}, {decibel:.0f} dB, network fed with the {feed} speed"
        rows += rows_of("Appendix E", label, found, goal=goal)
        settings.progress((k + 1) / len(cases))
    return Outcome(rows=rows)


EXPERIMENT = Experiment(
    name="electrical",
    title="Appendix E: electrical and mechanical parameters together",
    run=run,
    minutes=1.5,
)
