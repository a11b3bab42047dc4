"""The kinds of drive that a model can be of: their signals and nominal parameters, one table."""

from __future__ import annotations

from dataclasses import dataclass

from rwn import _core


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


_TABLE = {row["name"]: row for row in _core.motor_parameter_table()}  # units and meanings: cpp/include/rwn/drive.hpp


def _nominal(name: str, *, linear_unit: str = "", positive: bool = False, required: bool = True) -> Nominal:
    row = _TABLE[name]
    return Nominal(
        name=name,
        unit=row["unit"],
        meaning=row["meaning"],
        linear_unit=linear_unit,
        positive=positive,
        required=required,
    )


_ELECTRICS = (
    _nominal("resistance", positive=True),
    _nominal("inductance"),
    _nominal("torque_constant", positive=True),
    _nominal("back_emf_constant", positive=True),
)
_MECHANICS = (
    _nominal("inertia", linear_unit="kg", positive=True),
    _nominal("viscous_friction", linear_unit="N s/m"),
    _nominal("coulomb_friction", linear_unit="N", required=False),
)

DC = Drive(
    kind="dc",
    input="voltage",
    outputs=("speed", "position", "current"),
    parameters=(*_ELECTRICS, *_MECHANICS),
)
AXIS = Drive(kind="axis", input="torque", outputs=("speed", "position"), parameters=_MECHANICS)
LINEAR_AXIS = Drive(kind="axis", input="force", outputs=("speed", "position"), parameters=_MECHANICS)
LTI = Drive(kind="lti", input="voltage", outputs=("speed",), parameters=())  # coefficients, by order

KINDS: dict[str, Drive] = {drive.kind: drive for drive in (DC, AXIS, LTI)}
