"""The machines that `rwn evidence` knows. A new one is a file, its nominal model and a line here."""

from __future__ import annotations

from rwn.studies.machines import ced, emps, fra233, frc, hall, laas, odrive, undc, xl330
from rwn.studies.machines.machine import Machine

MACHINES: dict[str, Machine] = {
    of.MACHINE.name: of.MACHINE for of in (emps, ced, fra233, xl330, frc, odrive, laas, undc, hall)
}
