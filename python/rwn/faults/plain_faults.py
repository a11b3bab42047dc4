"""Faults that the sizes of the signals show plainly, before any physics: units, signs and gears."""

from __future__ import annotations

from collections.abc import Sequence

from rwn.faults.fault import Fault, without
from rwn.faults.odd_files import wrong_in_some
from rwn.faults.scale import wrong_scale
from rwn.model.model import Model
from rwn.recording.recording import Recording

MOST_SCALES = 2  # channels of a wrong scale that are found at a time


def plain_faults(recordings: Sequence[Recording], model: Model) -> tuple[list[Fault], list[Recording]]:
    """Wrong units, signs and gears, and the recordings without them. Raises InputError where one does not fit."""
    made: list[Fault] = []
    right = list(recordings)
    while len(made) < MOST_SCALES and (fault := wrong_in_some(right, model) or wrong_scale(right, model)):
        made.append(fault)
        right = without(right, fault)
    return made, right
