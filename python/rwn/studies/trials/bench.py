"""A test bench: plays an excitation on the plant and measures it with noise or an encoder."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rwn.studies.trials import excitations
from rwn.studies.trials.controllers import Controller, Playback, SpeedLoop, shaped
from rwn.studies.trials.motors import Motor
from rwn.studies.trials.plant import Array, Bench, Trace, Values, simulate


@dataclass(frozen=True)
class Noise:
    """`counts` per revolution of the encoder (0: a tachometer with Gaussian noise of rms `speed`)."""

    speed: float  # rad/s
    current: float  # A
    counts: int = 0

    @classmethod
    def of_encoder(cls, counts: int, rate: float, current: float) -> Noise:
        """Rms error of the central difference of counts: q rate / (2 sqrt(6)), q = 2 pi / counts."""
        return cls(float(2.0 * np.pi / counts * rate / (2.0 * np.sqrt(6.0))), current, counts)


@dataclass(frozen=True)
class Experiment:
    """One recording to make: the excitation, its length and its own random stream."""

    kind: str
    samples: int
    amplitude: float  # V
    stream: tuple[int, ...]

    @property
    def closed_loop(self) -> bool:
        return self.kind in excitations.CLOSED_LOOP


@dataclass(frozen=True)
class Setup:
    """The bench itself; the controller is tuned on the data-sheet motor and never sees the effect."""

    motor: Motor
    rate: float
    signals: tuple[str, ...]

    @cached_property
    def loop(self) -> tuple[float, float]:
        """Proportional [V s/rad] and integral [V/rad] gain: cancels the mechanical pole."""
        motor, period = self.motor, 1.0 / self.rate
        closed = max(motor.time_constant / 2.5, 4.0 * motor.inductance / motor.resistance, 12.0 * period)
        gain = motor.torque_constant * motor.time_constant / closed
        return gain, gain / motor.time_constant

    def shape(self, experiment: Experiment) -> Array:
        table = excitations.CLOSED_LOOP if experiment.closed_loop else excitations.OPEN_LOOP
        rng = np.random.default_rng(experiment.stream)
        tau = max(self.motor.time_constant * self.rate, 8.0)
        return table[experiment.kind](rng, experiment.samples, tau)

    def controller(self, experiment: Experiment) -> Controller:
        """What commands the voltage of `experiment`: a voltage played back, or the speed loop."""
        shape = self.shape(experiment)
        if not experiment.closed_loop:
            return Playback(shaped(experiment.amplitude * shape))
        reference = shape * 0.8 * experiment.amplitude / self.motor.torque_constant
        return SpeedLoop(reference, self.loop, 1.15 * experiment.amplitude, self.rate)

    def run(self, experiment: Experiment, plant: Values) -> Trace:
        """The noise-free recording of `experiment` on the plant with these parameters."""
        controller = self.controller(experiment)
        if isinstance(controller, Playback):  # in one call
            return simulate(plant, controller.voltage, rate=self.rate)
        bench = Bench(plant, rate=self.rate, voltage_scale=controller.ceiling)
        rows = np.empty((experiment.samples, 6))
        voltage = np.empty(experiment.samples)
        for k in range(experiment.samples):
            rows[k] = bench.sample()
            voltage[k] = controller.command(k, rows[k, 1])
            bench.step(voltage[k])
        return Trace.of(voltage, rows)


@dataclass(frozen=True)
class Recording:
    """What the bench delivers; arrays (rows,), SI units, None where it does not measure."""

    time: Array
    voltage: Array
    speed: Array
    current: Array | None = None
    position: Array | None = None


def encoder(position: Array, counts: int, rate: float) -> tuple[Array, Array]:
    """Position in whole counts and its central difference (one-sided at the ends)."""
    quantum = 2.0 * np.pi / counts
    seen = quantum * np.floor(position / quantum)
    return seen, np.gradient(seen) * rate


def measure(trace: Trace, setup: Setup, noise: Noise, quantum: float, rng: np.random.Generator) -> Recording:
    """The recording of `trace` with noise; `quantum` > 0 rounds the noisy speed signal to its steps."""
    rows = trace.voltage.size
    current = trace.sensed_current + noise.current * rng.standard_normal(rows)
    if noise.counts:
        position, speed = encoder(trace.position, noise.counts, setup.rate)
    else:
        position = trace.position
        speed = trace.sensed_speed + noise.speed * rng.standard_normal(rows)
        if quantum > 0.0:
            speed = quantum * np.round(speed / quantum)
    return Recording(
        time=np.arange(rows) / setup.rate,
        voltage=trace.voltage,
        speed=speed,
        current=current if "i" in setup.signals else None,
        position=position if "th" in setup.signals else None,
    )
