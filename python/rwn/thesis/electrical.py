"""Appendix E and the future work of section 6.2 (ours): R, L, Kt, J, B and the friction curve together,
with noise.

Not done in the thesis. Chosen here: 12 V chirp 0.1-60 Hz over 1 s, noise so that the ratio of the
signal's to the noise's mean square is the stated one [dB] on speed and current; start 20 % off in every
parameter, alternating in sign; network of 15 dyadic wavelets, static, orthogonal to the speed. The
network's input is the speed that the model itself simulates (two rounds, the first from the speed
smoothed over 41 samples), which cures the bias of a noisy input. The viscous part is the total slope
<tau, speed>/<speed, speed>: B alone needs a convention. Kt and Kb are one parameter, as in the thesis.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import rwn
from rwn.arrays import Array
from rwn.thesis.drive import MOTOR, T, chirp, coulomb, dyadic_shapes
from rwn.thesis.experiment import Experiment, Outcome, Row, Settings, median_row
from rwn.trainers import StructuredFit, StructuredLevenbergMarquardt

LINEAR = ("v1", "v2", "v3", "v4", "v5")
WRONG = replace(
    MOTOR,
    resistance=0.48,
    inductance=0.64e-3,
    torque_constant=0.066,
    inertia=1.44e-4,
    viscous_friction=0.072,
)
NAMES = ("resistance", "inductance", "torque_constant", "inertia")


def simulate(u: Array) -> tuple[Array, Array]:
    """Speed and current of the true motor with friction."""
    speed = current = 0.0
    out = np.empty((2, len(u)))
    for n, volts in enumerate(u):
        out[:, n] = speed, current
        torque = MOTOR.torque_constant * current - MOTOR.viscous_friction * speed - float(coulomb(speed))
        current += T / MOTOR.inductance * (volts - MOTOR.resistance * current - MOTOR.torque_constant * speed)
        speed += T / MOTOR.inertia * torque
    return out[0], out[1]


def noisy(x: Array, decibel: float, rng: np.random.Generator) -> tuple[Array, float]:
    """x with white noise at a signal-to-noise ratio, and its deviation."""
    sigma = float(np.sqrt(np.mean(x**2)) * 10 ** (-decibel / 20))
    return x + sigma * rng.normal(size=len(x)), sigma


def smoothed(x: Array, width: int = 41) -> Array:
    """Moving average, centred."""
    padded = np.pad(x, width // 2, mode="edge")
    return np.convolve(padded, np.full(width, 1 / width), mode="valid")


def fit(
    u: Array, y: Array, current: Array | None, weight: float, *, feed: str, iterations: int
) -> StructuredFit:
    """The network fed with the measured (`raw`) or with the simulated speed."""
    source = y if feed == "raw" else smoothed(y)
    m, d = dyadic_shapes(float(source.min()), float(source.max()), 15)
    network = rwn.StructuredNetwork.from_motor(WRONG, sample_time=T, w=0 * m, m=m, d=d, c=0 * m)
    trainer = StructuredLevenbergMarquardt(iterations=iterations, tolerance=1e-8)  # noise hides the rest
    learn = (*LINEAR, "w", "m", "d")
    best = None
    for _ in range(1 if feed == "raw" else 3):
        best = trainer.fit(
            network, u, y, learn=learn, network_speed=source, current=current, current_weight=weight
        )
        network = best.network
        source = best.simulate(u, source)
    assert best is not None
    return best


def errors(found: StructuredFit, speed: Array) -> dict[str, float]:
    """Errors [%] of the four parameters and of the total viscous slope."""
    motor = found.network.motor(T)
    out = {name: 100 * (getattr(motor, name) / getattr(MOTOR, name) - 1) for name in NAMES}
    true = coulomb(speed) + MOTOR.viscous_friction * speed
    out["total slope"] = 100 * (float(found.friction(speed) @ speed) / float(true @ speed) - 1)
    return {name: abs(value) for name, value in out.items()}


def coverage(found: StructuredFit) -> list[bool]:
    """Whether the 95 % intervals of T/J, Kt, T/L and 1 - R T/L hold the truth."""
    true = rwn.StructuredNetwork.from_motor(MOTOR, sample_time=T).v
    return [bool(abs(found.network.v[k] - true[k]) <= 1.96 * found.deviation[k]) for k in (1, 2, 3, 4)]


def run(settings: Settings) -> Outcome:
    """With and without the current, at 60 to 10 dB."""
    u = chirp(12.0, 0.1, 60.0)
    speed, current = simulate(u)
    seeds, iterations, rows = range(settings.pick(5, 1)), settings.pick(60, 2), []
    cases = [("voltage, speed, current", "simulated", d) for d in (60.0, 50.0, 40.0, 30.0, 20.0, 10.0)]
    cases += [("voltage, speed, current", "raw", 40.0), ("voltage, speed", "simulated", 40.0)]
    for k, (signals, feed, decibel) in enumerate(cases[: settings.pick(len(cases), 2)]):
        found, covered = [], []
        for seed in seeds:
            rng = np.random.default_rng(seed)
            y, sigma = noisy(speed, decibel, rng)
            i, sigma_i = noisy(current, decibel, rng)
            result = fit(
                u, y, i if "current" in signals else None, sigma / sigma_i, feed=feed, iterations=iterations
            )
            found.append(errors(result, speed))
            covered += coverage(result)
        label = f"{signals}, {decibel:.0f} dB, network fed with the {feed} speed"
        count = f"{len(seeds)} seeds"
        for name in found[0]:
            goal = decibel == 40.0 and feed == "simulated" and "current" in signals
            rows.append(
                median_row(
                    "Appendix E",
                    f"{label}: {name}",
                    None,
                    [f[name] for f in found],
                    unit="%",
                    count=count,
                    judge="wanted" if goal else "none",
                    wanted=1.0 if goal else None,
                )
            )
        rows.append(
            Row(
                where="Appendix E",
                case=f"{label}: share of 95 % intervals that hold",
                ours=float(np.mean(covered)),
                judge="none",
                count=count,
            )
        )
        settings.progress((k + 1) / len(cases))
    return Outcome(rows=rows)


EXPERIMENT = Experiment(
    name="electrical", title="Appendix E: electrical and mechanical parameters together", run=run
)
