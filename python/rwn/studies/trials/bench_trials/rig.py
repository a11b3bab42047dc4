"""A test bench with a supply of its own, and what truly happens on it between the ticks of its controller."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from rwn.studies.trials.bench import Experiment, Setup
from rwn.studies.trials.controllers import shaped
from rwn.studies.trials.judges import FINE, Judge, State
from rwn.studies.trials.plant import Array, Trace, Values

CURRENT, SPEED, POSITION, SENSED_CURRENT, SENSED_SPEED = range(5)  # of a judge's state


@dataclass(frozen=True, kw_only=True)
class Truth:
    """One experiment: `states` (FINE ticks + 1, 6) at the fine instants, `voltage` (ticks,) as the drive reports it."""

    rate: float
    voltage: Array
    states: Array

    @property
    def ticks(self) -> int:
        return self.voltage.size

    def at(self, column: int, time: Array) -> Array:
        """A state's value at any time [s], at its ends where the time is outside."""
        return np.asarray(np.interp(time * self.rate * FINE, np.arange(len(self.states)), self.states[:, column]))

    def trace(self) -> Trace:
        """On the clock of the controller."""
        return Trace.of(self.voltage, self.states[:-1:FINE])


@dataclass(frozen=True)
class Rig(Setup):
    """`supply`: plant parameters of one that sags; the drive then reports the voltage that it could apply."""

    supply: Values = field(default_factory=dict)

    def run(self, experiment: Experiment, plant: Values) -> Trace:
        trace = super().run(experiment, self._whole(experiment, plant))
        return replace(trace, voltage=self._reported(trace.voltage, trace.current))

    def play(self, experiment: Experiment, plant: Values, judge: Judge, off: int = 0) -> Truth:
        """The same on any judge, seen at the fine instants; the power stage is off for the first `off` ticks."""
        controller = self.controller(experiment)
        run = judge.start(
            self._whole(experiment, plant), rate=self.rate, voltage_scale=max(controller.ceiling, 1e-9)
        )
        states: list[State] = []
        commands = np.empty(experiment.samples)
        for tick in range(experiment.samples):
            now = run.state()
            commands[tick] = controller.command(tick, now[SPEED])
            if tick < off:
                states += [now] * FINE
                run.wait()
            else:
                states += run.step(commands[tick])
        seen = np.array([*states, run.state()])
        reported = self._reported(commands, seen[:-1:FINE, CURRENT])
        return Truth(rate=self.rate, voltage=reported, states=seen)

    def _whole(self, experiment: Experiment, plant: Values) -> Values:
        """With the supply, and a wandering torque that is another one in each recording."""
        seed = float(np.random.default_rng([*experiment.stream, 1]).integers(2**31))
        return plant | self.supply | ({"wander_seed": seed} if "wander_torque" in plant else {})

    def _reported(self, command: Array, current: Array) -> Array:
        """The command, as far as the supply can follow it."""
        if not self.supply:
            return command
        limit = np.maximum(self.supply["voltage_limit"] - self.supply["supply_resistance"] * np.abs(current), 0.0)
        return shaped(np.clip(command, -limit, limit))
