"""A kind of drive in which a voltage drives the current of a winding, and that current the shaft.

The equations stand in the core (cpp/include/rwn/model/winding.hpp); a kind says with which of its parameters they hold.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import cast

from rwn import _core
from rwn.model.drives.drive import USUAL_VOLTAGE, Drive, Numbers


@dataclass(frozen=True, kw_only=True)
class WindingDrive(Drive):
    """Answers what the stages ask of a winding by the equations of the core."""

    winding: bool = True

    def winding_of(self, motor: Mapping[str, float]) -> _core.Winding:
        """The winding of a motor with these values of its parameters.

        Raises NotImplementedError where the kind does not say.
        """
        raise NotImplementedError(f"a {self.kind} does not say what its winding is")

    def driving_torque(self, motor: Mapping[str, float], current: Numbers, given: Numbers) -> Numbers:  # noqa: ARG002
        """That of the current; numbers or (n,)."""
        return cast(Numbers, self.winding_of(motor).torque(current))

    def resting_current(self, motor: Mapping[str, float], speed: Numbers, given: Numbers) -> Numbers:
        """As if without inductance; numbers or (n,)."""
        return cast(Numbers, self.winding_of(motor).resting_current(speed, given))

    def resting_voltage(self, motor: Mapping[str, float], current: Numbers) -> Numbers:
        """That over the resistance; numbers or (n,)."""
        return cast(Numbers, self.winding_of(motor).resting_voltage(current))

    def back_emf(self, motor: Mapping[str, float], speed: Numbers) -> Numbers:
        """What a speed induces; numbers or (n,)."""
        return cast(Numbers, self.winding_of(motor).back_emf(speed))

    def usual_input(self, motor: Mapping[str, float]) -> float:  # noqa: ARG002
        """A voltage [V], to a factor of some hundred."""
        return USUAL_VOLTAGE

    def heat(self, motor: Mapping[str, float], square: float) -> float:
        """What the resistance turns to heat."""
        return self.winding_of(motor).heat(square)

    def speed_damping(self, motor: Mapping[str, float]) -> float:
        """That of the back-EMF, where the current is at rest with the speed: the rate at which it brakes 1 kg m^2."""
        return self.winding_of(motor).braking_rate(1.0)
