"""The table of effects and the layout of the parameter vector, both read from the C++ core."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rwn import _core


@dataclass(frozen=True, kw_only=True)
class Scale:
    """A factor times powers of quantities that every drive has: torque^1 speed^-2 for a drag."""

    factor: float = 1.0
    powers: Mapping[str, int] = field(default_factory=dict)

    def of(self, quantities: Mapping[str, float]) -> float:
        """Its value (SI) where the quantities have these values."""
        return self.factor * math.prod(quantities[name] ** power for name, power in self.powers.items())

    @property
    def words(self) -> str:
        """ "torque / speed^2"; empty where it is a pure number."""
        above = [_power(name, power) for name, power in self.powers.items() if power > 0]
        below = [_power(name, -power) for name, power in self.powers.items() if power < 0]
        top = " ".join(above) or ("1" if below else "")
        return f"{top} / {' '.join(below)}" if below else top


def _power(name: str, power: int) -> str:
    return name if power == 1 else f"{name}^{power}"


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """One parameter: bounds, first guess and scan are in units of `scale` (see cpp/include/rwn/model/parameter.hpp)."""

    name: str
    unit: str
    meaning: str
    lower: float
    upper: float
    start: float
    scale: Scale
    scan: tuple[float, ...]
    strength: bool
    fixed: bool
    cyclic: bool
    order: bool
    idealised: bool
    natural: bool
    replaces: str | None
    beside: str | None = None
    line: int = 0  # of a periodic effect: lines above 0 act where their strength is not 0
    symbol: str = ""  # in the equation of its effect; formulas of own effects are written in the names

    @property
    def logarithmic(self) -> bool:
        """Whether it is fitted, and its interval even, by its logarithm: it is positive."""
        return self.lower > 0.0 and not self.cyclic


@dataclass(frozen=True, kw_only=True)
class Effect:
    """One physics that a nominal model may lack."""

    name: str
    site: str
    mismatch: str  # the equation that it belongs to: mechanical, electrical, actuator, sensor
    equation: str
    meaning: str
    source: str
    parameters: tuple[Parameter, ...]  # of a periodic effect: those of its first line
    index: int  # in the C++ table; a user's own effects count on behind it
    first: int  # position of its first parameter in the parameter vector
    turns: bool = False  # whether it depends on the angle
    one_sided: bool = False  # whether it tells a direction from the other, or an angle from its opposite
    steady: bool = False  # whether it is a torque that never changes, which a machine axis has more likely than not
    holds: bool = False  # whether nothing moves under it while the input is small
    rectifies: bool = False  # whether it is a sensor that shows the same of a speed and of its opposite
    jumps: bool = False  # whether a signal jumps from value to value under it, so that it has no slope to fit by
    filters: str = ""  # the signal of which it is the first-order filter
    shows_late: str = ""  # the signal that its sensor shows late; of a speed, the position too
    delays: bool = False  # whether the input acts later under it
    second_mass: bool = False  # whether it brings one; there is room for one
    guess: str = "scan"  # where first guesses come from, besides what its parameters scan (effect.hpp)
    special_case: str = ""  # the simpler effect that it is at one value of a parameter
    own: bool = False  # defined by the user
    further: tuple[Parameter, ...] = ()  # those of further lines of a periodic effect

    @property
    def every(self) -> tuple[Parameter, ...]:
        """All of its parameters, in the order of the parameter vector."""
        return (*self.parameters, *self.further)

    def acting(self, values: Mapping[str, float]) -> tuple[Parameter, ...]:
        """Its parameters, with those of the further lines that act with these values."""
        lines = {p.line for p in self.further if p.strength and values.get(p.name, 0.0) != 0.0}
        return (*self.parameters, *(p for p in self.further if p.line in lines))

    @property
    def slow(self) -> bool:
        """Whether it comes back with the angle after more than a revolution, as behind a gear."""
        return any(p.order and p.upper < 1.0 for p in self.parameters)

    @property
    def takes_time(self) -> bool:
        """Whether it is of a sensor that shows what was before: an offset or a rounding does not."""
        return self.site == "sensor" and any(p.unit == "s" for p in self.parameters)

    @property
    def retards(self) -> bool:
        """Whether it is a lag or a delay, of the input or of a sensor."""
        return self.delays or self.takes_time

    @property
    def at_an_end(self) -> bool:
        """Whether it belongs to what drives or what is read, not to the motor."""
        return self.site in ("actuator", "sensor")

    @property
    def instants(self) -> tuple[Parameter, ...]:
        """Begin and end of the time that it acts for, where it acts for a while."""
        return tuple(p for p in self.parameters if p.scale.powers == {"duration": 1}) if self.guess == "window" else ()

    def as_special_case(self, values: Mapping[str, float]) -> dict[str, float]:
        """Parameters (SI) of its special case, from its own; raises ValueError where it has none."""
        found = _core.special_case_parameters(self.name, [values[p.name] for p in self.parameters])
        return dict(zip((p.name for p in table()[self.special_case].parameters), found, strict=True))

    def at(self, parameter: str) -> int:
        """Position of one of its parameters in the parameter vector."""
        return self.first + [p.name for p in self.every].index(parameter)


def _parameter(row: Mapping[str, Any]) -> Parameter:
    factor, powers = row["scale"]
    return Parameter(**{**row, "scan": tuple(row["scan"]), "scale": Scale(factor=factor, powers=powers)})


@cache
def motor_parameters() -> Mapping[str, Parameter]:
    """The motor's own parameters by name, in the order of the parameter vector."""
    return {row["name"]: _parameter(row) for row in _core.motor_parameter_table()}


