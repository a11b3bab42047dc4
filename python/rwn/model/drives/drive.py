"""What a kind of drive is: its signals, its nominal parameters, and where effects can attach to it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.errors import InputError, unrecognised
from rwn.recording.signals import SIGNALS
from rwn.recording.units import linear_unit

if TYPE_CHECKING:
    from rwn.model.vocabulary import Effect

Numbers = TypeVar("Numbers", float, NDArray[np.float64])

USUAL_VOLTAGE = 24.0


@dataclass(frozen=True, kw_only=True)
class NominalParameter:
    """A parameter of the nominal model. `positive`: zero is refused too; `signed`: may be negative.

    `linear_unit`: on a linear axis.
    """

    name: str
    unit: str
    meaning: str
    linear_unit: str = ""
    positive: bool = False
    required: bool = True
    signed: bool = False


@dataclass(frozen=True, kw_only=True)
class OneNumber:
    """Two nominal parameters that are one number of a machine, but for losses that the equations do not hold."""

    name: str
    like: str  # the other one
    spread: float  # relative standard deviation of their ratio
    data_sheet_unit: str  # that data sheets have `like` in


@dataclass(frozen=True, kw_only=True)
class Drive:
    """A kind of drive. The stages ask it what it is, never what it is called."""

    kind: str
    input: str
    outputs: tuple[str, ...]
    parameters: tuple[NominalParameter, ...]
    # parameter -> the term of the equations that it stands in, and what it is multiplied with there
    terms: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    one_numbers: tuple[OneNumber, ...] = ()
    winding: bool = False  # a voltage drives the current of a winding
    force: bool = False  # what drives the mechanics is recorded itself
    coefficients: bool = False  # a transfer function, whose parameters are no physics
    linear: bool = False  # moves along a line: units of forces and metres
    shaft: bool = True  # turns, so that a pendulum may hang on it
    on_a_line: Drive | None = None  # the same moving along a line, where there is such
    mechanics: Drive | None = None  # what its shaft is by itself, driven by the torque of a recorded current

    @property
    def sites(self) -> frozenset[str]:
        """Where effects can attach to it."""
        return frozenset(_core.drive_sites(self.kind))

    def nominal_parameters(self, order: int) -> tuple[NominalParameter, ...]:  # noqa: ARG002
        """The nominal parameters that a model of this kind can have; `order`: of a transfer function."""
        return self.parameters

    @property
    def friction(self) -> tuple[str, ...]:
        """Its parameters that are friction, which changes with grease, warmth and load from one run to the next."""
        return tuple(p.name for p in self.parameters if p.name in FRICTION)

    @property
    def input_unit(self) -> str:
        """The SI unit of the input."""
        signal = SIGNALS[self.input]
        return signal.linear_unit if self.linear else signal.unit

    def unit_of(self, effect: Effect, unit: str) -> str:
        """The SI unit of a parameter of an effect on this drive, where the table has `unit`."""
        if effect.own:  # a user has written units as they are
            return unit
        here = linear_unit(unit) if self.linear else unit
        return here.replace("V", self.input_unit) if effect.site == "actuator" else here

    def driving_torque(self, motor: Mapping[str, float], current: Numbers, given: Numbers) -> Numbers:  # noqa: ARG002
        """What drives the mechanics [N m] at a current [A] and an input; numbers or (n,) each.

        `motor`: values of its parameters, here and below.
        """
        return given

    def torque_spread(self, uncertainty: Mapping[str, float]) -> float:  # noqa: ARG002
        """Relative standard deviation of the driving torque at a known current; `uncertainty`: as of a model."""
        return 0.0

    def resting_current(self, motor: Mapping[str, float], speed: Numbers, given: Numbers) -> Numbers:
        """The current [A] at which a winding is at rest with a speed [rad/s] under an input; numbers or (n,) each.

        Raises NotImplementedError where there is no winding.
        """
        raise NotImplementedError(f"a {self.kind} has no winding")

    def resting_voltage(self, motor: Mapping[str, float], current: Numbers) -> Numbers:
        """The voltage [V] that a current [A] takes that does not change; numbers or (n,).

        Raises NotImplementedError where there is no winding.
        """
        raise NotImplementedError(f"a {self.kind} has no winding")

    def back_emf(self, motor: Mapping[str, float], speed: Numbers) -> Numbers:
        """The voltage [V] that a speed [rad/s] induces; numbers or (n,).

        Raises NotImplementedError where there is no winding.
        """
        raise NotImplementedError(f"a {self.kind} has no winding")

    def halves(self, motor: Mapping[str, float]) -> str:  # noqa: ARG002
        """How to see which half of it is at fault, where what joins them was recorded; empty where it is one."""
        return ""

    def usual_input(self, motor: Mapping[str, float]) -> float:
        """An input such as a drive of this size is run with, to a factor of some hundred: 10 m/s^2, 1000 rad/s^2."""
        return motor["inertia"] * (10.0 if self.linear else 1000.0)

    def heat(self, motor: Mapping[str, float], square: float) -> float:  # noqa: ARG002
        """Power [W] lost to heat at a mean square of the current [A^2]."""
        return 0.0

    def speed_damping(self, motor: Mapping[str, float]) -> float:  # noqa: ARG002
        """Torque [N m] per speed [rad/s] by which what drives it brakes, beside the friction."""
        return 0.0

    def speed_spread(self, uncertainty: Mapping[str, float]) -> float:  # noqa: ARG002
        """Relative standard deviation of the speed at an input that those of the parameters leave."""
        return 0.0

    def as_simulated(self, motor: Mapping[str, float]) -> dict[str, float]:
        """The values of its parameters that the core can divide by."""
        return dict(motor)

    def read(self, motor: Mapping[str, Any], *, where: str) -> tuple[dict[str, Any], int]:
        """What [motor] gives, as parameter -> value with or without a unit, and the order. Raises InputError."""
        if "order" in motor:
            raise unrecognised("key", "order", [p.name for p in self.parameters], where=where)
        return dict(motor), 0

    def lines(self, parameters: Mapping[str, float], order: int) -> list[str] | None:  # noqa: ARG002
        """How [motor] is written; None: a line for every parameter."""
        return None


_TABLE = {row["name"]: row for row in _core.motor_parameter_table()}


def nominal_parameter(
    name: str, *, linear_unit: str = "", positive: bool = False, required: bool = True
) -> NominalParameter:
    """A parameter of the motor, with unit and meaning as the core states them (motor.hpp)."""
    row = _TABLE[name]
    return NominalParameter(
        name=name, unit=row["unit"], meaning=row["meaning"], linear_unit=linear_unit, positive=positive,
        required=required,
    )  # fmt: skip


FRICTION = ("viscous_friction", "coulomb_friction")
MECHANICS = (
    nominal_parameter("inertia", linear_unit="kg", positive=True),
    nominal_parameter("viscous_friction", linear_unit="N s/m"),
    nominal_parameter("coulomb_friction", linear_unit="N", required=False),
)


MECHANICAL_TERMS = {  # of a torque
    "viscous_friction": ("torque", "speed"),
    "coulomb_friction": ("torque", "direction"),
    "inertia": ("torque", "acceleration"),
}


def refused_linear(value: object, where: str, kinds: list[str]) -> InputError:
    """`linear` where there is no line."""
    return InputError(
        f"linear is {value!r}",
        where=where,
        expected=f"true or false, with kind = {' or '.join(repr(k) for k in kinds)} only".replace("'", '"'),
        fix="remove linear",
    )
