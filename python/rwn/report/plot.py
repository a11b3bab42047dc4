"""A picture of the report as data: what `figures` makes of a diagnosis and `plots` draws."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rwn.values import Values

Slot = Literal["input", "response", "residual-time", "residual-speed", "law", "spectrum"]
Role = Literal["measured", "nominal", "refitted", "corrected", "before", "after", "reference", "noise-floor"]
Use = Literal["fit", "heldout"]
Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Trace(Values):
    """One line (or cloud) of a plot; `low`/`high` shade a band around it; NaN breaks the line.

    Where the points of a cloud were measured in `recording` at the instants `at` [s], a click on one leads there.
    Raises ValueError where arrays are not of one length, as in a damaged curves.json.
    """

    name: str
    role: Role
    x: Array
    y: Array
    low: Array | None = None
    high: Array | None = None
    points: bool = False  # a cloud instead of a line
    at: Array | None = None
    recording: str = ""

    def __post_init__(self) -> None:
        """Refuses arrays that do not belong together."""
        for name in ("y", "low", "high", "at"):
            values = getattr(self, name)
            if values is not None and values.shape != self.x.shape:
                raise ValueError(f"trace '{self.name}': {name} has {values.size} values, x has {self.x.size}")

    def __repr__(self) -> str:
        return f"<Trace '{self.name}' ({self.role}): {self.x.size} points>"


@dataclass(frozen=True, kw_only=True)
class Mark:
    """A stretch of the x axis to point at: the located region."""

    low: float
    high: float
    label: str


@dataclass(frozen=True, kw_only=True, repr=False)
class Plot:
    """One picture, in SI or in the units of its file; the report picks prefixes. `slot` says where it belongs.

    Pictures over the time of one `recording` share their time axis. `zoom`: the stretch of x that shows most. `shown`:
    the y that are worth seeing, where a few points lie far outside.
    """

    slot: Slot
    title: str
    x_label: str
    x_unit: str
    y_label: str
    y_unit: str
    traces: tuple[Trace, ...]
    marks: tuple[Mark, ...] = ()
    note: str = ""
    log_y: bool = False
    recording: str = ""
    use: Use | None = None  # what the recording served for
    zoom: tuple[float, float] | None = None
    shown: tuple[float, float] | None = None

    def __repr__(self) -> str:
        of = f" of {self.recording}" if self.recording else ""
        return f"<Plot {self.slot} '{self.title}'{of}: {len(self.traces)} trace{'s' * (len(self.traces) != 1)}>"
