"""WPILib SysId's JSON: four tests (slow and fast, both ways), rows of time, voltage, position and velocity.

Source of the columns: allwpilib, sysid (2022 and 2023), AnalysisManager; newer versions record a .wpilog.
"""

from __future__ import annotations

import json
from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np

from rwn.errors import InputError
from rwn.recording.formats.table import Table, table_of
from rwn.recording.units import is_unit

TESTS = ("slow-forward", "slow-backward", "fast-forward", "fast-backward")
_UNITS = {
    "Meters": "m", "Feet": "ft", "Inches": "in", "Radians": "rad", "Rotations": "turn", "Degrees": "deg",
}  # fmt: skip
# columns of a row; the sides of a drivetrain are parts of their own
_SIMPLE = ("time", "voltage", "position", "speed")
_DRIVETRAIN = (
    "time", "left.voltage", "right.voltage", "left.position", "right.position", "left.speed", "right.speed", "angle",
    "angular_rate",
)  # fmt: skip
_SIDES = ("left", "right")


def read_sysid(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` columns, named `slow-forward.speed`; of a drivetrain `slow-forward.left.speed`.

    Raises InputError where the file is no such JSON.
    """
    try:
        content = json.loads(path.read_bytes())
        unit = _UNITS.get(content["units"], content["units"])
        tests = {name: np.array(content[name], dtype=np.float64) for name in TESTS if content.get(name)}
        if not tests or not isinstance(unit, str) or not is_unit(unit):
            raise ValueError
        arrays: dict[str, Any] = {}
        told: dict[str, str | None] = {}
        for test, rows in tests.items():
            names = {len(_SIMPLE): _SIMPLE, len(_DRIVETRAIN): _DRIVETRAIN}[rows.shape[1]]
            for name, column in zip(names, rows.T, strict=True):
                for full in _placed(test, name, drivetrain=names is _DRIVETRAIN):
                    arrays[full], told[full] = column, _unit(name, unit)
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
        raise InputError(
            "this is no JSON of WPILib SysId",
            where=path,
            expected='tests such as "slow-forward" with rows of 4 or 9 numbers, and "units"',
            fix="give the file as recorded, or export the recording as CSV",
        ) from error
    return table_of(str(path), arrays, told, wanted)


def _placed(test: str, name: str, *, drivetrain: bool) -> list[str]:
    """Where a column is found: a drivetrain's time belongs to both sides."""
    shared = drivetrain and name == "time"
    return [f"{test}.{name}", *(f"{test}.{side}.{name}" for side in _SIDES if shared)]


def _unit(name: str, unit: str) -> str:
    kinds = {"time": "s", "voltage": "V", "position": unit, "speed": f"{unit}/s", "angle": "rad"}
    return kinds.get(name.split(".")[-1], "rad/s")
