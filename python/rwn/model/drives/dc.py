"""A DC motor fed with a voltage: winding and shaft."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from rwn.model.drives.drive import MECHANICS, Drive, nominal

Numbers = TypeVar("Numbers", float, NDArray[np.float64])

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


def resting_current(speed: Numbers, voltage: Numbers, *, resistance: float, back_emf_constant: float) -> Numbers:
    """The current [A] at which the winding is at rest with a speed [rad/s] under a voltage [V]; numbers or (n,) each.

    As `resting_current` of the core's drive (cpp/include/rwn/model/drives/dc.hpp), without effects.
    """
    return (voltage - back_emf_constant * speed) / resistance
