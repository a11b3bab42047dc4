"""Names for what is nested: `RawData.Velo` of a struct, `log(2).speed` of several, `M(:,3)` of a matrix, `log.Time`."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from rwn.recording.formats.frame import columns_of_frame, is_frame
from rwn.recording.formats.table import Table, table_of

_DEPTH = 8
_MOST = 200  # elements of a list of structs, columns of a matrix: what is longer is no table of signals


class Leaf(NamedTuple):
    """A named array and its unit (None: not said)."""

    name: str
    values: Any
    unit: str | None = None


def nested_table(where: str, content: Mapping[str, Any], names: Collection[str], wanted: Collection[str]) -> Table:
    """The `wanted` ones of all that is nested in `content`; `names`: all variables, of which some were not read.

    What is in the only variable of a file has its own name as well: `speed` for `log.speed`.
    """
    leaves = [leaf for name, value in content.items() for leaf in _leaves(name, value, _DEPTH)]
    same = {name.removesuffix("(:,1)"): name for name, _, _ in leaves if name.endswith("(:,1)")}
    if len(names) == 1 and content:
        alone = len(next(iter(content))) + 1
        inner = [leaf for leaf in leaves if leaf.name[alone - 1 : alone] == "."]
        leaves += [Leaf(n[alone:], values, unit) for n, values, unit in inner]
        same |= {leaf.name[alone:]: same.get(leaf.name, leaf.name) for leaf in inner}
    table = table_of(where, {leaf.name: leaf.values for leaf in leaves}, {n: u for n, _, u in leaves}, wanted)
    unread: dict[str, str | None] = dict.fromkeys(name for name in names if name not in content)
    return Table(where=where, columns=table.columns, units={**unread, **table.units}, same=same)


def roots(names: Iterable[str], wanted: Collection[str]) -> list[str]:
    """The variables of these that are wanted, or that something wanted may be nested in."""
    outer = {re.split(r"[.({]", name)[0] for name in wanted}
    return [name for name in names if name in wanted or name in outer]  # `wanted` knows more names than it lists


def _leaves(name: str, value: Any, depth: int) -> Iterator[Leaf]:
    properties = getattr(value, "properties", None)  # an object of a MATLAB class
    if depth == 0:
        return
    if is_frame(value):
        for column, array, unit in columns_of_frame(value):
            yield Leaf(f"{name}.{column}", array, unit)
    elif isinstance(properties, Mapping):
        for field, inner in properties.items():
            yield from _leaves(f"{name}.{field}", inner, depth - 1)
    elif isinstance(value, np.ndarray) and value.dtype.names is not None and not value.dtype.hasobject:
        yield from (Leaf(f"{name}.{field}", value[field]) for field in value.dtype.names)
    elif isinstance(value, np.ndarray) and value.dtype.names is not None:
        for k, element in enumerate(value.ravel()[:_MOST]):
            prefix = name if value.size == 1 else f"{name}({k + 1})"
            for field in value.dtype.names:
                yield from _leaves(f"{prefix}.{field}", element[field], depth - 1)
    elif isinstance(value, np.ndarray) and value.dtype == object:
        for k, element in enumerate(value.ravel()[:_MOST]):
            yield from _leaves(name if value.size == 1 else f"{name}{{{k + 1}}}", element, depth - 1)
    else:
        yield Leaf(name, value)
        array = np.asarray(value)
        if array.ndim == 2 and min(array.shape) > 1 and array.shape[1] <= _MOST:
            for k in range(array.shape[1]):
                yield Leaf(f"{name}(:,{k + 1})", array[:, k])
