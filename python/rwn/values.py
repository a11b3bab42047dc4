"""Frozen dataclasses that hold arrays and read-only mappings: compared by content, copied and pickled."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from html import escape
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np


class Values:
    """For a dataclass with `eq=False`: equal where every field is; it has no hash."""

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(same(mine, getattr(other, name)) for name, mine in _contents(self).items())

    __hash__ = None  # type: ignore[assignment]  # arrays have none

    def __reduce__(self) -> tuple[Any, ...]:
        """For pickle and copy, which know nothing of read-only mappings."""
        return _made, (type(self), {name: _plain(value) for name, value in _contents(self).items()})

    def _repr_html_(self) -> str:
        """For notebooks."""
        return f"<code>{escape(repr(self))}</code>"


SHOWN_BY: dict[str, Callable[..., Any]] = {}  # method -> what does it; the report, above all that it shows, fills it in


class Shown:
    """What `rwn.plot` and `rwn.save` do, as methods."""

    def plot(self, *others: Any, **options: Any) -> Any:
        """Its figure (plotly), as `rwn.plot` draws it: a recording over time, also beside `others`, models.

        A model is drawn over a recording that is passed, the result of `identify` over its own.

        Raises InputError as `rwn.plot` does.
        """
        return SHOWN_BY["plot"](self, *others, **options)

    def save(self, path: str | Path, *, overwrite: bool = False) -> None:
        """Writes it to the file `path`, as `rwn.save` does. Raises InputError and NoResultError as that does."""
        SHOWN_BY["save"](self, path, overwrite=overwrite)


def same(one: Any, other: Any) -> bool:
    """Whether two values are equal, arrays and what is in mappings by their content."""
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(same(value, other[key]) for key, value in one.items())
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return type(one) is type(other) and np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
    return bool(one == other)


def table_of_rows(rows: list[dict[str, Any]], columns: Sequence[str]) -> Any:
    """The rows as a pandas.DataFrame; as they are where pandas is not installed."""
    try:
        import pandas as pd
    except ModuleNotFoundError:
        return rows
    return pd.DataFrame(rows, columns=list(columns))


def table_of_columns(columns: Mapping[str, Any]) -> Any:
    """Arrays as a pandas.DataFrame; as a dictionary where pandas is not installed."""
    try:
        import pandas as pd
    except ModuleNotFoundError:
        return dict(columns)
    return pd.DataFrame(dict(columns))


def _contents(of: Any) -> dict[str, Any]:
    return {field.name: getattr(of, field.name) for field in fields(of)}


def _plain(value: Any) -> Any:
    return dict(value) if isinstance(value, MappingProxyType) else value


def _made(kind: type[Any], contents: dict[str, Any]) -> Any:
    return kind(**contents)
