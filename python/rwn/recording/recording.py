"""A recording: what a bench measured, in SI units, time first."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rwn.errors import InputError, plain
from rwn.fields import check_fields
from rwn.recording.check import check_beside, check_lengths, check_samples
from rwn.recording.columns import (
    assumed,
    column_map,
    in_si,
    is_linear,
    no_unit,
    refuse_without_units,
    units_of,
    unused,
)
from rwn.recording.formats import Table, read_table
from rwn.recording.formats.frame import table_of_object
from rwn.recording.formats.part import name_of
from rwn.recording.formats.table import refuse_mask
from rwn.recording.intersample import PiecewiseInput
from rwn.recording.layout import Layout
from rwn.recording.selection import selected
from rwn.recording.signals import COLUMNS, SIGNALS, TIME, meant, si_unit
from rwn.recording.units import factor
from rwn.values import Shown, Values, table_of_columns

if TYPE_CHECKING:
    import pandas

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

ENOUGH = 50_000  # rows that tell how a recording was made: mean squares of so many samples are known to 0.6 %


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Recording(Shown, Values):
    """Signals of one run: `time` (n_t,) [s], `signals` name -> (n_t,), in SI units (see docs/recordings.md).

    `linear`: a linear axis (m, m/s, N) instead of a shaft. `missing`: where (n_t,) a signal was not measured; what
    stands there is a guess that nothing is compared with. `units`: that its source has time and signals in, where it
    says so; what is written beside it is written in these. `applied_input`: the input as it acted, where more is known
    of it than its samples; `input_noise`: deviation of the white noise that was taken off it. `name` stands in messages
    and pictures; `source`: the file or table that it was read from;
    `warnings`: what reading it found odd, a sentence each. Arrays are made float64, contiguous and read-only.

    Raises InputError when lengths differ, an array is not a real vector or a signal's name is unknown.
    """

    name: str
    time: Array
    signals: Mapping[str, Array]
    source: str = ""
    linear: bool = False
    warnings: tuple[str, ...] = ()
    missing: Mapping[str, Flags] = field(default_factory=dict)
    applied_input: PiecewiseInput | None = None
    input_noise: float = 0.0
    units: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        where = plain(str(self.name)) or "Recording"
        check_fields(self, where=where)
        check_beside(self.units, self.missing, self.input_noise, linear=self.linear, where=where)
        time = _vector(self.name, "time", self.time)
        signals = {name: _vector(self.name, name, values) for name, values in self.signals.items()}
        for name, values in signals.items():
            if name not in SIGNALS:
                raise InputError(
                    f"unknown signal '{name}'",
                    where=self.name,
                    expected=", ".join(SIGNALS),
                    fix=f"rename it to '{meant(name)}'" if meant(name) else "remove it",
                )
            if len(values) != len(time):
                raise InputError(
                    f"'{name}' has {len(values)} samples, time has {len(time)}",
                    where=self.name,
                    expected="one value per instant",
                    fix="cut them to the same instants",
                )
        object.__setattr__(self, "time", time)
        object.__setattr__(self, "signals", MappingProxyType(signals))
        missing = {name: _flags(self.name, name, lost, len(time)) for name, lost in self.missing.items()}
        object.__setattr__(self, "missing", missing)

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        signals = ", ".join(self.signals)
        return f"<Recording {plain(self.name)}: {signals}; {len(self)} samples in {self.duration:.4g} s>"

    def table(self) -> pandas.DataFrame | dict[str, Array]:
        """Time and signals (n_t,) as columns `speed [rad/s]` in SI, which `read_recording` takes.

        A dictionary of arrays where pandas is not installed.
        """
        found: pandas.DataFrame | dict[str, Array] = table_of_signals(self.time, self.signals, linear=self.linear)
        return found

    def beginning(self, rows: int) -> Recording:
        """Its first `rows` rows."""
        if len(self) <= rows:
            return self
        signals = {name: values[:rows] for name, values in self.signals.items()}
        missing = {name: lost[:rows] for name, lost in self.missing.items()}
        return replace(self, time=self.time[:rows], signals=signals, missing=missing)

    @property
    def duration(self) -> float:
        """From the first to the last sample [s]."""
        return float(self.time[-1] - self.time[0]) if len(self) else 0.0


def table_of_signals(time: Array, signals: Mapping[str, Array], *, linear: bool) -> Any:
    """Time and signals (n_t,) as columns `speed [rad/s]` in SI."""
    named = {TIME.name: time, **signals}
    return table_of_columns({f"{name} [{si_unit(COLUMNS[name], linear)}]": x for name, x in named.items()})


def beginnings(recordings: Sequence[Recording]) -> list[Recording]:
    """As much of each recording as tells how it was made."""
    return [r.beginning(ENOUGH) for r in recordings]


def remarks(recordings: Sequence[Recording]) -> tuple[str, ...]:
    """What reading them found odd, each remark once, with the files that it is of."""
    of: dict[str, list[str]] = {}
    for recording in recordings:
        for warning in recording.warnings:
            where, _, remark = warning.partition(": ")
            of.setdefault(remark, []).append(where)
    return tuple(f"{', '.join(dict.fromkeys(where))}: {remark}" for remark, where in of.items())


def _vector(name: str, signal: str, values: Any) -> Array:
    refuse_mask(name, signal, values)
    try:
        array = np.asarray(values)
    except ValueError:  # lists of several lengths
        array = np.empty(0, dtype=object)
    if array.ndim != 1 or array.dtype.kind not in "fiu":
        raise InputError(
            f"'{signal}' is no vector of real numbers (shape {array.shape}, {array.dtype})",
            where=name,
            expected="shape (n_t,), real",
            fix="pass one value per sample",
        )
    copy = np.array(array, dtype=np.float64, order="C")
    copy.flags.writeable = False
    return copy


def _flags(name: str, signal: str, values: Any, samples: int) -> Flags:
    flags = np.asarray(values)
    if flags.shape != (samples,) or flags.dtype != np.bool_:
        raise InputError(
            f"missing of '{signal}' has shape {flags.shape}, {flags.dtype}",
            where=name,
            expected=f"shape ({samples},), bool",
            fix="pass true where the signal was not measured, such as np.isnan(values)",
        )
    if samples and flags.all():
        raise InputError(
            f"missing of '{signal}' is true for every sample", where=name, expected="a signal that was measured",
            fix=f"leave '{signal}' out",
        )
    return flags


def read_recording(source: Any, *, layout: Layout | None = None, needed: Collection[str] = COLUMNS) -> Recording:
    """Read a file or a table in Python whose columns are called `name [unit]`, or by the column map of `layout`.

    `source`: a path, a frame of pandas, polars or pyarrow, an xarray.Dataset or a dictionary of arrays. See
    docs/recordings.md. `needed`: signals whose mapped columns the source has to have. Raises InputError (where, what,
    what was expected, how to fix it) for anything that is not a clean recording.
    """
    layout = layout or Layout()
    is_path = isinstance(source, str | Path)
    table = read_table(Path(source), layout.wanted) if is_path else table_of_object(source, layout.wanted)
    mapping = column_map(table, layout, needed=needed)
    refuse_without_units(table, mapping)
    linear = is_linear(table, mapping)
    values = {name: in_si(table, name, column, linear=linear) for name, column in mapping.items()}
    time = values.pop(TIME.name, None)
    time = _counted_time(table, layout) if time is None else time
    ordered = {name: values[name] for name in SIGNALS if name in values}
    check_lengths(time, ordered, where=table.where)
    time, ordered, row = selected(time, ordered, layout, where=table.where, row=table.row)
    warnings = check_samples(time, ordered, where=table.where, row=lambda k: f"{table.where}, {row(k)}")
    return Recording(
        name=name_of(Path(source)) if is_path else table.where,
        time=time,
        signals=ordered,
        source=table.where,
        linear=linear,
        warnings=(*table.notes, *warnings, *assumed(table, layout, mapping), *unused(table, mapping)),
        units=units_of(table, mapping),
    )


def _counted_time(table: Table, layout: Layout) -> Array:
    if layout.sample_time is None and TIME.name in table.units and TIME.name not in layout.columns:
        raise no_unit(TIME.name, TIME.name, where=table.where)
    if layout.sample_time is None:
        raise InputError(
            f"there is no column 'time'; there are {', '.join(plain(name, longest=40) for name in table.units)}",
            where=table.where,
            expected="time [s]",
            fix="add it, or under [recording] in the model file map the column that is it, as "
            'columns.time = { source = "t", unit = "s" }, or give sample_time',
        )
    samples = len(next(iter(table.columns.values()), ()))
    return np.arange(samples, dtype=np.float64) * layout.sample_time


def write_csv(
    path: str | Path, time: Array, signals: Mapping[str, Array], *, linear: bool = False,
    units: Mapping[str, str] | None = None,
) -> None:  # fmt: skip
    """Write signals (n,) (SI) as a CSV that `read_recording` reads back; in SI, but for those that `units` names.

    Raises InputError for a unit that is none of its signal.
    """
    columns = {TIME.name: time, **signals}
    si = {name: si_unit(COLUMNS[name], linear) for name in columns}
    written = {name: (units or {}).get(name, unit) for name, unit in si.items()}
    header = ",".join(f"{name} [{unit}]" for name, unit in written.items())
    values = np.column_stack(
        [x if written[n] == si[n] else x / factor(written[n], si[n], where=path) for n, x in columns.items()]
    )
    np.savetxt(path, values, fmt="%.9g", delimiter=",", header=header, comments="")
