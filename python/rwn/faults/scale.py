"""Signals of a wrong unit, sign or gear ratio: their size against what the model as given simulates.

Nothing is refitted: a fit would bend the motor until it ran ten times too fast. All is judged from the energy of each
signal, of its simulation and of their product, so that a factor is tried without simulating anew.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from rwn.faults.back_emf import back_emf
from rwn.faults.fault import GEAR, SIGN, UNIT, Fault, without
from rwn.faults.similarity import FAR, Similarity
from rwn.fit.preparation import prepare
from rwn.model.model import Model
from rwn.recording.kinematics import Kinematics, kinematics_of
from rwn.recording.recording import Recording, beginnings
from rwn.recording.signals import MOTION
from rwn.recording.smoothing import smooth
from rwn.simulate.inverse_dynamics import needed_force
from rwn.simulate.run import Run

Array = NDArray[np.float64]

UNDOING_REMOVES = {UNIT: 0.85, SIGN: 0.85, GEAR: 0.95}  # share of the misfit; a gear bends nothing
LEFT = 0.3  # misfit that undoing may leave; 0.3 is a correlation of 0.85
SAME = 0.05  # relative difference between a size and a unit's factor that nothing has to account for
WIDEST = 0.3  # relative difference from a unit's factor that a poor data sheet and missing physics make
BEYOND_PHYSICS = 100.0  # factor that no physics comes near: a signal may be off by the root of it beside
GEARED = 2.0  # size from which a gear is believed: what slows a motor by so much does not leave its transients alike
MOST_GEARED = 1e4  # four stages of ten to one: small motors have no gear beyond
GEAR_LIKE = 1.5  # size from which a gear is tried beside physics
SURELY = 3.0  # standard deviations of the data sheet that a gear ratio has to be away from 1
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
LEAST_FORCE = 0.3  # correlation of a force with what the motion takes, below which nothing is said of its scale


def wrong_scale(recordings: Sequence[Recording], model: Model) -> Fault | None:
    """A unit, sign or gear ratio that is plainly wrong; None where the scale of every signal is believable."""
    recordings = beginnings(recordings)
    certain = _kinematic_fault(recordings, model)
    if certain:
        return certain
    if model.drive.force:
        return _axis_fault(recordings, model)
    seen = similarity(recordings, model)
    if not any(one.far for one in seen.values()):
        return None
    best, least = None, np.inf
    agreed, shown = _motions_agree(recordings), back_emf(recordings, model)
    for fault in _candidates(seen, model):
        if agreed and len(set(MOTION) & set(fault.signals)) == 1:  # speed and position say that each other is right
            continue
        denied = "speed" in fault.signals and shown.denies(fault.factor)
        if denied or not all(seen[s].bettered(fault.factor) for s in fault.signals if s in seen):
            continue
        undone = _misfits_without(fault, seen, recordings, model)
        judged = [s for s in seen if s in fault.signals] or list(seen)  # all signals depend on the voltage
        before = float(np.mean([seen[s].misfit(1.0) for s in judged]))
        left = float(np.mean([undone[s] for s in judged]))
        everywhere = float(np.mean(list(undone.values())))
        most = (1.0 - UNDOING_REMOVES[fault.name]) * before
        if left < (most if _beyond_physics(fault.factor) else min(most, LEFT)) and everywhere < least:
            best, least = fault, everywhere
    return best


def _motions(recordings: Sequence[Recording]) -> list[Kinematics]:
    """Speed against position, of the recordings that have both."""
    return [motion for recording in recordings if (motion := kinematics_of(recording))]


def _motions_agree(recordings: Sequence[Recording]) -> bool:
    """Whether the speed of some recording is the rate of its position, and of none of another scale."""
    motions = _motions(recordings)
    return any(motion.agree for motion in motions) and not any(motion.contradict for motion in motions)


def _kinematic_fault(recordings: Sequence[Recording], model: Model) -> Fault | None:
    """The speed or the position in a wrong unit or sign, where their kinematics say that one of them is.

    Which of the two it is, the model decides. None where no unit makes them agree: a gear between their sensors, say.
    """
    motions = _motions(recordings)
    if not motions or not all(motion.contradict for motion in motions):
        return None
    ratios = np.array([motion.ratio for motion in motions])
    faults = []
    for signal, power in (("speed", 1), ("position", -1)):
        tried = chain([_wrong_sign((signal,))], _in_units((signal,), _units((signal,), model)))
        faults += [one for one in tried if np.all(np.abs(ratios / one.factor**power - 1.0) < SAME)]
    return min(faults, key=lambda one: relative_error(without(recordings, one), model), default=None)


def gears(recordings: Sequence[Recording], model: Model) -> Iterator[Fault]:
    """Gear ratios too small to be plain, which physics might explain as well; of a motor alone."""
    if not model.drive.winding:
        return
    seen = similarity(recordings, model)
    moving = tuple(s for s in MOTION if s in seen)
    ratio = _mean([seen[s] for s in moving]).ratio if moving else 1.0
    if abs(np.log(ratio)) > np.log(GEAR_LIKE) and not back_emf(recordings, model).denies(ratio):
        yield from _gears(moving, ratio, model.drive.speed_spread(model.uncertainty))


def _misfits_without(
    fault: Fault, seen: Mapping[str, Similarity], recordings: Sequence[Recording], model: Model
) -> dict[str, float]:
    """Misfit of every signal without the fault."""
    if fault.signals == (model.drive.input,):
        return {s: one.misfit(1.0) for s, one in similarity(without(recordings, fault), model).items()}
    return {s: one.misfit(fault.factor if s in fault.signals else 1.0) for s, one in seen.items()}


def similarity(recordings: Sequence[Recording], model: Model) -> dict[str, Similarity]:
    """Of each recorded signal to its free run from the model as given; of a position by its slope, free of drift."""
    problem = prepare(recordings, model)
    given = problem.as_given()
    pairs = dict[str, list[tuple[Array, Array]]]()
    for run in problem.whole:
        simulated = problem.simulate(run.following_nothing(), given.vector, given.active).signals
        for s in run.recorded:
            alike = (_slope(run), simulated["speed"]) if s == "position" else (run.signal(s), simulated[s])
            pairs.setdefault(s, []).append(alike)
    return {s: Similarity.of(of, levelled=s in MOTION) for s, of in pairs.items()}


def _slope(run: Run) -> Array:
    return smooth(run.position, run.smoothing_length, derivative=1, step=run.sample_time)


def _candidates(seen: Mapping[str, Similarity], model: Model) -> Iterator[Fault]:
    """What may be wrong: each signal by itself, the motion as a whole, and the input, which all depend on."""
    moving = tuple(s for s in MOTION if s in seen)
    groups = dict.fromkeys([*((s,) for s in seen), moving])
    for group in sorted(groups):
        if any(seen[s].far for s in group):
            yield from _scales(group, _mean([seen[s] for s in group]), model, whole=group == moving)
    given = (model.drive.input,)
    yield _wrong_sign(given)
    yield from _in_units(given, THOUSANDS)


def _mean(of: Sequence[Similarity]) -> Similarity:
    """Geometric mean of the sizes."""
    sizes = np.log([(one.ratio, one.whole[0]) for one in of])
    ratio, whole = np.exp(np.mean(sizes, axis=0))
    alike, as_whole = np.mean([(one.correlation, one.whole[1]) for one in of], axis=0)
    return Similarity(float(ratio), float(alike), (float(whole), float(as_whole)))


def _scales(group: tuple[str, ...], seen: Similarity, model: Model, *, whole: bool) -> Iterator[Fault]:
    """Sign and units of a group of signals that its size allows, and a gear ratio where it is all of the motion."""
    yield _wrong_sign(group)
    units = {f: text for f, text in _units(group, model).items() if _is_allowed(f, group, seen, model)}
    if not whole:
        yield from _in_units(group, units)
        return
    geared = abs(np.log(seen.ratio)) > max(np.log(GEARED), SURELY * model.drive.speed_spread(model.uncertainty))
    for unit in _in_units(group, units):  # numbers too large by a unit are common, a sensor on a faster shaft is not
        as_well = geared and abs(unit.factor) < 1.0
        text = f"{unit.meaning}, or of a shaft that turns {seen.ratio:.3g} times as fast as the motor"
        yield replace(unit, also=(GEAR,), meaning=text) if as_well else unit
    if geared and not units:
        yield from _gears(group, seen.ratio, model.drive.speed_spread(model.uncertainty))


def _gears(group: tuple[str, ...], ratio: float, spread: float) -> Iterator[Fault]:
    yield gear(group, ratio, spread)
    yield gear(group, -ratio, spread)


def _wrong_sign(group: tuple[str, ...]) -> Fault:
    return Fault(name=SIGN, signals=group, factor=-1.0, meaning=f"{' and '.join(group)} of the wrong sign")


def _in_units(group: tuple[str, ...], units: Mapping[float, str]) -> Iterator[Fault]:
    """Each unit, with either sign."""
    label = " and ".join(group)
    for factor, text in units.items():
        yield Fault(name=UNIT, signals=group, factor=factor, meaning=f"{label} in {text}")
        yield Fault(
            name=UNIT, signals=group, factor=-factor, meaning=f"{label} in {text}, and of the wrong sign"
        )


def gear(group: tuple[str, ...], factor: float, spread: float) -> Fault:
    """A motion `factor` times that of the motor, which is known to `spread` (relative standard deviation)."""
    turned = ", and of the wrong sign" if factor < 0.0 else ""
    text = f"{' and '.join(group)} of a shaft that turns {abs(factor):.3g} times as fast as the motor{turned}"
    if abs(np.log(abs(factor))) > np.log(MOST_GEARED):
        text += ", which no gear does: its unit or scale is wrong, as of counts of an encoder"
    return Fault(name=GEAR, signals=group, factor=factor, spread=spread, meaning=text)


def as_gear(unit: Fault, model: Model) -> Fault:
    """The ratio of a gear in place of a suspected unit."""
    return gear(unit.signals, unit.factor, model.drive.speed_spread(model.uncertainty))


def _units(group: tuple[str, ...], model: Model) -> dict[float, str]:
    if group[0] in MOTION and not model.linear:
        return SPEED_UNITS if "speed" in group else ANGLE_UNITS
    return THOUSANDS


def _is_allowed(factor: float, group: tuple[str, ...], seen: Similarity, model: Model) -> bool:
    """Whether a signal has the size of a wrong unit of this factor, as far as data sheet and missing physics allow.

    Missing physics slows a motor: a motion recorded too large may be smaller than the factor says by more than larger.
    """
    off = float(np.log(seen.ratio / factor))
    if _beyond_physics(factor):
        return bool(abs(off) < np.log(BEYOND_PHYSICS) / 2.0)
    if group[0] in MOTION and factor > 1.0:
        return -WIDEST < off < max(SURELY * model.drive.speed_spread(model.uncertainty), SAME)
    return abs(off) < _tolerance(seen, model)


def _beyond_physics(factor: float) -> bool:
    return bool(abs(np.log(abs(factor))) > np.log(BEYOND_PHYSICS))


def _tolerance(seen: Similarity, model: Model) -> float:
    """How far off a unit's factor a signal may be, relative, for the data sheet's doubt and for missing physics."""
    missing = max(1.0 - seen.correlation**2, 0.0)
    return float(np.clip(2.0 * np.sqrt(model.drive.speed_spread(model.uncertainty) ** 2 + missing), SAME, WIDEST))


# ---- an axis, whose force is recorded --------------------------------------------------------------------------------


def _axis_fault(recordings: Sequence[Recording], model: Model) -> Fault | None:
    """A wrong scale of an axis, by its driving force against that which the motion takes; None: none is."""
    seen = _force_similarity(recordings, model)
    if abs(seen.correlation) < LEAST_FORCE or (seen.correlation > 0.0 and abs(np.log(seen.ratio)) < np.log(2.0 * FAR)):
        return None
    before = relative_error(recordings, model)
    moving = tuple(s for s in MOTION if any(s in r.signals for r in recordings))
    best, least = None, min((1.0 - UNDOING_REMOVES[UNIT]) * before, LEFT)
    for fault in chain(_any_scale((model.drive.input,), model), _any_scale(moving, model)):
        after = relative_error(without(recordings, fault), model)
        if after < least:
            best, least = fault, after
    return best


def _any_scale(group: tuple[str, ...], model: Model) -> Iterator[Fault]:
    yield _wrong_sign(group)
    yield from _in_units(group, _units(group, model))


def _force_similarity(recordings: Sequence[Recording], model: Model) -> Similarity:
    """Of the recorded driving force to the one that the model as given needs for the recorded motion."""
    problem = prepare(recordings, model)
    given, pairs = problem.as_given(), []
    for run in problem.whole:
        speed, acceleration = run.motion
        needed = needed_force(
            problem.simulator, given.vector, given.active, time=run.time, speed=speed, acceleration=acceleration,
            position=run.position if run.position.size else np.zeros(run.time.size),
        )  # fmt: skip
        pairs.append((run.input, needed))
    return Similarity.of(pairs)


def relative_error(recordings: Sequence[Recording], model: Model) -> float:
    """Squared error of the model as given over the energy of the signals, mean over the signals.

    It does not depend on units, so that recordings with and without a fault undone can be compared.
    """
    problem = prepare(recordings, model)
    given = problem.as_given()
    error: dict[str, float] = {}
    energy: dict[str, float] = {}
    residuals = problem.residuals(given.vector, given.active)
    for run, residual in zip(problem.runs, residuals, strict=True):
        for s, r in residual.items():
            error[s] = error.get(s, 0.0) + float(np.nansum(r**2))
            energy[s] = energy.get(s, 0.0) + float(np.sum(run.signal(s) ** 2))
    return float(np.mean([error[s] / max(energy[s], 1e-300) for s in error]))
