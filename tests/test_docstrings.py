"""Docstrings: there, with the shapes of arrays and with what is raised; of what `import rwn` gives with units too.

The studies are left out, which nothing imports, and the command line, whose docstrings are its help.
"""

from __future__ import annotations

import dataclasses
import importlib
import inspect
import pkgutil
import re
import textwrap
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import rwn

WORDS = (  # of dimensions, beside single letters and numbers
    "all", "columns", "count", "cycles", "groups", "inputs", "iterations", "n_parameters", "n_t", "order", "outputs",
    "parameters", "patterns", "wavelets",
)  # fmt: skip
DIMENSION = rf"(?:\d+ \+ )?(?:\d+ )?(?:\d+|[A-Za-z]|{'|'.join(WORDS)})(?: \+ \d+)?"  # n, cycles + 1, 5 + 4 wavelets
SHAPE = (
    rf"\({DIMENSION}(?:,|(?:, {DIMENSION})+)\)|elementwise|as `(?:parameters|theta)`|order of `parameters`"
)
UNITS = {"voltage": "[V]", "speed": "[rad/s]", "current": "[A]", "torque": "[N m]", "time": "[s]", "sample_time": "[s]"}
ARRAY = re.compile(r"\b(ArrayLike|Array|NDArray)\b")


def public() -> Iterator[tuple[str, Any, str]]:
    """Name, object and the docstring of its class, of all that is exported and their public methods."""
    for name, thing in vars(rwn).items():
        if name.startswith("_") or inspect.ismodule(thing) or not getattr(thing, "__module__", "").startswith("rwn"):
            continue
        yield name, thing, ""
        if inspect.isclass(thing):
            for member, value in vars(thing).items():
                function = value.fget if isinstance(value, property) else getattr(value, "__func__", value)
                if not member.startswith("_") and inspect.isfunction(function):
                    yield f"{name}.{member}", function, inspect.getdoc(thing) or ""


THINGS = list(public())
LEFT_OUT = ("rwn.studies", "rwn.reference", "rwn.cli", "rwn.__main__")


def of_modules() -> Iterator[tuple[str, Any, str]]:
    """The same of every module, whatever is not private there."""
    for module in pkgutil.walk_packages(rwn.__path__, "rwn."):
        if module.name.startswith(LEFT_OUT) or "._" in module.name:
            continue
        for name, thing in vars(importlib.import_module(module.name)).items():
            own = getattr(thing, "__module__", "") == module.name and not name.startswith("_")
            if not own or not (inspect.isclass(thing) or inspect.isfunction(thing)):
                continue
            yield f"{module.name}.{name}", thing, ""
            for member, value in vars(thing).items() if inspect.isclass(thing) else ():
                function = value.fget if isinstance(value, property) else getattr(value, "__func__", value)
                if not member.startswith("_") and inspect.isfunction(function) and function.__name__ != "<lambda>":
                    yield f"{module.name}.{name}.{member}", function, inspect.getdoc(thing) or ""


MODULES = {name: (thing, of_class) for name, thing, of_class in of_modules()}


@pytest.mark.parametrize(("name", "thing", "of_class"), THINGS, ids=[name for name, _, _ in THINGS])
def test_a_docstring_says_what_is_needed(name: str, thing: Any, of_class: str) -> None:
    own = inspect.getdoc(thing) or ""
    assert own, f"{name} has no docstring"
    for array, annotation in arrays(thing):
        text = own if array == "return" else f"{own}\n{of_class}"
        assert array == "return" or re.search(rf"\b{array}\b", text), f"{name} does not say what '{array}' is"
        assert re.search(SHAPE, text), f"{name} gives no shape for '{array}' ({annotation})"
        if array in UNITS:
            assert UNITS[array] in text, f"{name} gives no unit for '{array}': expected {UNITS[array]}"
    unnamed = [given for given in names(thing) if not re.search(rf"\b{given}\b", f"{own}\n{of_class}")]
    assert not unnamed, f"{name} does not say what these are: {', '.join(unnamed)}"
    if "raise " in checks(thing):
        assert re.search(r"\b[Rr]aises\b", own), f"{name} does not say what it raises"


def test_the_modules_are_looked_at() -> None:
    assert len(MODULES) > 500
    assert "rwn.fit.fit.refit" in MODULES
    assert "rwn.name.starts.FittedStart.cost" in MODULES


@pytest.mark.parametrize("text", ["(n,)", "(n, p)", "(2, 2)", "(5 + 4 wavelets,)", "(cycles + 1, 5)", "(n_t, n)"])
def test_a_shape_is_one(text: str) -> None:
    assert re.fullmatch(SHAPE, text)


@pytest.mark.parametrize(
    "text", ["(after Politis, White 2004)", "(error, driving force)", "(centre, dilation)", "(a, then held)", "(n)"]
)
def test_prose_in_brackets_is_no_shape(text: str) -> None:
    assert not re.search(SHAPE, text)


@pytest.mark.parametrize("name", MODULES)
def test_a_docstring_of_a_module_says_what_is_needed(name: str) -> None:
    thing, of_class = MODULES[name]
    own = inspect.getdoc(thing) or ""
    assert own, f"{name} has no docstring"
    if inspect.isfunction(thing) and any(True for _ in arrays(thing)):
        assert re.search(SHAPE, f"{own}\n{of_class}"), f"{name} gives no shape of its arrays"
    if "raise " in checks(thing):
        assert re.search(r"\b[Rr]aises\b", own), f"{name} does not say what it raises"


def names(thing: Any) -> list[str]:
    """The arguments of a function or of the making of an object, and its fields."""
    fields = [field.name for field in dataclasses.fields(thing)] if dataclasses.is_dataclass(thing) else []
    made = thing.__init__ if inspect.isclass(thing) and not fields else thing
    arguments = [] if fields else [p for p in inspect.signature(made).parameters if p not in ("self", "cls")]
    return [name for name in fields + arguments if not name.startswith("_")]


def test_arguments_and_fields_are_looked_at() -> None:
    assert names(rwn.InputError) == ["what", "where", "expected", "fix"]
    assert names(rwn.MotorParameters)[0] == "resistance"
    assert names(rwn.Diagnosis.save) == ["folder", "overwrite"]
    assert sum(len(names(thing)) for _, thing, _ in THINGS) > 190


def arrays(thing: Any) -> Iterator[tuple[str, str]]:
    """Arguments, fields and 'return' that are arrays, each with its annotation."""
    if dataclasses.is_dataclass(thing):
        told = {field.name: str(field.type) for field in dataclasses.fields(thing)}
    elif inspect.isfunction(thing):
        told = {name: str(kind) for name, kind in thing.__annotations__.items()}
    else:
        told = {}
    yield from ((name, kind) for name, kind in told.items() if ARRAY.search(kind))


def checks(thing: Any) -> str:
    """The source in which a function, or the making of an object, refuses its input."""
    made: Callable[..., Any] | None = vars(thing).get("__post_init__") if inspect.isclass(thing) else thing
    return textwrap.dedent(inspect.getsource(made)) if made else ""
