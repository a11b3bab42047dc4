"""A run: one recording made ready for simulation, with what drives it, where it starts and what it is compared with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rwn.model.initial_state import INITIAL_POSITION, is_moving
from rwn.recording.clock import LOST_ROW
from rwn.recording.filters import before_filter
from rwn.recording.interpolated import InterpolatedRows
from rwn.recording.intersample import INTERSAMPLE, PiecewiseInput
from rwn.recording.noise import noise_from_differences
from rwn.recording.quantisation import quantum
from rwn.recording.signals import MEASURED
from rwn.recording.smoothing import LENGTHS, smooth, smoothing_length
from rwn.recording.speed_measurement import INSTANTANEOUS, SpeedMeasurement, integral
from rwn.simulate.own_unknowns import LevelPrior, LevelShare, StartUnknown

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
_NONE: Array = np.empty(0)
STANDS = 3.0  # deviations of the noise of a speed, within which a shaft may stand still


@dataclass(frozen=True, kw_only=True)
class Run:
    """One recording as the core takes it; signals that were not recorded are empty.

    Arrays are (n,), C-contiguous float64, SI. `start` holds the initial current, speed and position where known.
    """

    name: str
    time: Array
    input: Array
    current: Array = field(default_factory=lambda: _NONE)
    speed: Array = field(default_factory=lambda: _NONE)
    position: Array = field(default_factory=lambda: _NONE)
    speed_measured: SpeedMeasurement = INSTANTANEOUS
    missing: Mapping[str, Flags] = field(default_factory=dict)  # samples of a signal that were not measured
    start: tuple[float, float, float] = (0.0, 0.0, 0.0)
    start_spread: Mapping[str, float] = field(default_factory=dict)  # deviation of what is not known of it exactly
    in_motion: bool = False  # it does not start at rest
    start_samples: int = 0  # first samples that show the motion; 0: it was stated, or it starts at rest
    start_unknowns: tuple[StartUnknown, ...] = ()
    levels: tuple[LevelShare, ...] = ()
    own_levels: tuple[LevelPrior, ...] = ()  # of what is other than in the fitted runs: those that fit it best
    input_before: float = 0.0
    input_noise: float = 0.0  # deviation of the white noise that was taken off the input
    applied_input: PiecewiseInput | None = None  # the input as it acted; None: each row's own, from its time on
    ticks_per_row: int = 1  # of the clock that the drive's filters run by
    interpolated: InterpolatedRows | None = None  # its rows, where the signals are samples that these lay between
    angle: Array = field(default_factory=lambda: _NONE)  # recorded position that angle-dependent effects follow
    angle_from_speed: bool = False  # `angle` is the integral of the recorded speed, with what its sensor adds
    angle_from_start: bool = False  # `angle` is counted from the initial position
    follows: bool = True  # angle-dependent effects follow `angle`, else the simulated position
    restart_every: int = 0  # samples of a window after which the motion restarts from the recorded one; 0: free run
    restart_speed: Array = field(default_factory=lambda: _NONE)
    restart_position: Array = field(default_factory=lambda: _NONE)
    judged_from: int = 0  # first sample that is judged; those before may serve to estimate the initial state

    def signal(self, name: str) -> Array:
        """A recorded signal (n,) by name; empty where it was not recorded."""
        return {"current": self.current, "speed": self.speed, "position": self.position}[name]

    def measured(self, name: str) -> Array:
        """The measured samples of a recorded signal, (k,)."""
        return self.signal(name)[~self.missing[name]] if name in self.missing else self.signal(name)

    @cached_property
    def compared(self) -> Mapping[str, Array]:
        """The signals (n,), NaN where they are not compared."""
        signals = {}
        for name in MEASURED:
            signal = self.signal(name)
            if signal.size:
                signal = self.masked(name, signal)
            signals[name] = signal
        return signals

    def masked(self, name: str, values: Array) -> Array:
        """Values (n,) that belong to a signal's samples, NaN where these are not compared."""
        return np.where(self.not_compared(name), np.nan, values)

    def bridged(self, name: str) -> Array:
        """Values (n,) of a signal, on lines between the samples that were measured; as they are where none was."""
        lost, values = self.missing.get(name), self.signal(name)
        if lost is None or lost.all():
            return values
        return np.interp(self.time, self.time[~lost], values[~lost])

    def not_compared(self, name: str) -> Flags:
        """Samples (n,) that were not measured, or where a difference would reach outside the recording or a lost row.

        For the ends of a difference there are as many formulas as makers, and a drive's clock goes on where its logger
        loses a row.
        """
        n = self.time.size
        without = np.array(self.missing.get(name, np.zeros(n, dtype=bool)))
        if name == "speed":
            without[: self.speed_measured.before] = True
            without[n - self.speed_measured.after :] = True
            without |= self.across_lost_rows
        return without

    @cached_property
    def across_lost_rows(self) -> Flags:
        """Samples (n,) whose speed was taken between positions on both sides of a lost row."""
        across = np.zeros(self.time.size, dtype=bool)
        if self.speed_measured.shows_counts:
            before, after = self.speed_measured.before, self.speed_measured.after
            for k in np.flatnonzero(np.diff(self.time) > LOST_ROW * self.sample_time):
                across[max(k + 1 - after, 0) : k + 1 + before] = True
        return across

    def noise_left(self, signal: str) -> float:
        """The share of the noise of a signal that is left in its errors."""
        return self.applied_input.noise_left.get(signal, 1.0) if self.applied_input else 1.0

    def noise_in_differences(self, signal: str) -> float:
        """The noise of a signal over that which its second differences show if it is taken to be white.

        A speed that is a difference of counts shares the noise of a count with the sample before or behind it.
        """
        if signal != "speed" or not self.speed_measured.shows_counts:
            return 1.0
        taken = np.zeros(self.speed_measured.before + self.speed_measured.after + 1)
        taken[[0, -1]] = -1.0, 1.0
        second = np.array([1.0, -2.0, 1.0])
        of_counts = np.convolve(second, taken)
        return float(np.sqrt((taken @ taken) * (second @ second) / (of_counts @ of_counts)))

    @property
    def angle_unknown(self) -> bool:
        """Whether nothing tells the angle of the shaft at the first sample."""
        return INITIAL_POSITION in self.start_spread and not self.position.size

    @property
    def moves(self) -> bool:
        """Whether it shows that the shaft turned; where neither a speed nor a position was recorded that is assumed."""
        known = bool(self.speed.size or self.position.size)
        return not known or float(np.percentile(np.abs(self.motion[0]), 99.5)) > self._standing_speed

    @property
    def begins_turning(self) -> bool:
        """Whether its first speed is more than noise: a load that is held makes a current flow at standstill."""
        return self.in_motion and abs(self.start[1]) > self._standing_speed

    @property
    def turning(self) -> Flags:
        """The samples (n,) in which its smoothed speed is more than noise."""
        return np.asarray(np.abs(self.motion[0]) > self._standing_speed)

    @property
    def _standing_speed(self) -> float:
        return STANDS * noise_from_differences(self.speed) if self.speed.size else 0.0

    @property
    def can_restart(self) -> bool:
        """Whether its motion was recorded and it is not in windows already."""
        return bool(self.angle.size) and not self.restart_every

    @property
    def followed(self) -> Array:
        """The position (n,) that angle-dependent effects follow; empty: the simulated one."""
        return self.angle if self.follows else _NONE

    @property
    def recorded(self) -> tuple[str, ...]:
        """Names of the signals that were recorded."""
        return tuple(s for s in MEASURED if self.signal(s).size)

    @property
    def sample_time(self) -> float:
        """Median time from one sample to the next [s]."""
        return float(np.median(np.diff(self.time)))

    def until(self, end: int) -> Run:
        """Its first `end` samples."""
        arrays = ("time", "input", "current", "speed", "position", "angle", "restart_speed", "restart_position")
        cut = {name: getattr(self, name)[:end] for name in arrays}
        missing = {s: lost[:end] for s, lost in self.missing.items()}
        return replace(self, **cut, missing=missing, interpolated=None)

    def since(self, begin: int) -> Run:
        """Its samples from `begin`, from the smoothed motion that was recorded there."""
        arrays = ("input", "current", "speed", "position", "angle", "restart_speed", "restart_position")
        cut = {name: getattr(self, name)[begin:] for name in arrays}
        speed, position = float(self.motion[0][begin]), float(self.angle[begin]) if self.angle.size else 0.0
        first = float(self.time[begin])
        if self.angle_from_speed and self.angle.size:  # it is counted from the first sample
            cut["angle"] = cut["angle"] - position
        return replace(
            self, **cut, time=self.time[begin:] - first, start=(0.0, speed, position), start_spread={},
            start_unknowns=(), levels=(), in_motion=True, start_samples=0, input_before=float(self.input[begin - 1]),
            applied_input=self.applied_input and self.applied_input.since(first), interpolated=None,
            missing={s: lost[begin:] for s, lost in self.missing.items()},
        )  # fmt: skip

    def following_nothing(self) -> Run:
        """The run simulated from its input alone: angle-dependent effects follow the simulated position."""
        return replace(self, angle=np.empty(0))

    def with_intersample(self, law: str) -> Run:
        """The same with the input acting between the rows by a law of `rwn.recording.intersample`."""
        shown = self._as_rows()
        between = INTERSAMPLE[law]
        rows, applied = between.samples(shown.time), between.applied(shown.time, shown.input)
        run = replace(shown, applied_input=applied, ticks_per_row=between.ticks_per_row, interpolated=rows)
        if rows is None:
            return run
        found = {s: rows.samples(run.signal(s), run.missing.get(s)) for s in run.recorded}
        missing = {**run.missing, **{s: lost for s, (_, lost) in found.items()}}
        return replace(run._showing({s: values for s, (values, _) in found.items()}, rows.ticks), missing=missing)

    def _as_rows(self) -> Run:
        """The same with rows that were interpolated as they were recorded; what is missing among the samples is."""
        rows = self.interpolated
        if rows is None:
            return self
        shown = {s: rows.shown(self.signal(s)) for s in self.recorded}
        return replace(self._showing(shown, rows.rows), interpolated=None)

    def _showing(self, signals: Mapping[str, Array], time: Array) -> Run:
        """The same with other signals at other times, and the angle that effects follow by these."""
        current, speed, position = (signals.get(name, _NONE) for name in ("current", "speed", "position"))
        angle = self.angle
        if angle.size:
            angle = integral(self.speed_measured, time, speed) if self.angle_from_speed else position
        return replace(self, time=time, current=current, speed=speed, position=position, angle=angle)

    def unfiltered(self, signal: str, time_constant: float) -> Run:
        """The same with the speed or the current as it was before a first-order filter of its samples [s].

        What was taken for a start in motion may lie within the noise that the filter took off.
        """
        missing = dict(self.missing)
        values, lost = before_filter(
            self.time, self.signal(signal), time_constant,
            ticks_per_row=self.ticks_per_row, missing=missing.get(signal),
        )  # fmt: skip
        if signal in missing:
            missing[signal] = lost
        changed: dict[str, Any] = {signal: values}
        if signal == "speed" and self.angle_from_speed:
            changed["angle"] = integral(self.speed_measured, self.time, values)
        before = replace(self, missing=missing, **changed)
        signals = {s: before.measured(s) for s in before.recorded}
        if not self.start_samples or is_moving(self.time, signals, self.start_samples, self.speed_measured):
            return before
        return replace(before, in_motion=False, start_samples=0, start=(0.0, 0.0, self.start[2]), input_before=0.0)

    def quantisation(self, signal: str) -> float:
        """Standard deviation of the quantisation of a signal; 0 where its values are multiples of no step.

        q / sqrt(12) for steps of q, q / sqrt(6) where these are of a difference, which holds two roundings.
        """
        difference = signal == "speed" and self.speed_measured.is_difference
        return float(quantum(self.measured(signal)) / np.sqrt(6.0 if difference else 12.0))

    @cached_property
    def motion(self) -> tuple[Array, Array]:
        """Smoothed speed [rad/s or m/s] and acceleration [rad/s^2 or m/s^2], (n,) each; 0 where nothing tells them."""
        if not (self.position.size or self.speed.size):
            return np.zeros(self.time.size), np.zeros(self.time.size)
        step, length = self.sample_time, self.smoothing_length
        if self.position.size and not self.speed.size:
            speed = smooth(self.position, length, derivative=1, step=step)
            return speed, smooth(self.position, length, derivative=2, step=step)
        return smooth(self.speed, length), smooth(self.speed, length, derivative=1, step=step)

    @cached_property
    def smoothing_length(self) -> int:
        """Samples over which it is smoothed: what its speed allows; for the derivatives of a position the most."""
        return smoothing_length(self.speed, resolution=self.quantisation("speed")) if self.speed.size else LENGTHS[0]
