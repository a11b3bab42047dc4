"""What turns a run and a parameter vector into simulated signals: the equations of one kind of drive, in the core."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.model.initial_state import STATE
from rwn.model.model import Model
from rwn.model.vocabulary import motor_index
from rwn.recording.noise import WHITE, Noise
from rwn.recording.signals import MEASURED
from rwn.recording.speed_measurement import difference
from rwn.simulate.run import Run

Array = NDArray[np.float64]

RAN_AWAY = 1e100  # size of a signal, in SI, at which a simulation is cut, so that errors can be squared


@dataclass(frozen=True, kw_only=True)
class Output:
    """Simulated signals of one run in SI, (n,) each; derivatives (n, p) where they were asked for."""

    status: str
    signals: dict[str, Array]
    slopes: dict[str, Array]


@dataclass(frozen=True, kw_only=True)
class NormalEquations:
    """Weighted squared error of a simulation with its normal equations by p parameters."""

    chi2: float
    gradient: Array  # (p,) J'r
    curvature: Array  # (p, p) J'J
    count: int = 0  # samples that were compared
    finite: bool = True  # false: the simulation left the finite numbers


@dataclass(frozen=True, kw_only=True)
class Simulator:
    """The equations of a drive with the effects that it knows, and a meter of what its runs cost."""

    kind: str
    angle_per_position: float = 1.0
    order: int = 0  # of a transfer function
    own: tuple[_core.OwnEffect, ...] = ()  # a user's effects
    work: _core.Work = field(default_factory=_core.Work, compare=False)

    @classmethod
    def of(cls, model: Model, *, work: _core.Work | None = None) -> Simulator:
        """The simulator of a model. `work`: the meter, where several share one."""
        return cls(
            kind=model.kind,
            angle_per_position=2.0 * np.pi if model.linear else 1.0,
            order=model.order,
            own=tuple(effect.core for effect in model.own_effects),
            work=work or _core.Work(),
        )

    @staticmethod
    def started(run: Run, vector: Array) -> Array:
        """The parameter vector (all,) of one run: that of all runs, its start, and what is unknown of it alone."""
        own = _of_core(vector).copy()
        for place, parameter in run.start_unknowns:
            if place < vector.size:  # else it was fitted to recordings of which nothing was unknown
                own[parameter] += vector[place]
        for level in run.levels:
            if level.place < vector.size:
                own[list(level.parameters)] = level.of(own[list(level.parameters)], vector[level.place])
        for name, value in zip(STATE, run.start, strict=True):
            own[motor_index(name)] += value
        return own

    def task(self, run: Run) -> _core.Task:
        """A run under these equations, as the core takes it."""
        given = (run.input, ()) if run.applied_input is None else (run.applied_input.values, run.applied_input.instants)
        return self.given_input(
            run.time, given[0], input_time=given[1], input_before=run.input_before, angle=run.followed,
            angle_from_speed=run.angle_from_speed, angle_from_start=run.angle_from_start,
            restart_every=run.restart_every, restart_speed=run.restart_speed, restart_position=run.restart_position,
        )  # fmt: skip

    def given_input(self, time: Array, values: Array, **of_a_run: Any) -> _core.Task:
        """These equations over `time` (n,) under the `values` of an input; `of_a_run`: what else `_core.Task` takes."""
        return _core.Task(
            self.kind, time=time, input=values, angle_per_position=self.angle_per_position, order=self.order,
            own=list(self.own), **of_a_run,
        )  # fmt: skip

    def simulate(self, run: Run, vector: Array, active: Sequence[int], by: Sequence[int] = ()) -> Output:
        """Signals (n,) [SI] of a run under the effects `active`, and their derivatives by the parameters `by`.

        `vector` holds the start of the run (`started`); speed is as it was measured. Signals end at RAN_AWAY.
        """
        made = _core.simulate(self.task(run), _of_core(vector), list(active), list(by), self.work)
        signals, slopes = made.signals, made.slopes
        if run.speed_measured.is_difference:
            signals["speed"] = _as_difference(run, signals["position"], signals["speed"])
            # across a lost row too, where nothing is compared
            slopes["speed"] = difference(run.speed_measured, run.time, slopes["position"])
        within = {signal: np.clip(values, -RAN_AWAY, RAN_AWAY) for signal, values in signals.items()}
        return Output(status=made.status, signals=within, slopes=slopes)

    def normal_equations(
        self, run: Run, vector: Array, active: Sequence[int], by: Sequence[int], *, noise: Mapping[str, Noise],
    ) -> NormalEquations:  # fmt: skip
        """Squared error of a run under the `noise` of each signal with its normal equations (p, p), (p,).

        An error counts as what is new in it.
        """
        of_signal = [noise.get(s, WHITE) for s in MEASURED]
        seen = run.compared
        measurements = _core.Measurements(
            current=seen["current"], speed=seen["speed"], position=seen["position"],
            weights=tuple(1.0 / n.level for n in of_signal), reflection=tuple(list(n.reflection) for n in of_signal),
            speed_difference=(run.speed_measured.before, run.speed_measured.after),
        )  # fmt: skip
        sums = _core.normal_equations(
            self.task(run), measurements, _of_core(vector), list(active), list(by), self.work
        )
        return NormalEquations(
            chi2=sums.chi2, gradient=sums.gradient, curvature=sums.curvature, count=sums.count,
            finite=sums.status == "ok",
        )  # fmt: skip


def _as_difference(run: Run, position: Array, speed: Array) -> Array:
    """The simulated speed (n,) as a drive takes it of positions, whose clock goes on where its logger loses a row."""
    way, across = run.speed_measured, np.flatnonzero(run.across_lost_rows)
    taken = difference(way, run.time, position)
    if across.size and np.max(np.abs(speed)) < RAN_AWAY:
        from scipy.interpolate import CubicHermiteSpline  # heavy

        reach = np.arange(-way.before - 1, way.after + 2)
        near = np.unique(np.clip(np.add.outer(across, reach), 0, run.time.size - 1))
        at, step = CubicHermiteSpline(run.time[near], position[near], speed[near]), run.sample_time
        first, last = (run.time[across] + rows * step for rows in (-way.before, way.after))
        taken[across] = (at(last) - at(first)) / (last - first)
    return taken


def _of_core(vector: Array) -> Array:
    """The parameters that the core knows, of the vector of a fit."""
    return vector[: _core.parameter_count()]
