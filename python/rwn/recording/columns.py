"""Which column of a table is which signal, in which unit."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.errors import InputError, closest, plain
from rwn.recording import units
from rwn.recording.formats import Table
from rwn.recording.layout import Column, Layout
from rwn.recording.profiles import exporters, names_of, profile, sources
from rwn.recording.signals import COLUMNS, SIGNALS, TIME, meant, si_unit

Array = NDArray[np.float64]

NOT_USED = "not used"  # said of the columns that are no signal


def column_map(table: Table, layout: Layout, *, needed: Collection[str] = COLUMNS) -> dict[str, Column]:
    """Every signal's column: those of the layout, and those that the file calls by the signal's name.

    A file without any unit is read by the map alone, where there is one. Signals that are not `needed` may be mapped to
    columns that the file lacks, and are then left out. Raises InputError where a column is nearly called like a signal
    (that is a slip, not an extra column), or none is called like one.
    """
    taken = {column.source for column in layout.columns.values()}  # as the current that stands for a torque
    by_name = set(COLUMNS) - set(layout.columns) - taken
    if (layout.columns or layout.profile) and not any(table.units.values()):
        by_name = set()
    mapping = {name: Column(source=name) for name in by_name if name in table.units}
    known = _by_profile(table, layout)
    mapping |= known | {name: _placed(table, name, column, known) for name, column in layout.columns.items()}
    mapping = {name: column for name, column in mapping.items() if name in needed or column.source in table.units}
    used = {column.source for column in mapping.values()}
    others = [name for name in table.units if by_name and layout.profile is None and name not in used]
    slips = {name: signal for name in others if (signal := meant(name)) is not None and signal not in mapping}
    if slips:
        raise _no_known_signals(table, slips)
    if not set(mapping) - {TIME.name}:
        parts = [name.rpartition(".")[0] for name in table.units if name.rpartition(".")[2] in COLUMNS]
        runs = list(dict.fromkeys(filter(None, parts)))
        if runs:
            what = "several runs" if len(runs) > 1 else "its signals under one name"
            raise InputError(
                f"the file holds {what}: {', '.join(runs)}",
                where=table.where,
                expected="the one that is meant",
                fix=f"write it after the file: {table.where}#{runs[0]}",
            )
        exported_by = exporters(table.units)
        raise InputError(
            f"no column is called like a signal; there are {', '.join(table.units) or 'none'}",
            where=table.where,
            expected="a column map, [recording.columns] in the model file",
            fix=f"--profile {exported_by[0]}, which knows these names"
            if exported_by
            else f"write for instance: {_mapped_by_their_units(table)}",
        )
    return mapping


def _mapped_by_their_units(table: Table) -> str:
    """Lines of a map for columns that have the units of signals; where none has, one for the last column."""
    lines = dict[str, str]()
    for name, unit in table.units.items():
        for signal in SIGNALS.values():
            kinds = [kind for kind in (signal.unit, signal.linear_unit) if kind]
            if unit and any(units.has_dimension(unit, kind, where=table.where) for kind in kinds):
                lines.setdefault(signal.name, f'columns.{signal.name} = {{ source = "{name}" }}')
    if lines:
        return "; ".join(lines.values())
    source = next((name for name in reversed(list(table.units)) if name != TIME.name), "w")
    return f'columns.speed = {{ source = "{source}", unit = "rad/s" }}'


def _placed(table: Table, name: str, column: Column, known: Mapping[str, Column]) -> Column:
    """A column of the map that bears its signal's name alone: where the file has none of it, that of the profile.

    Its unit and scale go with it where the map has no unit: the map's scale is then a sign or a gear on top.
    """
    if column.source != name or name in table.units or name not in known:
        return column
    of = known[name]
    if column.unit is not None or column.scale_unit:
        return replace(column, source=of.source)
    return replace(of, scale=of.scale * column.scale)


def _no_known_signals(table: Table, slips: Mapping[str, str]) -> InputError:
    """The refusal of columns whose names are nearly those of signals: all at once."""
    said, entries = zip(*(_remedy(table, name, signal) for name, signal in slips.items()), strict=True)
    columns = ", ".join(f"'{name}'" for name in slips)
    what = f"column {columns} is no known signal"
    fix = f"{said[0]}, or add to [recording]: {entries[0]}"
    if len(slips) > 1:
        what = f"columns {columns} are no known signals"
        fix = f"where they are meant so, add to [recording], a line each: {'; '.join(entries)}"
    return InputError(what, where=table.where, expected=", ".join(COLUMNS), fix=fix)


def _remedy(table: Table, name: str, signal: str) -> tuple[str, str]:
    """For a column whose name is nearly that of a signal, in words and as an entry of the column map.

    A unit may stand in the name, or nowhere.
    """
    words = re.split(r"[\s_.-]+", name)
    tail = words[-1] if len(words) > 1 or name.lower() != signal else ""
    si, kinds = si_unit(COLUMNS[signal], False), {COLUMNS[signal].unit, COLUMNS[signal].linear_unit} - {""}
    alike = units.is_unit(tail) and any(units.has_dimension(tail, kind, where=table.where) for kind in kinds)
    if not table.units[name] and alike:
        return f"write '{signal} [{tail}]'", f"columns.{signal} = {{ source = '{name}', unit = '{tail}' }}"
    if not table.units[name]:
        entry = f"columns.{signal} = {{ source = '{name}', unit = '{si}' }}"
        return f"did you mean '{signal} [{si}]'? add its unit", entry
    return f"did you mean '{signal}'? rename it", f"columns.{signal} = {{ source = '{name}' }}"


def _by_profile(table: Table, layout: Layout) -> dict[str, Column]:
    """The columns that the profile of a tool knows and the layout does not name; the file's own unit goes before."""
    if layout.profile is None:
        return {}
    known = profile(layout.profile)
    left = [name for name in table.units if name not in {column.source for column in layout.columns.values()}]
    found = {}
    for signal, name in sources(known, left, where=table.where).items():
        column = known.columns[signal]
        counts = Column(source=name, unit=column.unit, scale=column.scale, scale_unit=column.scale_unit)
        found[signal] = Column(source=name) if table.units[name] else counts
    if not found and not layout.columns:
        raise InputError(
            f"no column is called as in an export of {layout.profile}; there are {', '.join(table.units) or 'none'}",
            where=table.where,
            expected="one of " + ", ".join(names_of(known)),
            fix="leave the profile out, or map the columns under [recording.columns]",
        )
    return found


