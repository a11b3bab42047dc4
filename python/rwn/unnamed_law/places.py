"""Where a wavelet network may stand in the equations of a drive, and the state that it is over.

Over the angle of a shaft that goes round it is a sum of harmonics.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.model.own_effects import TERMS, VARIABLES

Array = NDArray[np.float64]

TURN = "turn"  # the position within a revolution, of a shaft that goes round
LARGEST = 99.0  # percentile of a signal's size that counts as its largest
FACTORS = frozenset({"flux"})  # terms that are 1 where nothing is missing
# What a term times a factor is.
WORDS = {
    ("torque", ""): "torque", ("torque", "speed"): "viscous friction", ("torque", "current"): "torque constant",
    ("torque", "input"): "gain of the drive", ("friction", ""): "dry friction", ("flux", ""): "flux",
    ("drop", ""): "voltage lost", ("drop", "speed"): "back-EMF constant", ("drop", "current"): "resistance",
    ("drop", "input"): "gain of the amplifier", ("speed", ""): "error of the speed sensor",
    ("speed", "speed"): "gain of the speed sensor", ("current", ""): "error of the current sensor",
    ("current", "current"): "gain of the current sensor",
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Place:
    """Where a network may stand: the term that it is, the state that it is over and what it is multiplied with."""

    term: str  # a key of TERMS
    state: str  # a key of VARIABLES
    factor: str = ""  # another; a torque times the speed is a friction coefficient that is no constant
    periods: int = 0  # per revolution, of a position
    parameter: str = ""  # of the nominal model: that of the nominal term that is linear in the same state
    linear: bool = False  # on a linear axis

    @property
    def sign(self) -> float:
        """Of the nominal term: viscous friction brakes."""
        return -1.0 if self.parameter == "viscous_friction" else 1.0

    @property
    def kind(self) -> str:
        """What depends on the state: "torque", "dry friction"."""
        kind = WORDS[self.term, self.factor]
        return "force" if self.linear and kind == "torque" else kind

    @property
    def drawn(self) -> Place:
        """What is drawn over the state: a coefficient times the state that it is over is the term itself."""
        return replace(self, factor="") if self.factor == self.state else self

    @property
    def words(self) -> str:
        """A clause: "a torque over speed", which a friction coefficient over speed comes to as well."""
        kind = self.drawn.kind
        article = "an" if kind[0] in "aeiou" else "a"
        return f"{article} {kind} over {'angle' if self.periods else self.state}"

    @property
    def drawn_by(self) -> str:
        """What the curve is a sum of."""
        return "harmonics of the angle" if self.periods else "a wavelet network"

    @property
    def of_a_sensor(self) -> bool:
        """Whether it is no part of the drive but of what records it."""
        return self.term in VARIABLES

    @property
    def unit(self) -> str:
        """SI unit of the term."""
        return TERMS[self.term][1 + self.linear]


def places(problem: Problem, model: Model) -> tuple[Place, ...]:
    """Where a correction may stand: in the equations of the drive, over what it will meet again."""
    return tuple(p for p in all_places(problem, model) if p.state != "time" and not p.of_a_sensor)


def all_places(problem: Problem, model: Model) -> tuple[Place, ...]:
    """Every term over every state: forces, voltages, coefficients that are no constants, errors of a sensor.

    These are far more laws than have a name, and hold most of those that have none. A dry friction over speed is not
    among them: it is a torque over speed.
    """
    states = _states(problem, model)
    recorded = {s for r in problem.whole for s in r.recorded}
    winding = problem.drive.winding
    drive = "current" if winding else "input"
    terms = {"torque": ("", "speed", drive), "friction": ("",)}
    terms |= {"drop": ("", "speed", "current", "input"), "flux": ("",)} if winding else {}
    terms |= {sensor: ("", sensor) for sensor in ("speed", "current") if sensor in recorded}
    return tuple(
        _place(term, state, factor, model)
        for term, factors in terms.items()
        for factor in factors
        for state in states
        if factor in ("", *states) and not (term == "friction" and state in ("speed", "input"))
    )


def _states(problem: Problem, model: Model) -> tuple[str, ...]:
    """What changes along the recordings."""
    known = ("speed", "time", "position", *(("current",) if problem.drive.winding else ()), "input")
    travel = max((float(np.ptp(r.angle)) for r in problem.whole if r.angle.size), default=0.0)
    turns = (TURN,) if travel > 4.0 * np.pi and not model.linear else ()
    return (*(state for state in known if np.ptp(range_of(_along(problem, state))) > 0.0), *turns)


def _place(term: str, state: str, factor: str, model: Model) -> Place:
    """`state`: a key of VARIABLES, or TURN."""
    state, periods = ("position", 1) if state == TURN else (state, 0)
    parameter = "" if factor else _linear_terms(model).get((term, state), "")
    return Place(term=term, state=state, factor=factor, periods=periods, parameter=parameter, linear=model.linear)


def _linear_terms(model: Model) -> dict[tuple[str, str], str]:
    """Term and state -> the nominal parameter between them; of two that are one number, the first alone may move."""
    moved_by_another = {pair.like for pair in model.drive.one_numbers}
    return {place: name for name, place in model.drive.terms.items() if name not in moved_by_another}


def size_of(problem: Problem, place: Place) -> float:
    """Largest value that what the network is of can take, in the unit of its weights."""
    if place.term in FACTORS or (place.of_a_sensor and place.factor):
        return 1.0
    if place.of_a_sensor:
        return largest(problem, place.term)
    whole = problem.scales["voltage" if place.term == "drop" else "torque"]
    return whole / largest(problem, place.factor) if place.factor else whole


def largest(problem: Problem, state: str) -> float:
    """Of a state along all recordings, positive."""
    return float(np.percentile(np.abs(_along(problem, state)), LARGEST)) or 1.0


def states_of(problem: Problem, place: Place) -> Array:
    """The state (n,) along all recordings, one after the other."""
    return _along(problem, place.state)


def range_of(states: Array) -> tuple[float, float]:
    """Where the wavelets stand: between the percentiles of a state that leave its outliers out; (0, 0) of nothing."""
    low, high = np.percentile(states, [0.05, 99.95]) if states.size else (0.0, 0.0)
    return float(low), float(high)


def _along(problem: Problem, state: str) -> Array:
    recorded = {"input": "input", "position": "angle", "time": "time"}
    if state in recorded:
        return np.concatenate([getattr(r, recorded[state]) for r in problem.whole])
    return np.concatenate([getattr(motion, state) for motion in problem.recorded_motion])


def unit_of_state(problem: Problem, place: Place) -> str:
    """SI unit of the state."""
    return _unit(problem, place.state, linear=place.linear)


def unit_of_weights(problem: Problem, place: Place) -> str:
    """SI unit of a weight: that of the term, or of the term over that of the factor."""
    return f"{place.unit}/({_unit(problem, place.factor, linear=place.linear)})" if place.factor else place.unit


def _unit(problem: Problem, state: str, *, linear: bool) -> str:
    if state == "input":
        return problem.drive.input_unit
    return VARIABLES[state][linear]
