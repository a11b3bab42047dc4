"""A DC motor fed with a voltage: winding and shaft."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rwn.model.drives.axis import AXIS
from rwn.model.drives.drive import MECHANICAL_TERMS, MECHANICS, USUAL_VOLTAGE, Drive, Numbers, OneNumber, nominal

NO_TRANSIENT = 1e-6  # time constant of a winding without inductance [s]: shorter than any sample


@dataclass(frozen=True, kw_only=True)
class Winding(Drive):
    """A voltage drives a current, and that the shaft."""

    def driving_torque(self, motor: Mapping[str, float], current: Numbers, given: Numbers) -> Numbers:  # noqa: ARG002
        """Kt i, of numbers or (n,)."""
        return motor["torque_constant"] * current

    def torque_spread(self, uncertainty: Mapping[str, float]) -> float:
        """That of Kt."""
        return float(uncertainty.get("torque_constant", 0.0))

    def resting_current(self, motor: Mapping[str, float], speed: Numbers, given: Numbers) -> Numbers:
        """Without inductance, of numbers or (n,): as that of the core's drive (drives/dc.hpp) without effects."""
        return (given - motor["back_emf_constant"] * speed) / motor["resistance"]

    def resting_voltage(self, motor: Mapping[str, float], current: Numbers) -> Numbers:
        """R i."""
        return motor["resistance"] * current

    def back_emf(self, motor: Mapping[str, float], speed: Numbers) -> Numbers:
        """Ke w."""
        return motor["back_emf_constant"] * speed

    def halves(self, motor: Mapping[str, float]) -> str:
        """The shaft alone, driven by the recorded current."""
        scale = f"{motor['torque_constant']:.4g} N m/A"
        return (
            "To see whether the shaft or the winding lacks something, diagnose the shaft alone, driven by the recorded "
            'current: `kind = "axis"` with inertia and friction, and '
            f'`columns.torque = {{ source = "<the column of the current>", unit = "A", scale = "{scale}" }}`.'
        )

    def usual_input(self, motor: Mapping[str, float]) -> float:  # noqa: ARG002
        """A voltage [V], to a factor of some hundred."""
        return USUAL_VOLTAGE

    def heat(self, motor: Mapping[str, float], square: float) -> float:
        """R i^2."""
        return motor["resistance"] * square

    def speed_damping(self, motor: Mapping[str, float]) -> float:
        """Kt Ke / R, where the current is at rest with the speed."""
        coupling = motor["torque_constant"] * motor["back_emf_constant"]
        return coupling / motor["resistance"]

    def speed_spread(self, uncertainty: Mapping[str, float]) -> float:
        """Relative standard deviation of the speed: that of Ke, as a motor runs as fast as its back-EMF is large."""
        return float(uncertainty.get("back_emf_constant", 0.0))

    def as_simulated(self, motor: Mapping[str, float]) -> dict[str, float]:
        """An inductance of 0 as one that settles at once."""
        none = motor.get("inductance") == 0.0
        return {**motor, "inductance": NO_TRANSIENT * motor["resistance"]} if none else dict(motor)


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
    terms={
        **MECHANICAL_TERMS,
        "torque_constant": ("torque", "current"),
        "resistance": ("drop", "current"),
        "back_emf_constant": ("drop", "speed"),
    },
    one_numbers=(OneNumber(name="torque_constant", like="back_emf_constant", spread=0.02),),  # with a constant field
    winding=True,
    mechanics=AXIS,
)
