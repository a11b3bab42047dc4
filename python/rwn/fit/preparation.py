"""From recordings and a model file to what the fits work on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.fit.hypothesis import Nominal, candidate, fit
from rwn.fit.problem import OutputError, Target
from rwn.fit.quantisation import quantisation
from rwn.fit.scales import scales
from rwn.fit.transfer_function import TransferError
from rwn.fit.transfer_start import first_guesses
from rwn.model.model import Model
from rwn.model.vocabulary import motor_index, motor_parameters
from rwn.recording.lattice import lattice
from rwn.recording.recording import Recording
from rwn.recording.smoothing import LENGTHS, smooth, smoothing_length
from rwn.recording.speed_measurement import SpeedMeasurement, integral, speed_measurement

Array = NDArray[np.float64]
CLOCK = 1e-5  # relative accuracy of a sample clock (a good crystal), and so of what was travelled by it
WINDOW = (
    50  # samples of a window of a drive that integrates: short enough that drift does not drown the forces
)


@dataclass(frozen=True, kw_only=True)
class Setup:
    """A model and recordings, made ready."""

    nominal: Nominal
    whole: OutputError  # free run over each recording
    problem: OutputError  # what is fitted: the same, or windows of it
    scales: Mapping[str, float]


def prepare(recordings: Sequence[Recording], model: Model, *, work: _core.Work | None = None) -> Setup:
    """Targets, weights and scales; the noise levels are first guesses from the recordings alone.

    `work`: meter of what simulations cost, of a diagnosis that prepares several times.
    """
    targets = tuple(target(r, model) for r in recordings)
    nominal = nominal_of(model)
    whole = _whole(targets, model, work or _core.Work())
    if model.kind == "lti" and not model.parameters:
        nominal = _started(whole, nominal, first_guesses(targets, model.order))
    count = max((lattice(t.measured("position")) for t in targets), default=0.0)
    if count > 0.0 and model.recording.initial == "rest":
        # a counter that was zeroed anywhere within a count: else the free run is off by up to one count for ever
        nominal = replace(nominal, free={"initial_position": 0.0}, reach={"initial_position": 1.5 * count})
    vector = candidate(nominal, (), {}).vector
    outputs = [_with_motion(t, whole.simulate(t, vector, []).signals) for t in targets]
    problem = whole
    if model.kind == "axis" and model.recording.initial == "estimate":
        problem = replace(whole, targets=tuple(windowed(t) if t.position.size else t for t in targets))
    return Setup(
        nominal=nominal, whole=whole, problem=problem, scales=scales(model.kind, vector, targets, outputs)
    )


def _whole(targets: tuple[Target, ...], model: Model, work: _core.Work) -> OutputError:
    noise = noise_levels(targets, [{s: t.signal(s) for s in t.recorded} for t in targets])
    if model.kind == "lti":
        at_rest = model.recording.initial == "rest"
        return TransferError(kind="lti", targets=targets, noise=noise, order=model.order, at_rest=at_rest, work=work)
    return OutputError(
        kind=model.kind,
        targets=targets,
        noise=noise,
        angle_per_position=2.0 * np.pi if model.linear else 1.0,
        work=work,
        own=tuple(effect.core for effect in model.own_effects),
        start_indices=(
            motor_index("initial_current"),
            motor_index("initial_speed"),
            motor_index("initial_position"),
        ),
    )


def _started(problem: OutputError, nominal: Nominal, guesses: Sequence[Mapping[str, float]]) -> Nominal:
    """`nominal` with unknown coefficients at the guess from which a fit gets furthest."""
    legs = [candidate(replace(nominal, free=guess), (), {}) for guess in guesses]
    costs = [fit(problem, leg, max_iterations=25).cost for leg in legs]
    first, *others = (guesses[k] for k in np.argsort(costs, kind="stable"))
    return replace(nominal, free=first, starts=tuple(others))


def nominal_of(model: Model) -> Nominal:
    """The model's values as the fit takes them."""
    known = motor_parameters()
    motor = {name: value for name, value in model.parameters.items() if name in known or model.kind == "lti"}
    for load in model.load.values():
        motor["pendulum_torque"] = load["mass"] * 9.80665 * load["length"]
    return Nominal(
        motor=motor, uncertainty=dict(model.uncertainty), effects=dict(model.effects), free={}, table=model.effect_table
    )


