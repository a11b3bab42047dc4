"""Wavelet networks over one state of a drive as formulas of own effects."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.fit.problem import Problem
from rwn.model import formula
from rwn.model.model import Model
from rwn.model.own_effects import VARIABLES, OwnEffect, OwnParameter
from rwn.networks.wavelets import dyadic_places
from rwn.simulate.unknown_inputs import unknown_inputs

Array = NDArray[np.float64]

PART = 7  # weights of one own effect, beside the scale of its state
NAME = "network-part"


@dataclass(frozen=True, kw_only=True)
class Place:
    """Where a network may stand: the term that it is, and the state that it depends on."""

    term: str  # "torque" or "drop"
    state: str
    periods: int = 0  # per revolution, of an angle
    nominal: str = ""  # parameter of the nominal term that is linear in the same state
    linear: bool = False  # on a linear axis

    @property
    def sign(self) -> float:
        """Of the nominal term: viscous friction brakes."""
        return -1.0 if self.nominal == "viscous_friction" else 1.0

    @property
    def words(self) -> str:
        """A clause: "a torque over speed"."""
        kind = "voltage" if self.term == "drop" else "force" if self.linear else "torque"
        return f"a {kind} over {'angle' if self.periods else self.state}"

    @property
    def unit(self) -> str:
        """SI unit of the term."""
        return "V" if self.term == "drop" else "N" if self.linear else "N m"


def places(problem: Problem, model: Model) -> tuple[Place, ...]:
    """Every place that the recorded signals say something of."""
    travel = max((float(np.ptp(r.angle)) for r in problem.whole if r.angle.size), default=0.0)
    turns = travel > 4.0 * np.pi and not model.linear
    varies = any(np.ptp(r.input) > 0.0 for r in problem.whole)
    mechanical = [Place(term="torque", state="speed", nominal="viscous_friction", linear=model.linear)]
    if travel > 0.0:
        mechanical.append(Place(term="torque", state="position", periods=int(turns), linear=model.linear))
    if not problem.drive.winding:
        return tuple(mechanical)
    return (
        *mechanical,
        Place(term="torque", state="current", nominal="torque_constant"),
        Place(term="drop", state="current", nominal="resistance"),
        *((Place(term="drop", state="input"),) if varies else ()),
    )


def parts_of(problem: Problem, model: Model, place: Place, count: int) -> list[OwnEffect]:
    """The network as own effects whose parameters are its weights."""
    reach = 10.0 * size_of(problem, place)
    waves = _wavelets(problem, place, count)
    parts = []
    for begin in range(0, count, PART):
        members = range(begin, min(begin + PART, count))
        weights = [
            OwnParameter(name=f"w{k}", unit=place.unit, lower=-reach, upper=reach, start=0.0, strength=True)
            for k in members
        ]
        text = " + ".join(f"w{k} * {waves[k]}" for k in members)
        parts.append(
            OwnEffect(
                name=f"{NAME}-{begin // PART}", term=place.term, equation=text, drive=model.drive,
                parameters=(*weights, *_scale_of(problem, place)),
            )
        )  # fmt: skip
    return parts


def size_of(problem: Problem, place: Place) -> float:
    """Largest torque or voltage of the drive."""
    return problem.scales["voltage" if place.term == "drop" else "torque"]


def states_of(problem: Problem, place: Place) -> Array:
    """The state (n,) along all recordings, one after the other."""
    recorded = {"input": "input", "position": "angle"}
    if place.state in recorded:
        return np.concatenate([getattr(r, recorded[place.state]) for r in problem.whole])
    vector = problem.as_given().vector
    unknown = [unknown_inputs(problem.drive, problem.simulator, r, vector) for r in problem.whole]
    return np.concatenate([getattr(u, place.state) for u in unknown])


@dataclass(frozen=True, kw_only=True)
class _Grid:
    """Where the wavelets stand along a state: centres and dilations of a dyadic grid over its range (2.10-2.11)."""

    low: float
    scale: float
    places: tuple[tuple[float, float], ...]


def _grid(states: Array, place: Place, count: int) -> _Grid:
    if place.periods:
        return _Grid(low=0.0, scale=1.0, places=dyadic_places(count))
    low, high = (float(x) for x in np.percentile(states, [0.05, 99.95]))
    return _Grid(low=low, scale=max(high - low, 1e-300), places=dyadic_places(count))


def _wavelets(problem: Problem, place: Place, count: int) -> list[str]:
    """The formulas of the single wavelets."""
    grid = _grid(states_of(problem, place), place, count)
    if place.periods:  # the hat is even, so that it comes back with every half period of the sine
        half = f"{place.periods / 2.0:g} * position"
        return [f"mexican_hat(sin({half} - {np.pi * m:.5g}) / {np.pi * d:.5g})" for m, d in grid.places]
    x, offset = f"{place.state} / {place.state}_scale", grid.low / grid.scale
    return [f"mexican_hat(({x} {_signed(-offset - m)}) / {d:.5g})" for m, d in grid.places]


def unit_of_state(place: Place) -> str:
    """SI unit of the state; only a voltage is fed in where the network is over the input."""
    return VARIABLES[place.state][place.linear] or "V"


def _scale_of(problem: Problem, place: Place) -> tuple[OwnParameter, ...]:
    """What makes the state dimensionless: a constant with its unit."""
    if place.periods:
        return ()
    scale = float(f"{_grid(states_of(problem, place), place, 1).scale:.5g}")
    unit = unit_of_state(place)
    return (
        OwnParameter(name=f"{place.state}_scale", unit=unit, lower=scale, upper=scale, start=scale, meaning="range"),
    )


def nominal_share(problem: Problem, model: Model, place: Place, weights: Array) -> float:
    """What of the network the nominal term of the same state could do, per unit of the state; 0: that term is exact.

    `weights`: (wavelets,).
    """
    if model.uncertainty.get(place.nominal, 0.0) == 0.0:
        return 0.0
    states = states_of(problem, place)
    return float(_curve(problem, place, weights, states) @ states / max(float(states @ states), 1e-300))


def as_effect(problem: Problem, model: Model, place: Place, weights: Array, *, share: float) -> OwnEffect:
    """Amplitude times a sum of wavelets of `weights` (wavelets,), without `share` times the state."""
    states, scale = states_of(problem, place), _scale_of(problem, place)
    curve = _curve(problem, place, weights, states) - share * states
    size = max(float(np.sqrt(2.0 * np.mean(curve**2))), 1e-9 * size_of(problem, place))
    waves = _wavelets(problem, place, weights.size)
    text = " ".join(f"{_signed(w / size)} * {wave}" for w, wave in zip(weights, waves, strict=True))
    if share:
        text += f" {_signed(-share * scale[0].start / size)} * {place.state} / {scale[0].name}"
    amplitude = OwnParameter(
        name="amplitude", unit=place.unit, lower=0.0, upper=5.0 * size, start=size, strength=True,
        meaning="square root of twice its mean square",
    )  # fmt: skip
    return OwnEffect(
        name=_free_name(model, f"unexplained-{'voltage' if place.term == 'drop' else 'torque'}"), term=place.term,
        equation=f"amplitude * ({text.removeprefix('+ ')})", drive=model.drive, parameters=(amplitude, *scale),
        meaning=f"what has no name: {place.words}, drawn by a wavelet network",
    )  # fmt: skip


def _curve(problem: Problem, place: Place, weights: Array, states: Array) -> Array:
    """The network at `states` (n,)."""
    values = {place.state: states, **{p.name: p.start for p in _scale_of(problem, place)}}
    names = dict.fromkeys(values, "1")
    waves = _wavelets(problem, place, weights.size)
    shapes = [formula.parse(wave, names, where="network").evaluate(values) for wave in waves]
    curve: Array = weights @ np.array(shapes)
    return curve


def _signed(number: float) -> str:
    return f"{'-' if number < 0.0 else '+'} {abs(number):.5g}"


def _free_name(model: Model, name: str) -> str:
    taken = {effect.name for effect in model.own_effects}
    return next(n for n in (name, *(f"{name}-{k}" for k in range(2, 9))) if n not in taken)
