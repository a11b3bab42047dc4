"""The signals of a recording: the one table of their names, SI units and what else people call them."""

from __future__ import annotations

from dataclasses import dataclass

from rwn.errors import closest


@dataclass(frozen=True, kw_only=True)
class Signal:
    """A signal; `unit` on a rotary drive, `linear_unit` on a linear axis ("" where it does not exist)."""

    name: str
    meaning: str
    unit: str = ""
    linear_unit: str = ""
    example: str = ""  # another unit that benches write; suggested, never assumed
    also: tuple[str, ...] = ()  # other names people write; suggested, never taken silently


DRIVING_FORCE = "driving force"  # that moves an axis, where what is compared is the balance of forces

TIME = Signal(
    name="time", meaning="time of the row", unit="s", linear_unit="s", example="ms", also=("t", "timestamp", "seconds")
)

_ALL = (
    Signal(
        name="voltage",
        meaning="voltage that the drive was commanded to apply, held until the next row",
        unit="V",
        linear_unit="V",
        example="mV",
        also=("u", "v", "volt", "volts", "input", "armature_voltage", "command"),
    ),
    Signal(
        name="current",
        meaning="armature current",
        unit="A",
        linear_unit="A",
        example="mA",
        also=("i", "amp", "amps"),
    ),
    Signal(
        name="torque",
        meaning="commanded torque, held until the next row (kind axis)",
        unit="N m",
        example="mN m",
        also=("tau", "moment"),
    ),
    Signal(
        name="force",
        meaning="commanded force, held until the next row (kind axis, linear)",
        linear_unit="N",
        example="kN",
        also=("thrust",),
    ),
    Signal(
        name="speed",
        meaning="speed of the shaft, or of a linear axis",
        unit="rad/s",
        linear_unit="m/s",
        example="rpm",
        also=("velocity", "omega", "w", "velo", "vel", "rpm"),
    ),
    Signal(
        name="position",
        meaning="angle of the shaft, or travel of a linear axis",
        unit="rad",
        linear_unit="m",
        example="deg",
        also=("angle", "theta", "pos", "q"),
    ),
)

SIGNALS: dict[str, Signal] = {signal.name: signal for signal in _ALL}
MEASURED = ("current", "speed", "position")  # what a simulation is compared with, in the order of the core
MOTION = ("speed", "position")  # those of one shaft
COLUMNS: dict[str, Signal] = {TIME.name: TIME, **SIGNALS}


def meant(name: str) -> str | None:
    """The signal or time that a column called `name` probably is, or None."""
    key = name.strip().lower().replace(" ", "_")
    for signal in COLUMNS.values():
        if key == signal.name or key in signal.also:
            return signal.name
    return closest(name, COLUMNS)


def si_unit(signal: Signal, linear: bool) -> str:
    """SI unit of a signal on a rotary drive or a linear axis."""
    return (signal.linear_unit if linear else signal.unit) or signal.unit or signal.linear_unit
