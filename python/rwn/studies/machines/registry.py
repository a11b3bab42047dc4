"""The machines that `rwn evidence` knows. A new one is a file, its nominal model and a line here."""

from __future__ import annotations

from rwn.studies.machines import ced, emps, fra233, frc, odrive, xl330
from rwn.studies.machines.machine import Machine

MACHINES: dict[str, Machine] = {
    m.name: m for m in (emps.MACHINE, ced.MACHINE, fra233.MACHINE, xl330.MACHINE, frc.MACHINE, odrive.MACHINE)
}