def assumed(table: Table, layout: Layout, mapping: Mapping[str, Column]) -> tuple[str, ...]:
    """What the profile takes for granted of the columns whose unit neither the file nor the map says."""
    known = profile(layout.profile).columns if layout.profile is not None else {}
    taken = {name: column.source for name, column in mapping.items() if name in known and name not in layout.columns}
    return tuple(
        f"{table.where}: {name} from '{plain(source, longest=40)}': {known[name].note}"
        for name, source in taken.items()
        if known[name].note and not table.units[source]
    )


def unused(table: Table, mapping: Mapping[str, Column]) -> tuple[str, ...]:
    """A note on the columns that are no signal, if there are any."""
    used = {table.same.get(column.source, column.source) for column in mapping.values()}
    extra = [plain(name, longest=40) for name in table.units if name not in used and name not in table.same]
    if not extra:
        return ()
    shown = ", ".join(extra[:8]) + (f" and {len(extra) - 8} more" if len(extra) > 8 else "")
    return (f"{table.where}: {NOT_USED}: {shown}",)


def refuse_without_units(table: Table, mapping: Mapping[str, Column]) -> None:
    """Raises InputError that names every column which does not say what its numbers are in, where several do not."""
    lacking = {
        name: column for name, column in mapping.items()
        if column.unit is None and column.source in table.units and not table.units[column.source]
    }  # fmt: skip
    if len(lacking) > 1:
        ordered = {name: lacking[name] for name in COLUMNS if name in lacking}
        si = {name: si_unit(COLUMNS[name], False) for name in ordered}
        written = ", ".join(f"'{c.source} [{si[n]}]'" for n, c in ordered.items())
        keys = ", ".join(f"columns.{n} = {{ source = '{c.source}', unit = '{si[n]}' }}" for n, c in ordered.items())
        raise InputError(
            f"columns {', '.join(repr(c.source) for c in ordered.values())} have no unit",
            where=table.where, expected="name [unit]",
            fix=f"write {written} or what their numbers are in, or add to [recording] in the model file: {keys}",
        )  # fmt: skip


def is_linear(table: Table, mapping: Mapping[str, Column]) -> bool:
    """Whether the recording is of a linear axis: the units of position or speed say so, or a force."""
    for name in ("position", "speed"):
        if name in mapping:
            where = f"{table.where}, column '{mapping[name].source}'"
            return units.has_dimension(
                _unit(table, name, mapping[name]), COLUMNS[name].linear_unit, where=where
            )
    return "force" in mapping


def in_si(table: Table, name: str, column: Column, *, linear: bool) -> Array:
    """The values (n,) of signal `name` in SI."""
    signal = COLUMNS[name]
    unit = _unit(table, name, column)
    scale = units.factor(unit, si_unit(signal, linear), where=f"{table.where}, column '{column.source}'")
    values: Array = table.columns[column.source] * (column.scale * scale)
    return values


def units_of(table: Table, mapping: Mapping[str, Column]) -> dict[str, str]:
    """The unit that the file has each signal in; none where the map makes another quantity of it (N of V)."""
    return {name: _unit(table, name, column) for name, column in mapping.items() if not column.scale_unit}


def _unit(table: Table, name: str, column: Column) -> str:
    if column.source not in table.units:
        near = closest(column.source, table.units)
        raise InputError(
            f"there is no column '{column.source}' (mapped to {name})",
            where=table.where,
            expected="one of " + ", ".join(table.units),
            fix=f"did you mean '{near}'?" if near else "correct [recording.columns]",
        )
    written = table.units[column.source]
    unit = column.unit if column.unit is not None else written
    where = f"{table.where}, column '{column.source}'"
    if unit and written and unit != written and not units.same(unit, written, where=where):
        raise InputError(
            f"the column is in [{written}], the map says '{unit}'",
            where=where,
            expected="the same unit in both",
            fix="leave the unit out of [recording.columns], or correct the header",
        )
    if not unit:
        raise no_unit(name, column.source, where=table.where)
    return units.product(unit, column.scale_unit)


def no_unit(signal: str, source: str, *, where: str) -> InputError:
    """The refusal of a column that does not say what its numbers are in: which unit that is, nobody can guess."""
    known = COLUMNS[signal]
    column = f"source = '{source}', " if source != signal else ""
    return InputError(
        f"column '{source}' has no unit",
        where=where,
        expected="name [unit]",
        fix=f"write '{source} [{si_unit(known, False)}]', '{source} [{known.example}]' or what its numbers are in, or "
        f"add to [recording] in the model file: columns.{signal} = {{ {column}unit = '{known.example}' }}",
    )
