"""Recordings made ready for fitting: the free-run output error of a drive and its normal equations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.fit.levenberg_marquardt import Normal
from rwn.parallel import side_by_side
from rwn.recording.speed_measurement import SpeedMeasurement, difference

Array = NDArray[np.float64]
SIGNALS = ("current", "speed", "position")
_NONE: Array = np.empty(0)


@dataclass(frozen=True, kw_only=True)
class Target:
    """One recording as the core takes it; signals that were not recorded are empty.

    Arrays are (n,), C-contiguous float64, SI. `start` holds the initial current, speed and position where they are
    known; an unknown that fits them has its own place in the parameter vector.
    """

    name: str
    time: Array
    input: Array
    current: Array = field(default_factory=lambda: _NONE)
    speed: Array = field(default_factory=lambda: _NONE)
    position: Array = field(default_factory=lambda: _NONE)
    speed_measured: SpeedMeasurement = SpeedMeasurement.INSTANTANEOUS
    known_from: Mapping[str, int] = field(default_factory=dict)  # first measured sample, of signals that begin late
    start: tuple[float, float, float] = (0.0, 0.0, 0.0)
    input_before: float = 0.0
    angle: Array = field(
        default_factory=lambda: _NONE
    )  # recorded position that angle-dependent effects follow
    angle_from_speed: bool = False  # `angle` is the integral of the recorded speed, with what its sensor adds
    follows: bool = True  # angle-dependent effects follow `angle`, else the simulated position
    restart_every: int = (
        0  # samples of a window after which the motion restarts from the recorded one; 0: free run
    )
    restart_speed: Array = field(default_factory=lambda: _NONE)
    restart_position: Array = field(default_factory=lambda: _NONE)
    judged_from: int = 0  # first sample that is judged; those before may serve to estimate the initial state

    def signal(self, name: str) -> Array:
        """A recorded signal by name; empty where it was not recorded."""
        return {"current": self.current, "speed": self.speed, "position": self.position}[name]

    def measured(self, name: str) -> Array:
        """A recorded signal from its first measured sample on."""
        return self.signal(name)[self.known_from.get(name, 0) :]

    @cached_property
    def compared(self) -> Mapping[str, Array]:
        """The signals, NaN where they are not compared."""
        signals = {}
        for name in SIGNALS:
            signal = self.signal(name)
            if signal.size and (outside := self.outside(name)):
                signal = signal.copy()
                signal[outside] = np.nan
            signals[name] = signal
        return signals

    def outside(self, name: str) -> list[int]:
        """Indices of samples that were not measured, or where a difference would reach outside the recording.

        For the ends of a difference there are as many formulas as makers.
        """
        before, after = self.speed_measured.reach if name == "speed" else (0, 0)
        first = self.known_from.get(name, 0) + before
        return [*range(first), *([-1] if after else [])]

    @property
    def followed(self) -> Array:
        """The position that angle-dependent effects follow; empty: the simulated one."""
        return self.angle if self.follows else _NONE

    def until(self, end: int) -> Target:
        """Its first `end` samples."""
        arrays = ("time", "input", "current", "speed", "position", "angle", "restart_speed", "restart_position")
        return replace(self, **{name: getattr(self, name)[:end] for name in arrays})

    @property
    def recorded(self) -> tuple[str, ...]:
        """Names of the signals that were recorded."""
        return tuple(s for s in SIGNALS if self.signal(s).size)


@dataclass(frozen=True, kw_only=True)
class Output:
    """Simulated signals of one target, (n,) each; derivatives (n, p) where they were asked for."""

    status: str
    signals: dict[str, Array]
    slopes: dict[str, Array]


@dataclass(frozen=True, kw_only=True)
class CountedNormal(Normal):
    """Normal equations and how many samples stand behind them."""

    count: int


@dataclass(frozen=True, kw_only=True)
class OutputError:
    """The error of free-run simulation over several recordings, weighted by the noise of each signal."""

    kind: str
    targets: tuple[Target, ...]
    noise: dict[str, float]  # standard deviation per recorded signal
    angle_per_position: float = 1.0
    start_indices: tuple[int, int, int] = (
        0,
        0,
        0,
    )  # of initial current, speed, position in the parameter vector
    order: int = 0  # of a transfer function
    own: tuple[_core.OwnEffect, ...] = ()  # a user's effects
    persistence: Mapping[str, float] = field(
        default_factory=dict
    )  # correlation of a signal's error with the one before; `noise` is then that of what is new in each
    work: _core.Work = field(default_factory=_core.Work, compare=False)  # what all simulations have cost
    colour: float = 1.0  # variance times correlation time of what the best fit leaves: so many samples count as one

    def metered(self) -> OutputError:
        """The same problem with a meter of its own."""
        return replace(self, work=_core.Work())

    @property
    def samples(self) -> int:
        """Of all recorded signals."""
        return sum(t.signal(s).size for t in self.targets for s in t.recorded)

    def parameters_for(self, target: Target, vector: Array, active: Sequence[int]) -> Array:  # noqa: ARG002
        """The parameter vector with the start of this recording filled in."""
        own = vector.copy()
        for index, value in zip(self.start_indices, target.start, strict=True):
            own[index] += value
        return own

    def simulate(
        self, target: Target, vector: Array, active: Sequence[int], by: Sequence[int] = ()
    ) -> Output:
        """Free run of one recording; speed as it was measured."""
        status, *arrays = _core.simulate(
            self.kind, target.time, target.input, self.parameters_for(target, vector, active), list(active), list(by),
            self.angle_per_position, target.input_before, target.followed, target.angle_from_speed,
            target.restart_every, target.restart_speed, target.restart_position, self.order, self.own, self.work,
        )  # fmt: skip
        signals = dict(zip(SIGNALS, arrays[:3], strict=True))
        slopes = dict(zip(SIGNALS, arrays[3:], strict=True))
        if target.speed_measured.is_difference:
            signals["speed"] = difference(target.speed_measured, target.time, signals["position"])
            slopes["speed"] = difference(target.speed_measured, target.time, slopes["position"])
        return Output(status=status, signals=signals, slopes=slopes)

    def residuals(self, vector: Array, active: Sequence[int]) -> list[dict[str, Array]]:
        """Measured minus simulated per recording and signal, unweighted; 0 where they are not compared."""

        def one(target: Target) -> dict[str, Array]:
            out = self.simulate(target, vector, active).signals
            left = {s: target.signal(s) - out[s] for s in target.recorded}
            for signal in left:
                left[signal][target.outside(signal)] = 0.0
            return left

        return side_by_side(one, self.targets)

    def error(self, vector: Array, active: Sequence[int]) -> float:
        """Weighted squared error; infinite where a run diverged."""
        return self.normal(vector, active, ()).chi2

    def normal(self, vector: Array, active: Sequence[int], by: Sequence[int]) -> CountedNormal:
        """Normal equations by the parameters `by`, summed over the recordings."""
        chi2, count, gradient, curvature = 0.0, 0, np.zeros(len(by)), np.zeros((len(by), len(by)))
        for one in side_by_side(lambda t: self.normal_of(t, vector, active, by), self.targets):
            if not one.finite or not np.isfinite(one.curvature).all():
                return CountedNormal(
                    chi2=np.inf, gradient=gradient, curvature=curvature, finite=False, count=max(count, 1)
                )
            chi2, count = chi2 + one.chi2, count + one.count
            gradient, curvature = gradient + one.gradient, curvature + one.curvature
        return CountedNormal(chi2=chi2, gradient=gradient, curvature=curvature, count=count)

    def normal_of(
        self, target: Target, vector: Array, active: Sequence[int], by: Sequence[int]
    ) -> CountedNormal:
        """Normal equations of one recording."""
        return self.normal_at(target, self.parameters_for(target, vector, active), active, by)

    def normal_at(
        self, target: Target, vector: Array, active: Sequence[int], by: Sequence[int]
    ) -> CountedNormal:
        """Normal equations of one recording whose start is part of `vector`."""
        seen = target.compared
        status, chi2, count, gradient, curvature = _core.normal_equations(
            self.kind, target.time, target.input, vector, list(active), list(by), seen["current"], seen["speed"],
            seen["position"], [1.0 / self.noise.get(s, 1.0) for s in SIGNALS],
            target.speed_measured, self.angle_per_position, target.input_before, target.followed,
            target.angle_from_speed, target.restart_every, target.restart_speed, target.restart_position,
            self.order, self.own, [self.persistence.get(s, 0.0) for s in SIGNALS],
            self.work,
        )  # fmt: skip
        return CountedNormal(
            chi2=chi2, gradient=gradient, curvature=curvature, count=count, finite=status == "ok"
        )
