"""The kinds of drive that a model can be of: their signals and nominal parameters, one table."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Nominal:
    """A nominal parameter. `positive`: zero is refused too; `linear_unit`: on a linear axis."""

    name: str
    unit: str
    meaning: str
    linear_unit: str = ""
    positive: bool = False
    required: bool = True


@dataclass(frozen=True, kw_only=True)
class Drive:
    """A kind of drive: what is fed in, what can be measured, what its nominal model is made of."""

    kind: str
    input: str
    outputs: tuple[str, ...]
    parameters: tuple[Nominal, ...]


_RESISTANCE = Nominal(name="resistance", unit="ohm", meaning="terminal resistance", positive=True)
_INDUCTANCE = Nominal(name="inductance", unit="H", meaning="winding inductance")
_TORQUE_CONSTANT = Nominal(name="torque_constant", unit="N m/A", meaning="torque per ampere", positive=True)
_BACK_EMF = Nominal(name="back_emf_constant", unit="V s/rad", meaning="voltage per speed", positive=True)
_INERTIA = Nominal(
    name="inertia",
    unit="kg m^2",
    linear_unit="kg",
    meaning="inertia, or mass of a linear axis",
    positive=True,
)
_VISCOUS = Nominal(
    name="viscous_friction", unit="N m s/rad", linear_unit="N s/m", meaning="friction proportional to speed"
)
_COULOMB = Nominal(
    name="coulomb_friction",
    unit="N m",
    linear_unit="N",
    meaning="dry friction of constant level",
    required=False,
)
_MECHANICS = (_INERTIA, _VISCOUS, _COULOMB)

DC = Drive(
    kind="dc",
    input="voltage",
    outputs=("speed", "position", "current"),
    parameters=(_RESISTANCE, _INDUCTANCE, _TORQUE_CONSTANT, _BACK_EMF, *_MECHANICS),
)
AXIS = Drive(kind="axis", input="torque", outputs=("speed", "position"), parameters=_MECHANICS)
LINEAR_AXIS = Drive(kind="axis", input="force", outputs=("speed", "position"), parameters=_MECHANICS)
LTI = Drive(kind="lti", input="voltage", outputs=("speed",), parameters=())  # coefficients, by order

KINDS: dict[str, Drive] = {drive.kind: drive for drive in (DC, AXIS, LTI)}
