"""The state in which a run starts: at rest, or in a motion that its first samples show, known within a spread."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rwn.model.model import Model
from rwn.recording.quantisation import resolution
from rwn.recording.signals import MEASURED
from rwn.recording.speed_measurement import INSTANTANEOUS, SpeedMeasurement, integral

Array = NDArray[np.float64]
INITIAL_POSITION = "initial_position"
STATE = ("initial_current", "initial_speed", INITIAL_POSITION)  # the parameters of a start
_NONE: Mapping[str, NDArray[np.bool_]] = MappingProxyType({})

MOST_DEGREE = 4  # of the curve through the first samples of a position
FEWEST = 4  # samples that leave a curve something to miss
EVEN = 2.0 * np.pi / np.sqrt(12.0)  # standard deviation [rad] of an angle of which nothing is known
CERTAIN = 5.0  # deviations of a first sample from rest that chance does not explain: 1 in 10^6


@dataclass(frozen=True, kw_only=True)
class InitialState:
    """Current [A], speed [rad/s] and position [rad] at the first sample, and how far each may be off.

    `spread`: standard deviation of what is not known exactly, by the parameter of the start; absent: exact.
    """

    in_motion: bool = False
    start_samples: int = 0  # first samples that show the motion; 0: it was stated, or it starts at rest
    state: tuple[float, float, float] = (0.0, 0.0, 0.0)
    spread: Mapping[str, float] = field(default_factory=dict)


def initial_state_of(
    time: Array, signals: Mapping[str, Array], model: Model, *, missing: Mapping[str, NDArray[np.bool_]] = _NONE,
    way: SpeedMeasurement = INSTANTANEOUS,
) -> InitialState:  # fmt: skip
    """The start of a recording (n,) each, SI, by what the model's [recording] table says of it or its first samples.

    A position that was recorded starts within its noise or its steps of the first sample; of one that was not, nothing
    is known once the shaft turned before. `missing`: samples (n,) that were not measured; of a signal that begins with
    some, the first that was counts as the first, if it is among the samples that may tell the start. `way`: in which
    the speed was measured; a difference of positions is no speed at its first sample, but their slope there is.
    """
    first = model.recording.initial_samples
    signals = {n: x if n == "position" else _from_measured(x, missing.get(n), first) for n, x in signals.items()}
    signals = {n: x for n, x in signals.items() if x.size}
    position = signals.get("position", np.empty(0))
    known_to = _known_to(signals, first, missing)
    spread = {}
    place = 0.0
    if position.size:
        place = float(position[0])
        if known_to["position"] > 0.0:
            spread[INITIAL_POSITION] = known_to["position"]
    current, (speed, off) = _first_current(signals), _first_speed(time, signals, known_to, first, way)
    initial = model.recording.initial
    if initial == "rest" or (initial == "auto" and not is_moving(time, signals, first, way, missing)):
        return InitialState(state=(0.0, 0.0, place), spread=spread)
    known_within = abs(speed) if "speed" in signals else off
    spread["initial_speed"] = max(known_within, known_to.get("speed", 0.0), 1e-9)
    if "position" not in signals and not (model.linear or model.drive.coefficients):
        spread[INITIAL_POSITION] = EVEN
    if model.drive.winding:
        if "current" not in signals:
            current = _steady_current(signals, speed, model)
        spread["initial_current"] = max(abs(current), known_to.get("current", 0.0), 1e-9)
    return InitialState(
        in_motion=True,
        start_samples=first if initial == "auto" else 0,
        state=(current if model.drive.winding else 0.0, speed, place),
        spread=spread,
    )


def is_moving(
    time: Array, signals: Mapping[str, Array], first: int, way: SpeedMeasurement,
    missing: Mapping[str, NDArray[np.bool_]] = _NONE,
) -> bool:  # fmt: skip
    """Whether the shaft turns, or current flows, at the first sample of signals (n,) in SI: more than their noise."""
    known_to = _known_to(signals, first, missing)
    flowing = abs(_first_current(signals)) > CERTAIN * known_to.get("current", 0.0)
    speed, off = _first_speed(time, signals, known_to, first, way)
    turning = abs(speed) > CERTAIN * off and not _starts_from_rest(speed, time, signals, known_to, first, way)
    return turning or flowing


def _starts_from_rest(
    speed: float, time: Array, signals: Mapping[str, Array], known_to: Mapping[str, float], first: int,
    way: SpeedMeasurement,
) -> bool:  # fmt: skip
    """Whether the first positions show a start from rest, whatever the first `speed` is.

    They have to contradict a speed that was recorded, as where its noise lasts longer than its differences show. A
    speed that is their own slope has to bring a curve nearer to them than any from rest.
    """
    travelled = _travelled(time, signals, known_to, first, way)
    if travelled is None:
        return False
    position, noise = travelled
    since, recorded = time[: position.size] - time[0], _is_recorded(signals, first, time, way)
    rest = _misfit(since, position)
    moving = _misfit(since, position - speed * since, moving=not recorded)
    certainly = CERTAIN**2 * max(noise**2, min(rest, moving) / max(position.size - 3, 1))
    return moving - rest > certainly if recorded else rest - moving <= certainly


def _misfit(time: Array, position: Array, *, moving: bool = False) -> float:
    """Squares that the nearest curve leaves of positions (n,): at rest up to a sample, a power of the time from there.

    `moving`: on top of a motion of any speed. `time` (n,) begins with 0.
    """
    left = []
    for begin in time[: max(time.size - 2, 1)]:
        since = np.maximum((time - begin) / time[-1], 0.0)
        for degree in range(2, MOST_DEGREE + 1):
            powers = np.column_stack([np.ones(time.size), since**degree, *([time] if moving else [])])
            found = np.linalg.lstsq(powers, position, rcond=None)[0]
            left.append(float(np.sum((position - powers @ found) ** 2)))
    return min(left)


def _from_measured(signal: Array, missing: NDArray[np.bool_] | None, first: int) -> Array:
    """A signal (n,) from its first measured sample on, which stands for those before; empty where that is late."""
    if missing is None or not missing[0]:
        return signal
    begin = int(np.argmin(missing))
    return np.concatenate([np.full(begin, signal[begin]), signal[begin:]]) if 0 < begin < first else np.empty(0)


def _known_to(signals: Mapping[str, Array], first: int, missing: Mapping[str, NDArray[np.bool_]]) -> dict[str, float]:
    """Resolution of each measured signal; held or bridged values have no noise of their own."""
    measured = {n: signals[n][~missing[n]] if n in missing else signals[n] for n in MEASURED if n in signals}
    return {n: resolution(x, first) for n, x in measured.items()}


def _first_current(signals: Mapping[str, Array]) -> float:
    return float(signals["current"][0]) if "current" in signals else 0.0


def _is_recorded(signals: Mapping[str, Array], first: int, time: Array, way: SpeedMeasurement) -> bool:
    """Whether the first sample of a recorded speed is a speed there, not a difference over samples before."""
    return "speed" in signals and (not way.is_difference or min(first, time.size - 1) < 2)


def _first_speed(
    time: Array, signals: Mapping[str, Array], known_to: Mapping[str, float], first: int, way: SpeedMeasurement
) -> tuple[float, float]:
    """Speed at the first sample and its standard deviation; of a position alone, the slope of its first samples."""
    if _is_recorded(signals, first, time, way):
        return float(signals["speed"][0]), known_to["speed"]
    travelled = _travelled(time, signals, known_to, first, way)
    if travelled is None:
        return 0.0, np.inf
    position, noise = travelled
    return _first_slope(time[: position.size] - time[0], position, noise)


def _travelled(
    time: Array, signals: Mapping[str, Array], known_to: Mapping[str, float], first: int, way: SpeedMeasurement
) -> tuple[Array, float] | None:
    """The first samples of the position, or of the sum of a speed that is its difference, and their noise."""
    k = min(first, time.size - 1)
    if "position" in signals and k >= 2:
        return signals["position"][:k], known_to["position"]
    if "speed" not in signals or not way.is_difference or k < 2:
        return None
    step = float(np.median(np.diff(time[:k])))
    turned = integral(way, time[:k], signals["speed"][:k])
    return turned, known_to["speed"] * step * (way.before + way.after)


def _first_slope(time: Array, position: Array, noise: float) -> tuple[float, float]:
    """Slope at the first of some samples and its standard deviation: of all of them, or of the half that knows it best.

    An input that switches among them makes a curve through all of them say little of the first. What half as many say
    shows what a curve of a few degrees is off, as through a step response.
    """
    sizes = [size for size in (time.size, time.size // 2, time.size // 4) if size > FEWEST or size == time.size]
    slopes = [_slope_of(time[:size], position[:size], noise) for size in sizes]
    bent = [(slope, float(np.hypot(off, slope - half))) for (slope, off), (half, _) in pairwise(slopes)]
    return min(bent or slopes, key=lambda slope: slope[1])


def _slope_of(time: Array, position: Array, noise: float) -> tuple[float, float]:
    """The same of a parabola, or of a curve of the next degrees while that moves the slope by more than chance does."""
    best = (0.0, np.inf)
    for degree in range(min(2, time.size - 1), min(MOST_DEGREE, time.size - 2) + 1):
        design = np.vander(time, degree + 1)
        found = np.linalg.lstsq(design, position, rcond=None)[0]
        slope, left = float(found[-2]), position - design @ found
        off = max(noise, float(np.sqrt(left @ left / max(time.size - degree - 1, 1))))  # a curve that does not fit
        deviation = off * float(np.sqrt(np.linalg.inv(design.T @ design)[-2, -2]))
        moved = abs(slope - best[0])
        if np.isfinite(best[1]) and moved <= CERTAIN * deviation:
            break
        best = (slope, deviation if not np.isfinite(best[1]) else float(np.hypot(deviation, moved)))
    return best


def _steady_current(signals: Mapping[str, Array], speed: float, model: Model) -> float:
    """The current at which the winding is at rest with the speed."""
    return model.drive.resting_current(model.motor, speed, float(signals[model.drive.input][0]))
