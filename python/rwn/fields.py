"""What a field of a dataclass may hold, by its annotation: another kind of value is refused when it is made.

Arrays are left to whoever knows their shapes.
"""

from __future__ import annotations

import types
from collections.abc import Mapping, Sequence
from dataclasses import fields
from functools import cache
from numbers import Integral, Real
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

import numpy as np

from rwn.errors import InputError, plain

_SAID = {
    str: "text", bool: "true or false", int: "a whole number", float: "a number",
    Mapping: "a dictionary", np.ndarray: "an array", type(None): "None",
}  # fmt: skip
_LONGEST = 40  # characters of a value in a message


def check_fields(made: Any, *, where: str, numbers: bool = True) -> None:
    """Every field of the dataclass `made` holds what its annotation says. Raises InputError.

    `numbers`: those in dictionaries too.
    """
    for name, kind in _kinds(made.__class__).items():
        _check(name, getattr(made, name), kind, where, numbers)


@cache
def _kinds(of: Any) -> dict[str, Any]:
    hints = get_type_hints(of)
    return {field.name: hints[field.name] for field in fields(of) if field.init}


def _check(name: str, value: Any, kind: Any, where: str, numbers: bool) -> None:
    if not _is(value, kind):
        raise InputError(
            f"{name} is {plain(repr(value), longest=_LONGEST)}", where=where, expected=_said(kind),
            fix=f"correct {name}",
        )  # fmt: skip
    inner = get_args(kind)
    if isinstance(value, Mapping) and get_origin(kind) is Mapping:
        for key, held in value.items():
            _check(f"a name in {name}", key, inner[0], where, numbers)
            if numbers or inner[1] is not float:
                _check(f"{name}[{plain(repr(key), longest=_LONGEST)}]", held, inner[1], where, numbers)
    elif isinstance(value, tuple) and len(inner) == 2 and inner[1] is Ellipsis:
        for k, held in enumerate(value):
            _check(f"{name}[{k}]", held, inner[0], where, numbers)


def _is(value: Any, kind: Any) -> bool:
    """Whether a value is of a kind, not looking into what it holds."""
    origin = get_origin(kind)
    if origin in (Union, types.UnionType):
        return any(_is(value, one) for one in get_args(kind))
    if origin is Literal:
        return value in get_args(kind)
    if origin is tuple and Ellipsis not in get_args(kind):
        parts = get_args(kind)
        return isinstance(value, Sequence) and len(value) == len(parts) and all(map(_is, value, parts))
    if kind in (int, float):
        return isinstance(value, Integral if kind is int else Real) and not isinstance(value, bool | np.bool_)
    if kind is bool:
        return isinstance(value, bool | np.bool_)
    kind = origin or kind
    return kind in (Any, np.ndarray) or not isinstance(kind, type) or isinstance(value, kind)


def _said(kind: Any) -> str:
    origin, inner = get_origin(kind), get_args(kind)
    if origin in (Union, types.UnionType):
        return " or ".join(_said(one) for one in inner)
    if origin is Literal:
        return "one of " + ", ".join(map(str, inner))
    if origin is tuple:
        return f"a tuple, each of it {_said(inner[0])}" if Ellipsis in inner else f"{len(inner)} of {_said(inner[0])}"
    if origin is Mapping:
        return f"a dictionary, for each name {_said(inner[1])}"
    kind = origin or kind
    return _SAID.get(kind) or f"an object of {getattr(kind, '__name__', kind)}"
