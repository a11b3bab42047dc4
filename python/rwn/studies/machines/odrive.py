"""ODrive: the current that a brushless motor of 7 pole pairs needs to turn slowly, over one revolution."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rwn.recording.recording import Recording
from rwn.recording.smoothing import LENGTHS, smooth
from rwn.studies.machines.machine import Machine, Outcome, Say, data_file, error_of, judged, nominal_model

Array = NDArray[np.float64]
COUNTS = 8192  # per revolution
SETTLED = 0.5  # [s] after the return
CURRENT = "current that the motion needs, second revolution [%]"
HARMONICS = (7, 14, 28, 84)  # of the cogging, as its users state them


def run(folder: Path, say: Say) -> tuple[Outcome, ...]:
    """A revolution without compensation is fitted, the other one judges."""
    first, second = (read_revolution(data_file(folder, f"nocomp_{k}.npy")) for k in (0, 1))
    outcome = judged("ODrive", "inertia and friction", nominal_model("odrive"), [first], [second], say)
    errors = (
        error_of(outcome.found, second.name, "position", "free-running position, second revolution [rad]"),
        error_of(outcome.found, second.name, "driving force", CURRENT),
    )
    found = ", ".join(str(k) for k in blind_orders(first))
    notes = (
        f"harmonics of the current found blind on the first revolution: {found}; stated by its users: "
        + ", ".join(str(k) for k in HARMONICS),
        "a stiff position loop holds the speed constant: the free run from the current says nothing of what it was "
        "for",
    )
    return (replace(outcome, errors=errors, notes=notes),)


def blind_orders(recording: Recording, count: int = 5) -> list[int]:
    """Whole numbers per revolution, one after the other the one that explains most of what is left of the current."""
    chosen: list[int] = []
    for _ in range(count):
        left = recording.signals["torque"] - predicted(recording, recording, chosen)
        angle = recording.signals["position"]
        share = [abs(np.exp(1j * k * angle) @ left) for k in range(1, 121)]
        chosen.append(1 + int(np.argmax(share)))
    return chosen


def predicted(fitted: Recording, shown: Recording, orders: list[int]) -> Array:
    """The current that acceleration, friction and harmonics fitted on one recording give on another."""
    weights = np.linalg.lstsq(_columns(fitted, orders), fitted.signals["torque"], rcond=None)[0]
    found: Array = _columns(shown, orders) @ weights
    return found


def _columns(recording: Recording, orders: list[int]) -> Array:
    angle = recording.signals["position"]
    step = float(np.median(np.diff(recording.time)))
    speed, acceleration = (smooth(angle, LENGTHS[0], derivative=d, step=step) for d in (1, 2))
    waves = [wave(k * angle) for k in orders for wave in (np.cos, np.sin)]
    return np.column_stack([np.ones(angle.size), speed, acceleration, *waves])


def read_revolution(path: Path) -> Recording:
    """Time, angle and current of the slow turn, from half a second after the return to its start."""
    time, counts, current = np.asarray(np.load(path), dtype=float)
    begin = int(np.searchsorted(time, time[int(np.argmin(counts))] + SETTLED))
    angle = counts * 2.0 * np.pi / COUNTS
    time, signals = time[begin:] - time[begin], {"torque": current[begin:], "position": angle[begin:]}
    return Recording(name=path.name, time=time, signals=signals)


MACHINE = Machine(name="odrive", folder="odrive_cogging", source="gchenfc/ODrive", run=run)
