"""Mistakes in the recordings themselves, the commonest mismatch of all: unit, sign, gear ratio, channels out of step.

They are looked for before any physics. A unit or a sign is judged by the model as given, since a refit would absorb it;
a gear ratio or a shift, which physics might explain too, by the refitted model and in units of the measurement noise.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from rwn.candidate import candidate
from rwn.diagnosis import Estimate, FoundEffect
from rwn.model import Model
from rwn.output_error import OutputError
from rwn.prepare import Setup, motion, noise_levels, prepare
from rwn.recording import Recording
from rwn.search import Search

Array = NDArray[np.float64]

GROSS = 0.04  # squared error of the model as given, of the signals' own, below which no scale is doubted
REMOVED = 0.85  # share of the removable squared error that undoing a mistake has to remove
FAR = 1.4  # gain of a signal against its simulation from which its scale is doubted
GEAR = "wrong-gear-ratio"
SPEED_UNITS = {
    60.0 / (2.0 * np.pi): "rpm taken for rad/s",
    2.0 * np.pi / 60.0: "rad/s taken for rpm",
    180.0 / np.pi: "degrees per second taken for rad/s",
    np.pi / 180.0: "rad/s taken for degrees per second",
    1.0 / (2.0 * np.pi): "revolutions per second taken for rad/s",
    2.0 * np.pi: "rad/s taken for revolutions per second",
}
ANGLE_UNITS = {
    180.0 / np.pi: "degrees taken for rad",
    np.pi / 180.0: "rad taken for degrees",
    1.0 / (2.0 * np.pi): "revolutions taken for rad",
    2.0 * np.pi: "rad taken for revolutions",
}
THOUSANDS = {1e3: "thousandths of the unit (milli) taken for the unit", 1e-3: "the unit taken for thousandths (milli)"}
SAME = 0.15  # relative difference between a gain and a unit's factor that the data sheet may account for
AT_THE_NOISE = 1.1  # squared error in units of the noise, below which nothing is suspected
DECISIVE = 50.0  # cost by which a gear ratio or a shift has to be better than the best physics
LONGEST_SHIFT = 40  # samples


@dataclass(frozen=True, kw_only=True)
class Mistake:
    """recorded(t) = factor * true(t - delay) for each of `signals`."""

    name: str  # "wrong-unit" | "wrong-sign" | "wrong-gear-ratio" | "time-shift"
    signals: tuple[str, ...]
    meaning: str
    factor: float = 1.0
    delay: int = 0  # samples by which the signals come late
    step: float = 0.0  # sample time [s]

    def undo(self, recording: Recording) -> Recording:
        """The recording as it should have been; where a signal came late, all are cut to what is left."""
        n = len(recording) - max(self.delay, 0)
        signals = {name: np.array(values[:n]) for name, values in recording.signals.items()}
        for name in self.signals:
            if name in signals:
                signals[name] = _moved(np.array(recording.signals[name]), self.delay)[:n] / self.factor
        return replace(recording, time=recording.time[:n], signals=signals)

    def found(self, probability: float) -> FoundEffect:
        """How a diagnosis reports it."""
        parameters = {}
        if self.factor not in (1.0, -1.0):
            parameters["factor"] = Estimate(value=self.factor, unit="1")
        if self.delay:
            parameters["shift"] = Estimate(value=self.delay * self.step, unit="s")
        return FoundEffect(
            name=self.name, equation="recording", probability=probability, parameters=parameters, meaning=self.meaning
        )  # fmt: skip


def _moved(values: Array, delay: int) -> Array:
    if delay < 0:  # it came early: what was before the first sample is at rest
        return np.concatenate([np.full(-delay, values[0]), values[:delay]])
    return values[delay:]


def gross(recordings: Sequence[Recording], model: Model) -> Mistake | None:
    """A unit or sign that is plainly wrong; None where the scale of every signal is believable."""
    doubted = [m for m in _doubted(recordings, model) if m.name != GEAR]
    before = relative_error(recordings, model) if doubted else 0.0
    if before < GROSS:
        return None
    after = [relative_error([m.undo(r) for r in recordings], model) for m in doubted]
    best = int(np.argmin(after))
    return doubted[best] if after[best] < min((1.0 - REMOVED) * before, 0.3) else None


def suspected(recordings: Sequence[Recording], model: Model) -> Mistake | None:
    """A shift or a gear ratio that explains most of what the refitted model leaves; physics may yet do better."""
    if model.kind == "lti":
        return None
    setup = prepare(recordings, model)
    fitted = Search.of(setup).fit_nominal()
    residuals = setup.problem.residuals(fitted.vector, fitted.candidate.active)
    noise = noise_levels(setup.problem.targets, residuals)
    problem = replace(setup.problem, noise=noise)
    missing = problem.error(fitted.vector, fitted.candidate.active)
    if missing < AT_THE_NOISE * sum(r.size for each in residuals for r in each.values()):
        return None
    return fine(recordings, model, noise=noise, rival=np.inf)


def fine(recordings: Sequence[Recording], model: Model, *, noise: Mapping[str, float], rival: float) -> Mistake | None:
    """A channel out of step or a gear ratio, if it explains the recordings better than the best physics does.

    `rival` is the cost of that: squared error in units of the `noise` of each signal, and departure from the data
    sheet, which is what a gear ratio looks like (a back-EMF constant wrong by 20 standard deviations).
    """
    before = _cost(prepare(recordings, model), noise)
    doubted = [m for m in _doubted(recordings, model) if m.name == GEAR]
    best, least = None, rival - DECISIVE
    for mistake in chain(doubted, _out_of_step(recordings, model)):
        setup = prepare([mistake.undo(r) for r in recordings], model)
        after = _cost(setup, _undone(noise, mistake))
        count = sum(int(np.isfinite(t.signal(s)).sum()) for t in setup.problem.targets for s in t.recorded)
        if after < least and after - count < (1.0 - REMOVED) * (before - count):
            best, least = mistake, after
    return best


def _undone(noise: Mapping[str, float], mistake: Mistake) -> dict[str, float]:
    """Noise levels of the signals with the mistake undone."""
    return {s: level / (abs(mistake.factor) if s in mistake.signals else 1.0) for s, level in noise.items()}


def relative_error(recordings: Sequence[Recording], model: Model) -> float:
    """Squared error of the model as given over the energy of the signals, mean over the signals.

    It does not depend on units, so that recordings with and without a mistake undone can be compared. Nothing is
    refitted: a fit would bend the motor until it runs ten times too fast.
    """
    setup = prepare(recordings, model)
    start = candidate(setup.nominal, (), setup.scales)
    error: dict[str, float] = {}
    energy: dict[str, float] = {}
    residuals = setup.problem.residuals(start.vector, start.active)
    for target, residual in zip(setup.problem.targets, residuals, strict=True):
        for s, r in residual.items():
            error[s] = error.get(s, 0.0) + float(np.nansum(r**2))
            energy[s] = energy.get(s, 0.0) + float(np.sum(target.signal(s) ** 2))
    return float(np.mean([error[s] / max(energy[s], 1e-300) for s in error]))


def _cost(setup: Setup, noise: Mapping[str, float]) -> float:
    """Squared error of the refitted nominal model in units of the noise, and its departure from the data sheet."""
    problem = replace(setup.problem, noise=dict(noise))
    return Search.of(setup, problem=problem).fit_nominal().cost


def _levels(setup: Setup) -> dict[str, float]:
    start = candidate(setup.nominal, (), setup.scales)
    return noise_levels(setup.problem.targets, setup.problem.residuals(start.vector, start.active))


# ---- scale and sign --------------------------------------------------------------------------------------------------


def _doubted(recordings: Sequence[Recording], model: Model) -> Iterator[Mistake]:
    """Mistakes worth a refit, from the gain of each signal against what the model as given simulates."""
    if model.kind == "axis":
        yield from _doubted_axis(recordings, model)
        return
    gains = _gains(prepare(recordings, model))
    far = {s: g for s, g in gains.items() if g < 0.0 or abs(np.log(max(abs(g), 1e-12))) > np.log(FAR)}
    if not far:
        return
    motion_signals = tuple(s for s in ("speed", "position") if s in recordings[0].signals)
    groups = {("speed",), ("position",), ("current",), ("voltage",), motion_signals}
    for group in sorted(groups):
        if set(group) & set(recordings[0].signals) and (set(group) & set(far) or group == ("voltage",)):
            yield from _scales(group, [abs(far[s]) for s in group if s in far], model)


def _gains(setup: Setup) -> dict[str, float]:
    """Of each recorded signal against its free run from the model as given."""
    start = candidate(setup.nominal, (), setup.scales)
    products: dict[str, list[float]] = {}
    for target in setup.whole.targets:
        free = replace(target, angle=np.empty(0))
        simulated = setup.whole.simulate(free, start.vector, start.active).signals
        for s in target.recorded:
            pair = products.setdefault(s, [0.0, 0.0, 0.0])
            pair[0] += float(np.nansum(target.signal(s) * simulated[s]))
            pair[1] += float(np.nansum(simulated[s] ** 2))
            pair[2] += float(np.nansum(target.signal(s) ** 2))
    return {
        s: np.sign(xy) * np.sqrt(yy / max(xx, 1e-300)) if abs(xy) > 0.5 * np.sqrt(xx * yy) else 1.0
        for s, (xy, xx, yy) in products.items()
    }  # fmt: skip


def _doubted_axis(recordings: Sequence[Recording], model: Model) -> Iterator[Mistake]:
    """The same from the driving force against what the motion takes."""
    setup = prepare(recordings, model)
    start = candidate(setup.nominal, (), setup.scales)
    gain = _force_gain(setup.whole, start.vector)
    if gain > 0.0 and abs(np.log(gain)) < np.log(2.0 * FAR):
        return
    given = "force" if "force" in recordings[0].signals else "torque"
    moving = tuple(s for s in ("speed", "position") if s in recordings[0].signals)
    yield from _scales((given,), [], model)
    yield from _scales(moving, [], model)


def _force_gain(problem: OutputError, vector: Array) -> float:
    from rwn.effects import motor_index  # late: not needed for motors

    xy = xx = yy = 0.0
    for target in problem.targets:
        speed, acceleration = motion(target)
        takes = vector[motor_index("inertia")] * acceleration + vector[motor_index("viscous_friction")] * speed
        xy += float(takes @ target.input)
        xx += float(takes @ takes)
        yy += float(target.input @ target.input)
    return float(np.sign(xy) * np.sqrt(yy / max(xx, 1e-300))) if abs(xy) > 0.3 * np.sqrt(xx * yy) else 1.0


def _scales(group: tuple[str, ...], gains: Sequence[float], model: Model) -> Iterator[Mistake]:
    """Sign and units of a group of signals, each with either sign, and any gear ratio that `gains` point at."""
    label = " and ".join(group)
    signs: tuple[tuple[float, str], ...] = ((1.0, ""), (-1.0, ", and of the wrong sign"))
    yield Mistake(name="wrong-sign", signals=group, factor=-1.0, meaning=f"{label} of the wrong sign")
    units = _units(group, model)
    for (factor, text), (sign, more) in chain.from_iterable([(u, s) for s in signs] for u in units.items()):
        if gains and min(abs(np.log(gain / factor)) for gain in gains) > SAME:
            continue
        yield Mistake(name="wrong-unit", signals=group, factor=sign * factor, meaning=f"{label} in {text}{more}")
    if group[0] not in ("speed", "position"):
        return
    for gain in gains:
        if abs(np.log(gain)) > np.log(1.5) and all(abs(np.log(gain / f)) > SAME for f in units):
            for sign, more in signs:
                yield Mistake(
                    name=GEAR, signals=group, factor=sign * float(gain),
                    meaning=f"{label} of a shaft that turns {gain:.4g} times as fast as the motor{more}",
                )  # fmt: skip


def _units(group: tuple[str, ...], model: Model) -> dict[float, str]:
    if group[0] in ("speed", "position") and not model.linear:
        return SPEED_UNITS if "speed" in group else ANGLE_UNITS
    return THOUSANDS


# ---- channels out of step --------------------------------------------------------------------------------------------


def _out_of_step(recordings: Sequence[Recording], model: Model) -> Iterator[Mistake]:
    """Shifts worth a refit: one channel late or early against its simulation while another is in step."""
    if model.kind != "dc":
        return
    setup = prepare(recordings, model)
    problem = replace(setup.problem, noise=_levels(setup))
    fitted = Search.of(setup, problem=problem).fit_nominal()
    lags = {}
    for signal in setup.whole.targets[0].recorded:
        if signal != "position":
            lags[signal] = _lag(problem, fitted.vector, fitted.candidate.active, signal)
    step = float(np.median(np.diff(recordings[0].time)))
    groups = {"speed": tuple(s for s in ("speed", "position") if s in recordings[0].signals), "current": ("current",)}
    for signal, lag in lags.items():
        alone = "current" not in lags
        if alone and lag > 0:
            continue  # late against the input alone: as well a delay of the drive, which is physics
        for delay in {lag - 1, lag, lag + 1, *(lag - other for other in lags.values())}:
            if delay != 0 and abs(delay) <= LONGEST_SHIFT and not (alone and delay > 0):
                late = "late" if delay > 0 else "early"
                yield Mistake(
                    name="time-shift", signals=groups[signal], delay=delay, step=step,
                    meaning=f"{signal} comes {abs(delay)} samples {late} against the other channels",
                )  # fmt: skip


def _lag(problem: OutputError, vector: Array, active: Sequence[int], signal: str) -> int:
    """Samples by which a recorded signal follows its simulation, from the correlation of their changes."""
    shifts = np.arange(-LONGEST_SHIFT, LONGEST_SHIFT + 1)
    score = np.zeros(shifts.size)
    for target in problem.targets:
        simulated = np.diff(problem.simulate(target, vector, active).signals[signal])
        recorded = np.diff(target.signal(signal))
        inner = slice(LONGEST_SHIFT, simulated.size - LONGEST_SHIFT)
        for k, shift in enumerate(shifts):
            score[k] += float(np.roll(recorded, -shift)[inner] @ simulated[inner])
    return int(shifts[np.argmax(score)])
