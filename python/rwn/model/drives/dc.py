"""A DC motor fed with a voltage: winding and shaft."""

from __future__ import annotations

from rwn.model.drives.drive import MECHANICS, Drive, nominal

DC = Drive(
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
