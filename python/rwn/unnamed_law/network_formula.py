"""Wavelet networks over one state of a drive as formulas of own effects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.fit.problem import Problem
from rwn.model import formula
from rwn.model.model import Model
from rwn.model.own_effects import OwnEffect, OwnParameter
from rwn.networks.wavelets import dyadic_places
from rwn.unnamed_law.places import FACTORS, Place, range_of, size_of, states_of, unit_of_state, unit_of_weights

Array = NDArray[np.float64]

PART = 7  # weights of one own effect, beside the scale of its state
NAME = "network-part"
FIRST = 0.01  # weights of a dry friction to begin with, of the largest torque: at no level it has no derivative


def parts_of(problem: Problem, model: Model, place: Place, count: int) -> list[OwnEffect]:
    """The network as own effects whose parameters are its weights."""
    size = size_of(problem, place)
    reach, start = 10.0 * size, FIRST * size if place.term == "friction" else 0.0
    waves, unit = _basis(problem, place, count), unit_of_weights(problem, place)
    parts = []
    for begin in range(0, count, PART):
        members = range(begin, min(begin + PART, count))
        weights = [
            OwnParameter(name=f"w{k}", unit=unit, lower=-reach, upper=reach, start=start, strength=True)
            for k in members
        ]
        text = _in_place(place, " + ".join(f"w{k} * {waves[k]}" for k in members))
        parts.append(
            OwnEffect(
                name=f"{NAME}-{begin // PART}", term=place.term, equation=text, drive=model.drive,
                parameters=(*weights, *_scale_of(problem, place)),
            )
        )  # fmt: skip
    return parts


def _in_place(place: Place, text: str) -> str:
    """What the network says as the formula of its term, which may be a factor or stand for what a sensor reads."""
    beside = "1 + " if place.term in FACTORS else f"{place.term} + " if place.of_a_sensor else ""
    return beside + (f"{place.factor} * ({text})" if place.factor else text)


@dataclass(frozen=True, kw_only=True)
class _Grid:
    """Where the wavelets stand along a state: centres and dilations of a dyadic grid over its range (2.10-2.11)."""

    low: float
    scale: float
    places: tuple[tuple[float, float], ...]


def _grid(states: Array, count: int) -> _Grid:
    low, high = range_of(states)
    return _Grid(low=low, scale=high - low, places=dyadic_places(count))


def basis_at(place: Place, states: Sequence[Array], count: int) -> list[Array]:
    """The wavelets or harmonics (n, count) at every sample of each run's state (n,), as the formulas have them."""
    if place.periods:
        return [np.stack([wave(order * x) for wave, order in _harmonics(place, count)], axis=1) for x in states]
    grid = _grid(np.concatenate(states), count)
    centres, dilations = np.array(grid.places).T
    scaled = [((x[:, None] - grid.low) / grid.scale - centres) / dilations for x in states]
    return [(1.0 - z**2) * np.exp(-0.5 * z**2) for z in scaled]


def _basis(problem: Problem, place: Place, count: int) -> list[str]:
    """The formulas of the single wavelets, or of the harmonics of an angle."""
    if place.periods:
        return [f"{wave.__name__}({order} * position)" for wave, order in _harmonics(place, count)]
    grid = _grid(states_of(problem, place), count)
    x, offset = f"{place.state} / {place.state}_scale", grid.low / grid.scale
    return [f"mexican_hat(({x} {_signed(-offset - m)}) / {d:.5g})" for m, d in grid.places]


def _harmonics(place: Place, count: int) -> list[tuple[np.ufunc, int]]:
    """A constant, then cosine and sine of each multiple of the angle."""
    orders = [place.periods * ((k + 1) // 2) for k in range(count)]
    return [(np.sin if k % 2 == 0 and k else np.cos, order) for k, order in enumerate(orders)]


def _scale_of(problem: Problem, place: Place) -> tuple[OwnParameter, ...]:
    """What makes the state dimensionless: a constant with its unit."""
    if place.periods:
        return ()
    scale = float(f"{_grid(states_of(problem, place), 1).scale:.5g}")
    unit = unit_of_state(problem, place)
    return (
        OwnParameter(name=f"{place.state}_scale", unit=unit, lower=scale, upper=scale, start=scale, meaning="range"),
    )


def nominal_share(problem: Problem, model: Model, place: Place, weights: Array) -> float:
    """What of the network the nominal term of the same state could do, per unit of the state; 0: that term is exact.

    `weights`: (wavelets,).
    """
    if model.uncertainty.get(place.parameter, 0.0) == 0.0:
        return 0.0
    states = states_of(problem, place)
    return float(_curve(problem, place, weights, states) @ states / max(float(states @ states), 1e-300))


def as_effect(problem: Problem, model: Model, place: Place, weights: Array, *, share: float) -> OwnEffect:
    """Amplitude times a sum of wavelets of `weights` (wavelets,), without `share` times the state."""
    states, scale = states_of(problem, place), _scale_of(problem, place)
    curve = _curve(problem, place, weights, states) - share * states
    size = max(float(np.sqrt(2.0 * np.mean(curve**2))), 1e-9 * size_of(problem, place))
    waves = _basis(problem, place, weights.size)
    text = " ".join(f"{_signed(w / size)} * {wave}" for w, wave in zip(weights, waves, strict=True))
    if share:
        text += f" {_signed(-share * scale[0].start / size)} * {place.state} / {scale[0].name}"
    amplitude = OwnParameter(
        name="amplitude", unit=unit_of_weights(problem, place), lower=0.0, upper=5.0 * size, start=size, strength=True,
        meaning="square root of twice its mean square",
    )  # fmt: skip
    return OwnEffect(
        name=_free_name(model, f"unexplained-{'voltage' if place.term == 'drop' else place.term}"), term=place.term,
        equation=_in_place(place, f"amplitude * ({text.removeprefix('+ ')})"), drive=model.drive,
        parameters=(amplitude, *scale),
        meaning=f"what has no name: {place.words}, drawn by {place.drawn_by}",
    )  # fmt: skip


def _curve(problem: Problem, place: Place, weights: Array, states: Array) -> Array:
    """The network at `states` (n,)."""
    values = {place.state: states, **{p.name: p.start for p in _scale_of(problem, place)}}
    names = dict.fromkeys(values, "1")
    waves = _basis(problem, place, weights.size)
    shapes = [formula.parse(wave, names, where="network").evaluate(values) for wave in waves]
    curve: Array = weights @ np.array(shapes)
    return curve


def _signed(number: float) -> str:
    return f"{'-' if number < 0.0 else '+'} {abs(number):.5g}"


def _free_name(model: Model, name: str) -> str:
    taken = {effect.name for effect in model.own_effects}
    return next(n for n in (name, *(f"{name}-{k}" for k in range(2, 9))) if n not in taken)
