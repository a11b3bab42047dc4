"""Fields of Apache Arrow, of Parquet files and of tables in Python."""

from __future__ import annotations

from typing import Any


def unit_of_field(field: Any) -> str | None:
    """The unit in a field's metadata (`unit` or `units`); None where none is said."""
    for key in (b"unit", b"units"):
        if key in (field.metadata or {}):
            return str(field.metadata[key].decode("utf-8", "replace"))
    return None
