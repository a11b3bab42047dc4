"""A machine axis driven by a known torque, or by a known force along a line."""

from __future__ import annotations

from rwn.model.drives.drive import MECHANICAL_TERMS, MECHANICS, Drive

LINEAR_AXIS = Drive(
    kind="axis", input="force", outputs=("speed", "position"), parameters=MECHANICS, force=True,
    terms=MECHANICAL_TERMS,
    linear=True, shaft=False,
)  # fmt: skip
AXIS = Drive(
    kind="axis", input="torque", outputs=("speed", "position"), parameters=MECHANICS, force=True,
    terms=MECHANICAL_TERMS,
    on_a_line=LINEAR_AXIS,
)  # fmt: skip
