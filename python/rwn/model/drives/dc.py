"""A DC motor fed with a voltage: winding and shaft."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rwn import _core
from rwn.model.drives.axis import AXIS
from rwn.model.drives.drive import MECHANICAL_TERMS, MECHANICS, OneNumber, nominal_parameter
from rwn.model.drives.winding import WindingDrive

NO_TRANSIENT = 1e-6  # time constant of a winding without inductance [s]: shorter than any sample


@dataclass(frozen=True, kw_only=True)
class DcMotor(WindingDrive):
    """Its winding is that of its terminals, and of a field that does not change."""

    def winding_of(self, motor: Mapping[str, float]) -> _core.Winding:
        """Of R, L, Kt and Ke."""
        return _core.Winding(
            resistance=motor["resistance"], inductance=motor["inductance"],
            torque_constant=motor["torque_constant"], back_emf_constant=motor["back_emf_constant"],
        )  # fmt: skip

    def torque_spread(self, uncertainty: Mapping[str, float]) -> float:
        """That of Kt."""
        return float(uncertainty.get("torque_constant", 0.0))

    def halves(self, motor: Mapping[str, float]) -> str:
        """The shaft alone, driven by the recorded current."""
        scale = f"{motor['torque_constant']:.4g} N m/A"
        return (
            "To see whether the shaft or the winding lacks something, diagnose the shaft alone, driven by the recorded "
            'current: `kind = "axis"` with inertia and friction, and '
            f'`columns.torque = {{ source = "<the column of the current>", unit = "A", scale = "{scale}" }}`.'
        )

    def speed_spread(self, uncertainty: Mapping[str, float]) -> float:
        """Relative standard deviation of the speed: that of Ke, as a motor runs as fast as its back-EMF is large."""
        return float(uncertainty.get("back_emf_constant", 0.0))

    def as_simulated(self, motor: Mapping[str, float]) -> dict[str, float]:
        """An inductance of 0 as one that settles at once."""
        none = motor.get("inductance") == 0.0
        return {**motor, "inductance": NO_TRANSIENT * motor["resistance"]} if none else dict(motor)


DC = DcMotor(
    kind="dc",
    input="voltage",
    outputs=("speed", "position", "current"),
    parameters=(
        nominal_parameter("resistance", positive=True),
        nominal_parameter("inductance"),
        nominal_parameter("torque_constant", positive=True),
        nominal_parameter("back_emf_constant", positive=True),
        *MECHANICS,
    ),
    terms={
        **MECHANICAL_TERMS,
        "torque_constant": ("torque", "current"),
        "resistance": ("drop", "current"),
        "back_emf_constant": ("drop", "speed"),
    },
    one_numbers=(  # with a constant field
        OneNumber(name="torque_constant", like="back_emf_constant", spread=0.02, data_sheet_unit="V/krpm"),
    ),
    mechanics=AXIS,
)
