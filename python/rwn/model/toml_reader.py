"""The TOML of a model: parsing, with the name of every slip."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Mapping
from typing import Any

from rwn.errors import InputError, plain, unrecognised
from rwn.model import vocabulary
from rwn.model.checks import LARGEST, check_numbers
from rwn.model.drives import KINDS
from rwn.model.drives.drive import Drive, NominalParameter, refused_linear
from rwn.model.model import LOADS, Model
from rwn.model.own_effects import OwnEffect, check_own_effects
from rwn.model.toml_own_effects import from_entry
from rwn.model.toml_schema import ColumnEntry, File, LoadTable, Number, RecordingTable, decode
from rwn.recording import units
from rwn.recording.intersample import known_law
from rwn.recording.layout import Column, Layout
from rwn.recording.profiles import known_profile
from rwn.recording.signals import COLUMNS, MEASURED, TIME

_MOST_ROWS = 10**6  # of a file, for which one may be kept: at least 50 are fitted, and no bench records 5e7


def parse_model(text: str, *, where: str) -> Model:
    """The model that `text` describes. Raises InputError."""
    file = decode(text, where)
    place = f"{where}, [motor]"
    drive, linear = _drive(file.motor, place)
    motor = {key: value for key, value in file.motor.items() if key not in ("kind", "linear")}
    given, order = drive.read(motor, where=place)
    parameters = _values(given, drive.nominal_parameters(order), linear=linear, where=place)
    uncertainty = _uncertainty(file, f"{where}, [uncertainty]")
    for name, other in _told_by_another(parameters, drive):
        parameters[name] = parameters[other]
        if other in uncertainty:
            uncertainty.setdefault(name, uncertainty[other])
    own = {name: from_entry(name, entry, drive, where=where) for name, entry in file.own_effects.items()}
    check_own_effects(tuple(own.values()), drive, where=f"{where}, [own_effects]")
    return Model(
        kind=drive.kind,
        parameters=parameters,
        uncertainty=uncertainty,
        effects=_effects(file.effects, own, drive, where) if file.effects else {},
        own_effects=tuple(own.values()),
        load=_load(file.load, drive, where),
        linear=linear,
        order=order,
        recording=_layout(file.recording, f"{where}, [recording]"),
        source=where,
    )


def _told_by_another(given: Mapping[str, float], drive: Drive) -> list[tuple[str, str]]:
    """Parameters that are not given, each with one that is and is the same number: a data sheet has Kt or Ke."""
    pairs = [pair for one in drive.one_numbers for pair in ((one.name, one.like), (one.like, one.name))]
    return [(name, other) for name, other in pairs if name not in given and other in given]


def _drive(motor: Mapping[str, Any], where: str) -> tuple[Drive, bool]:
    """The kind of drive, and whether it moves along a line."""
    kind, linear = motor.get("kind"), motor.get("linear", False)
    if not isinstance(kind, str):
        raise InputError(
            "there is no kind" if kind is None else f"kind is {kind!r}",
            where=where,
            expected="kind = one of " + ", ".join(f'"{k}"' for k in KINDS),
            fix='add kind = "dc" for a motor fed with a voltage',
        )
    if kind not in KINDS:
        raise unrecognised("kind", kind, KINDS, where=where)
    on_a_line = KINDS[kind].on_a_line
    if not isinstance(linear, bool) or (linear and on_a_line is None):
        raise refused_linear(linear, where, [k for k, drive in KINDS.items() if drive.on_a_line])
    return (on_a_line if linear and on_a_line else KINDS[kind]), linear


def _values(
    given: Mapping[str, Any], table: Iterable[NominalParameter], *, linear: bool, where: str
) -> dict[str, float]:
    entries = {entry.name: entry for entry in table}
    for key in given:
        if key not in entries:
            raise unrecognised("key", key, entries, where=where)
    values: dict[str, float] = {}
    for name, entry in entries.items():
        unit = (entry.linear_unit if linear else entry.unit) or entry.unit
        if name in given:
            values[name] = _number(given[name], unit, f"{where} {name}")
    return values


def _number(value: Any, unit: str, where: str) -> float:
    if isinstance(value, str):
        number = units.quantity(value, unit, where=where)
    elif isinstance(value, bool) or not isinstance(value, int | float):
        kind = "true or false" if isinstance(value, bool) else type(value).__name__
        raise InputError(
            f"the value is {kind}",
            where=where,
            expected=f"a number in {unit}, or text with a unit",
            fix=f'write for instance 0.4 or "0.4 {unit}"',
        )
    else:
        number = value
    return math.inf if abs(number) > sys.float_info.max else float(number)  # a whole number may be too long for one


def _uncertainty(file: File, where: str) -> dict[str, float]:
    """By name of the parameter, those of effects as "effect.parameter"."""
    found = {}
    for name, given in file.uncertainty.items():
        if not isinstance(given, dict):
            found[name] = _deviation(given, f"{where} {name}")
        elif name in file.effects:
            found |= {f"{name}.{p}": _deviation(value, f"{where} {name}.{p}") for p, value in given.items()}
        else:
            raise InputError(
                f"{name} is a table, and there is no effect of that name",
                where=where,
                expected='a number such as 0.1, or "10 %"',
                fix=f"write {name} = 0.1 for a parameter of the motor; an effect needs its [effects.{name}]",
            )
    return found


def _deviation(value: Number, where: str) -> float:
    """A relative one; infinite only where it is written so."""
    number = _number(value, "dimensionless", where)
    return number if value == math.inf else min(number, sys.float_info.max)


def _effects(
    given: Mapping[str, Mapping[str, Number]],
    own: Mapping[str, OwnEffect],
    drive: Drive,
    where: str,
) -> dict[str, dict[str, float]]:
    known = vocabulary.table()
    found: dict[str, dict[str, float]] = {}
    for name, values in given.items():
        place = f"{where}, [effects.{name}]"
        if name not in known and name not in own:
            raise unrecognised("effect", name, [*known, *own], where=f"{where}, [effects]")
        if name in own:
            entries = {p.name: p.unit for p in own[name].parameters}  # as the user has written them
        else:
            entries = {p.name: drive.unit_of(known[name], p.unit) for p in known[name].every}
        for key in values:
            if key not in entries:
                raise unrecognised("parameter", key, entries, where=place)
        found[name] = {k: _number(v, _si(entries[k]), f"{place} {k}") for k, v in values.items()}
    second = [name for name in found if name in known and known[name].second_mass]
    if len(second) > 1:
        raise InputError(
            f"{' and '.join(second)} each bring a second mass",
            where=f"{where}, [effects]",
            expected="one of them",
            fix=f"remove [effects.{second[-1]}]",
        )
    return found


def _si(unit: str) -> str:
    return "dimensionless" if unit in ("", "1") else unit


def _load(load: LoadTable, drive: Drive, where: str) -> dict[str, dict[str, float]]:
    if load.pendulum is None:
        return {}
    place = f"{where}, [load.pendulum]"
    if not drive.shaft:
        raise InputError(
            "a pendulum on a drive without a shaft",
            where=place,
            expected="a rotary drive of kind dc or axis",
            fix="remove [load.pendulum]",
        )
    return {"pendulum": _values(load.pendulum, LOADS["pendulum"], linear=False, where=place)}


def _layout(given: RecordingTable, where: str) -> Layout:
    columns = {
        name: _column(name, column, f"{where} columns.{name}") for name, column in given.columns.items()
    }
    for source, name in given.rename.items():
        if name in columns:
            raise InputError(
                f"'{name}' is mapped and renamed to",
                where=f"{where} rename",
                expected="one source for each signal",
                fix=f"remove columns.{name}, or the renaming",
            )
        columns[name] = _column(name, ColumnEntry(source=source), f"{where} rename")
    time = None if given.sample_time is None else _seconds(given.sample_time, f"{where} sample_time")
    if time is not None and time <= 0:
        raise InputError(
            f"sample_time is {time:g} s",
            where=where,
            expected="a positive time",
            fix="write for instance 0.001",
        )
    for name, count in (("initial_samples", given.initial_samples), ("decimate", given.decimate)):
        if not 1 <= count <= _MOST_ROWS:
            raise InputError(
                f"{name} is {plain(str(count), longest=40)}", where=where,
                expected=f"a whole number from 1 to {_MOST_ROWS}", fix="write for instance 20",
            )  # fmt: skip
    start, end = (
        None if value is None else _seconds(value, f"{where} {name}")
        for name, value in (("from", given.start), ("to", given.end))
    )
    if start is not None and end is not None and not start < end:
        raise InputError(
            f"from is {start:g} s, to is {end:g} s", where=where, expected="from before to", fix="exchange them"
        )
    return Layout(
        columns=columns, sample_time=time, initial=given.initial, initial_samples=given.initial_samples,
        start=start, end=end, decimate=given.decimate, profile=known_profile(given.profile, where=f"{where} profile"),
        intersample=known_law(given.intersample, where=f"{where} intersample"),
        delays=_delays(given.delays, f"{where} delays"),
        filters=_filters(given.filters, f"{where} filters"),
        speed_rows=_speed_rows(given.speed_rows, f"{where} speed_rows"),
    )  # fmt: skip


def _speed_rows(given: tuple[int, int] | None, where: str) -> tuple[int, int] | None:
    if given is not None and not all(0 <= rows <= _MOST_ROWS for rows in given):
        raise InputError(
            f"speed_rows is {list(given)}", where=where, expected="how many rows before and after, 0 or more each",
            fix="write for instance [1, 1] for a central difference, [0, 0] for a speed of its own",
        )  # fmt: skip
    return given


def _by_signal(given: dict[str, Number], where: str) -> dict[str, float]:
    """Times [s] by measured signal."""
    unknown_ones = [name for name in given if name not in MEASURED]
    if unknown_ones:
        raise unrecognised("measured signal", unknown_ones[0], MEASURED, where=where)
    return {name: _number(time, TIME.unit, f"{where}.{name}") for name, time in given.items()}


def _delays(given: dict[str, Number], where: str) -> dict[str, float]:
    found = _by_signal(given, where)
    check_numbers(found, where=where)
    return found


def _filters(given: dict[str, Number], where: str) -> dict[str, float]:
    found = _by_signal(given, where)
    for name, time in found.items():
        if not 0.0 < time <= LARGEST:
            raise InputError(
                f"the filter of the {name} has a time constant of {time:g} s", where=where, expected="a positive time",
                fix='write for instance "2 ms"',
            )  # fmt: skip
    return found


def _seconds(value: Number, where: str) -> float:
    seconds = _number(value, TIME.unit, where)
    check_numbers({"": seconds}, where=where)
    return seconds


def _column(name: str, given: ColumnEntry, where: str) -> Column:
    if name not in COLUMNS:
        raise unrecognised("signal", name, COLUMNS, where=where)
    scale, unit = (
        (given.scale, "") if isinstance(given.scale, float | int) else units.split(given.scale, where=where)
    )
    if not 1e-15 <= abs(scale) <= 1e15:
        raise InputError(
            f"scale is {scale}",
            where=where,
            expected="a number that is not 0, from 1e-15 to 1e15 in size",
            fix="write 1, a gear ratio, -1 for a wrong sign, or text with a unit",
        )
    source = name if given.source is None else given.source
    return Column(source=source, unit=given.unit, scale=float(scale), scale_unit=unit)