def target(recording: Recording, model: Model) -> Target:
    """One recording as the core takes it; samples are at the rows' times, the input is held from its row on."""
    signals = {name: np.array(values) for name, values in recording.signals.items()}
    given = signals[model.drive.input]
    time = recording.time - recording.time[0]
    empty = np.empty(0)
    speed, position = signals.get("speed", empty), signals.get("position", empty)
    rest = model.recording.initial == "rest"
    known = max(recording.known_from.values(), default=0)
    way = SpeedMeasurement.INSTANTANEOUS
    if model.kind != "lti":
        way = speed_measurement(time[known:], speed[known:], position[known:])
    start_speed = 0.0 if rest else _start_speed(time, speed, position)
    return Target(
        name=recording.name,
        time=np.ascontiguousarray(time),
        input=np.ascontiguousarray(given),
        current=signals.get("current", empty) if model.kind == "dc" else empty,
        speed=speed,
        position=position,
        speed_measured=way,
        known_from=recording.known_from,
        start=(0.0, start_speed, float(position[0]) if position.size else 0.0),
        input_before=0.0 if rest else float(given[0]),
        angle=position if position.size else integral(way, time, speed),
        angle_from_speed=position.size == 0,
    )


def proof_target(recording: Recording, model: Model) -> Target:
    """As `target`, for a recording that is not fitted: a state to be estimated comes from its first samples alone."""
    estimated = model.kind == "lti" and model.recording.initial == "estimate"
    return replace(target(recording, model), judged_from=model.recording.initial_samples if estimated else 0)


def windowed(whole: Target, length: int = WINDOW) -> Target:
    """The same recording in windows of `length` samples, each starting from the smoothed recorded motion."""
    speed, position = motion(whole)[0], whole.angle
    return replace(
        whole,
        restart_every=length,
        restart_speed=np.ascontiguousarray(speed),
        restart_position=np.ascontiguousarray(position),
        start=(0.0, float(speed[0]), float(position[0])),
    )


def motion(target: Target) -> tuple[Array, Array]:
    """Smoothed speed and acceleration (n,) of a recording."""
    step, length = float(np.median(np.diff(target.time))), smoothing_over(target)
    if target.position.size and not target.speed.size:
        speed = smooth(target.position, length, derivative=1, step=step)
        return speed, smooth(target.position, length, derivative=2, step=step)
    return smooth(target.speed, length), smooth(target.speed, length, derivative=1, step=step)


def smoothing_over(target: Target) -> int:
    """Samples over which a recording is smoothed: what its speed allows; for the derivatives of a position the most."""
    if not target.speed.size:
        return LENGTHS[0]
    return smoothing_length(target.speed, resolution=quantisation(target, "speed"))


def noise_levels(targets: Sequence[Target], residuals: Sequence[Mapping[str, Array]]) -> dict[str, float]:
    """Standard deviation of the measurement noise per signal.

    Encoder counts, and a speed that is their difference: of their quantisation. Else what is left of second
    differences, robustly: a model error is smooth against the sample time, so it falls out, and a few sharp instants
    do not count (median). No position is better known than the clock that its travel was timed with.
    """
    levels = {}
    for signal in residuals[0]:
        steps = float(np.median([quantisation(t, signal) for t in targets]))
        found = [_noise(r[signal]) for r in residuals if r[signal].size > 8]
        rough = max(float(np.median(found)) if found else 1.0, 1e-12)
        encoder = signal == "position" or (signal == "speed" and any(t.speed_measured.is_difference for t in targets))
        levels[signal] = steps if steps and encoder else max(steps, rough)
    if "position" in levels:
        levels["position"] = max(levels["position"], CLOCK * max(float(np.ptp(t.position)) for t in targets))
    return levels


def _noise(residual: Array) -> float:
    change = np.diff(residual[np.isfinite(residual)], 2)
    spread = 1.4826 * float(np.median(np.abs(change - np.median(change)))) / np.sqrt(6.0)
    rms = float(np.sqrt(np.nanmean(residual**2)))
    return min(spread, rms) if spread > 0.0 else rms


def _start_speed(time: Array, speed: Array, position: Array) -> float:
    if speed.size:
        return float(np.mean(speed[:5]))
    k = min(20, time.size - 1)
    return float(np.polyfit(time[:k], position[:k], min(2, k - 1))[-2]) if position.size else 0.0


def _with_motion(target: Target, simulated: Mapping[str, Array]) -> dict[str, Array]:
    """Simulated signals, with the recorded motion where it is recorded."""
    own = dict(simulated)
    if target.position.size and not target.speed.size:
        own["speed"] = motion(target)[0]
    return own
