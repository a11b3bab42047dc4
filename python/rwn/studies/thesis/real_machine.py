"""The structured network of chapter 4 for the friction of a real machine (FRA233), recurrent and static (ours).

FRA233 is a small brushed motor of which commanded voltage and speed are recorded; nothing but speed tells of its
friction. Its inertia, viscous friction and the wavelets are fitted to a sine and a ramp by this package's Gauss-Newton
with damping (`StructuredLevenbergMarquardt`), resistance, inductance and torque constant being those of its users; a
step run and a stair run judge. The static network has c = 0; the recurrent one, whose wavelets feed back their own
outputs, starts from the same wavelets, or goes on from what the static one has found. Both are fed with the measured
speed, as in the thesis; the error that counts is that of the free run, fed with the speed that the model itself finds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from rich.table import Table

import rwn
from rwn.networks.arrays import Array
from rwn.networks.initialisation import StructuredSelection
from rwn.networks.trainers import StructuredFit, StructuredLevenbergMarquardt
from rwn.recording.recording import Recording
from rwn.studies.machines.fra233 import recordings
from rwn.studies.machines.machine import nominal_model

SIZES = (7, 15)
MOTOR, SHAPE = ("v1", "v2"), ("w", "m", "d")


@dataclass(frozen=True, kw_only=True)
class Stand:
    """A stand-in for the friction: rms errors of the speed [rad/s] by recording, fitted and not, with the network fed
    with the speed that the model finds (`free`) and with the measured one (`fed`)."""

    name: str
    free: dict[str, float]
    fed: dict[str, float]


def compare(folder: Path, *, iterations: int = 200) -> tuple[list[Stand], set[str]]:
    """Errors by stand-in, and the names of the recordings that were not fitted.

    Raises InputError where the recordings are not in `folder`.
    """
    fitted, heldout = recordings(folder)
    motor = _nominal(fitted[0])
    voltage, speed = (np.concatenate([r.signals[name] for r in fitted]) for name in ("voltage", "speed"))
    begin = _state(motor, fitted[0])  # of the first: what the others begin with is forgotten in 20 ms
    free_trainer = StructuredLevenbergMarquardt(iterations=iterations)

    def fit(network: rwn.StructuredNetwork, learn: Sequence[str], *, first: bool = True) -> StructuredFit:
        trainer = replace(free_trainer, weights_first=first, gauge=network.wavelets > 0)
        return trainer.fit(network, voltage, speed, learn=(*MOTOR, *learn), start=begin)

    linear = fit(motor, (), first=False)
    fits = {"no network": linear}
    for count in SIZES:
        start = StructuredSelection(levels=5).start(linear.network, voltage, speed, wavelets=count, linear=MOTOR)
        static = fit(start, SHAPE)
        fits[f"{count} wavelets, static"] = static
        fits[f"{count} wavelets, recurrent"] = fit(start, (*SHAPE, "c"))
        fits[f"{count} wavelets, recurrent, going on from the static"] = fit(
            static.network, (*SHAPE, "c"), first=False
        )
        fits[f"{count} wavelets, static, fitted in free run"] = free_trainer.fit(
            start, voltage, speed, learn=(*MOTOR, *SHAPE), start=begin, feed="simulated"
        )
    return [_stand(name, found, [*fitted, *heldout]) for name, found in fits.items()], {r.name for r in heldout}


def table(stands: Sequence[Stand], heldout: set[str]) -> Table:
    """Errors of the speed [rad/s] in free run, and in brackets fed with the measured speed."""
    heads = [f"{name}{', not fitted' if name in heldout else ''}" for name in stands[0].free]
    made = Table("friction", *heads, title="rms error of the speed in rad/s, free run (fed with the measured speed)")
    for stand in stands:
        made.add_row(stand.name, *(f"{stand.free[name]:.2f} ({stand.fed[name]:.2f})" for name in stand.free))
    return made


def free_run(fit: StructuredFit, voltage: Array, start: Array) -> Array:
    """Speed (n,) [rad/s] for the voltage (n,) [V] from the state `start`, the network fed with that speed, with its
    recurrence (`StructuredFit.free_run` has none)."""
    network, state, phi = fit.network, start, np.zeros(fit.network.wavelets)
    plant, v2, v4 = network.plant, float(network.v[1]), float(network.v[3])
    speed = np.empty(len(voltage))
    for n, volts in enumerate(voltage):
        speed[n] = state[0]
        phi = network.wavelet.value((state[0] + network.c * phi - network.m) / network.d)
        torque = float(phi @ network.w) - fit.slope * state[0]
        state = plant @ state + np.array([-v2 * torque, v4 * volts])
    return speed


def _nominal(recording: Recording) -> rwn.StructuredNetwork:
    """The motor as its users have measured it, at the recording's sampling."""
    values = nominal_model("fra233").motor
    known = rwn.MotorParameters(
        resistance=values["resistance"],
        inductance=values["inductance"],
        torque_constant=values["torque_constant"],
        inertia=values["inertia"],
        viscous_friction=values["viscous_friction"],
    )
    step = float(np.mean(np.diff(recording.time)))
    return rwn.StructuredNetwork.from_motor(known, sample_time=step)


def _state(motor: rwn.StructuredNetwork, recording: Recording) -> Array:
    """Speed and current that begin a recording, the current having settled."""
    voltage, speed = float(recording.signals["voltage"][0]), float(recording.signals["speed"][0])
    kt, v4, v5 = (float(v) for v in motor.v[2:])
    return np.array([speed, v4 / (1 - v5) * (voltage - kt * speed)])


def _stand(name: str, fit: StructuredFit, judged: Sequence[Recording]) -> Stand:
    free, fed = {}, {}
    for recording in judged:
        voltage, speed = recording.signals["voltage"], recording.signals["speed"]
        start = _state(fit.network, recording)
        free[recording.name] = _rms(free_run(fit, voltage, start) - speed)
        fed[recording.name] = _rms(fit.simulate(voltage, speed, start=start) - speed)
    return Stand(name=name, free=free, fed=fed)


def _rms(error: Array) -> float:
    return float(np.sqrt(np.mean(error**2)))
