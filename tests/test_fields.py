"""Another kind of value than a field is annotated with is refused in one line, naming the field."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
import pytest
from numpy.typing import NDArray

import rwn
from rwn.errors import InputError
from rwn.fields import check_fields
from rwn.recording.layout import Column, Layout

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Part:
    """Something that a field may hold."""


@dataclass(frozen=True, kw_only=True)
class Whole:
    """A field of every kind."""

    text: str = ""
    flag: bool = False
    count: int = 0
    number: float = 0.0
    maybe: float | None = None
    either: Literal["one", "two"] = "one"
    part: Part = field(default_factory=Part)
    pair: tuple[int, int] | None = None
    several: tuple[Part, ...] = ()
    numbers: Mapping[str, float] = field(default_factory=dict)
    tables: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    array: Array = field(default_factory=lambda: np.zeros(2))
    derived: int = field(default=0, init=False)


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"text": "x", "flag": np.bool_(True), "count": np.int64(3), "number": 3, "maybe": np.float32(1.0)},
        {"either": "two", "pair": [1, 2], "several": (Part(),), "numbers": {"a": 1}, "tables": {"a": {"b": 2.0}}},
        {"array": [1.0, 2.0]},
    ],
)
def test_what_the_annotation_allows(given: dict[str, Any]) -> None:
    check_fields(Whole(**given), where="here")


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"text": 5}, "text is 5; expected text"),
        ({"flag": "yes"}, "flag is 'yes'; expected true or false"),
        ({"count": 1.5}, "count is 1.5; expected a whole number"),
        ({"count": True}, "count is True; expected a whole number"),
        ({"number": "1"}, "number is '1'; expected a number"),
        ({"number": True}, "number is True; expected a number"),
        ({"maybe": "x"}, "maybe is 'x'; expected a number or None"),
        ({"either": "three"}, "either is 'three'; expected one of one, two"),
        ({"part": None}, "part is None; expected an object of Part"),
        ({"pair": (1,)}, "pair is (1,); expected 2 of a whole number or None"),
        ({"pair": (1, 2.5)}, "pair is (1, 2.5); expected 2 of a whole number or None"),
        ({"several": "x"}, "several is 'x'; expected a tuple, each of it an object of Part"),
        ({"several": (Part(), 1)}, "several[1] is 1; expected an object of Part"),
        ({"numbers": None}, "numbers is None; expected a dictionary, for each name a number"),
        ({"numbers": [1, 2]}, "numbers is [1, 2]; expected a dictionary"),
        ({"numbers": {1: 2.0}}, "a name in numbers is 1; expected text"),
        ({"numbers": {"a": "b"}}, "numbers['a'] is 'b'; expected a number"),
        ({"tables": {"a": 1.0}}, "tables['a'] is 1.0; expected a dictionary, for each name a number"),
        ({"tables": {"a": {2: 1.0}}}, "a name in tables['a'] is 2; expected text"),
    ],
)
def test_another_kind_of_value(given: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError) as refused:
        check_fields(Whole(**given), where="here")
    assert str(refused.value).startswith(f"here: {said}")
    assert f"fix: correct {said.split(' is ')[0]}" in str(refused.value)


def test_numbers_of_a_table_may_be_left_to_another_check() -> None:
    check_fields(Whole(numbers={"a": "b"}), where="here", numbers=False)  # type: ignore[dict-item]  # on purpose


TIME = np.arange(100) / 1000.0
SIGNALS = {"voltage": np.sin(TIME), "speed": np.cos(TIME)}
PARAMETERS = {"resistance": 1.0, "torque_constant": 0.04, "back_emf_constant": 0.04, "inertia": 1e-5}


@pytest.mark.parametrize(
    "given",
    [
        {"parameters": None}, {"parameters": [1, 2]}, {"parameters": {1: 2.0}}, {"uncertainty": None},
        {"effects": None}, {"effects": ["coulomb-friction"]}, {"effects": {"coulomb-friction": 1.0}}, {"load": "x"},
        {"own_effects": ("x",)}, {"recording": None}, {"source": 5}, {"linear": "yes"}, {"order": 1.5}, {"kind": 5},
    ],
)  # fmt: skip
def test_a_model_of_other_kinds(given: dict[str, Any]) -> None:
    with pytest.raises(InputError, match=next(iter(given))):
        rwn.Model(**{"kind": "dc", "parameters": PARAMETERS, **given})


@pytest.mark.parametrize(
    "given",
    [
        {"name": None}, {"signals": None}, {"signals": [1.0]}, {"signals": {1: TIME}}, {"source": 5}, {"linear": 1},
        {"warnings": "hello"}, {"applied_input": 5}, {"input_noise": "x"}, {"input_noise": -1.0},
        {"input_noise": np.nan}, {"units": {"speed": "foo"}}, {"units": {"speed": "V"}}, {"units": {"foo": "V"}},
        {"missing": {"foo": TIME > 1.0}}, {"missing": {"speed": TIME < 1.0}},
    ],
)  # fmt: skip
def test_a_recording_of_other_kinds(given: dict[str, Any]) -> None:
    with pytest.raises(InputError, match=next(iter(given))):
        rwn.Recording(**{"name": "x", "time": TIME, "signals": SIGNALS, **given})


def test_lists_of_several_lengths_are_no_signal() -> None:
    ragged: Any = [[1.0, 2.0], [1.0]]
    with pytest.raises(InputError, match="'speed' is no vector of real numbers"):
        rwn.Recording(name="x", time=TIME, signals={"speed": ragged})


@pytest.mark.parametrize(
    "given",
    [{"columns": {"speed": "w"}}, {"sample_time": "1 ms"}, {"delays": {"speed": None}}, {"initial": "moving"},
     {"decimate": 2.5}, {"speed_rows": (1,)}, {"start": "0"}],
)  # fmt: skip
def test_a_layout_of_other_kinds(given: dict[str, Any]) -> None:
    with pytest.raises(InputError, match=f"Layout: {next(iter(given))}"):
        Layout(**given)
    Layout(columns={"speed": Column(source="w")}, sample_time=0.001, delays={"speed": 0.001}, speed_rows=(1, 1))