@cache
def table() -> Mapping[str, Effect]:
    """Every effect that comes with rwn by name, in the order of the C++ table; a model may know more."""
    effects: dict[str, Effect] = {}
    first = len(motor_parameters())
    for index, row in enumerate(_core.effect_table()):
        every = tuple(_parameter(p) for p in row["parameters"])
        lines = {"parameters": tuple(p for p in every if not p.line), "further": tuple(p for p in every if p.line)}
        effects[row["name"]] = Effect(**{**row, **lines}, index=index, first=first)
        first += len(every)
    return effects


def analog_filters(known: Mapping[str, Effect]) -> dict[str, Effect]:
    """Signal -> the effect that is its first-order filter, of those in a table."""
    return {effect.filters: effect for effect in known.values() if effect.filters}


def motor_index(name: str) -> int:
    """Position of a motor parameter, or of a coefficient of a transfer function, in the parameter vector."""
    return _positions()[name]


def motor_values(vector: NDArray[np.float64]) -> dict[str, float]:
    """The motor's own parameters by name, of a parameter vector (all,)."""
    return {name: vector[k] for k, name in enumerate(motor_parameters())}


def state_indices(order: int) -> list[int]:
    """Positions of the initial state x1, x2, .. of a transfer function in the parameter vector."""
    return [_positions()[f"x{i + 1}"] for i in range(order)]


@cache
def _positions() -> Mapping[str, int]:
    first, most = _core.first_coefficient(), _core.max_order
    positions = {name: k for k, name in enumerate(motor_parameters())}
    for block, letter in enumerate("ba"):
        positions |= {f"{letter}{k}": first + block * most + k for k in range(most)}
    return positions | {f"x{i + 1}": first + 2 * most + i for i in range(most)}


def parameter_vector(
    motor: Mapping[str, float],
    effects: Mapping[str, Mapping[str, float]],
    known: Mapping[str, Effect] | None = None,
) -> NDArray[np.float64]:
    """All parameters (SI) of motor and effects in one vector (all,), as the core takes them; not given: zero.

    `known`: the effects by name (default: those that come with rwn).

    Parameters of effects that are `fixed` by nature and not given take their stated value.
    """
    vector = np.zeros(_core.parameter_count())
    for name, value in motor.items():
        vector[motor_index(name)] = value
    for name, values in effects.items():
        effect = (known or table())[name]
        for k, parameter in enumerate(effect.every):
            default = parameter.start if parameter.fixed else 0.0
            vector[effect.first + k] = values.get(parameter.name, default)
    return vector
