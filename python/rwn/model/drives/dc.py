"""A DC motor fed with a voltage: winding and shaft."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rwn.model.drives.drive import MECHANICS, Drive, Numbers, nominal


@dataclass(frozen=True, kw_only=True)
class Winding(Drive):
    """A voltage drives a current, and that the shaft."""

    def driving_torque(self, motor: Mapping[str, float], current: Numbers, given: Numbers) -> Numbers:  # noqa: ARG002
        """Kt i, of numbers or (n,)."""
        return motor["torque_constant"] * current

    def resting_current(self, motor: Mapping[str, float], speed: Numbers, given: Numbers) -> Numbers:
        """Without inductance, of numbers or (n,): as that of the core's drive (drives/dc.hpp) without effects."""
        return (given - motor["back_emf_constant"] * speed) / motor["resistance"]

    def speed_damping(self, motor: Mapping[str, float]) -> float:
        """Kt Ke / R, where the current is at rest with the speed."""
        coupling = motor["torque_constant"] * motor["back_emf_constant"]
        return coupling / motor["resistance"]


DC = Winding(
    kind="dc",
    input="voltage",
    outputs=("speed", "position", "current"),
    parameters=(
        nominal("resistance", positive=True),
        nominal("inductance"),
        nominal("torque_constant", positive=True),
        nominal("back_emf_constant", positive=True),
        *MECHANICS,
    ),
    winding=True,
)
