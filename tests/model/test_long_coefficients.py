"""Coefficients of a transfer function that no float holds."""

from __future__ import annotations

import pytest

from rwn.errors import InputError
from rwn.model.toml_reader import parse_model


@pytest.mark.parametrize("key", ["numerator", "denominator"])
def test_an_integer_of_401_digits_is_refused_in_one_line(key: str) -> None:
    lists = {"numerator": "[1.0]", "denominator": "[1.0, 20.0]"} | {key: f"[{'9' * 401}, 1]"}
    text = '[motor]\nkind = "lti"\n' + "".join(f"{name} = {values}\n" for name, values in lists.items())
    with pytest.raises(InputError, match=rf"{key} is \[9+ \.\.; expected a list of numbers") as said:
        parse_model(text, where="motor.toml")
    assert len(str(said.value)) < 300


def test_coefficients_whose_ratio_is_no_number_are_refused() -> None:
    with pytest.raises(InputError, match="the denominator begins with 1e-300"):
        parse_model('[motor]\nkind = "lti"\nnumerator = [1e300]\ndenominator = [1e-300, 1.0]\n', where="motor.toml")


def test_a_number_that_no_integer_holds_is_refused_by_its_key() -> None:
    text = '[motor]\nkind = "dc"\n[uncertainty]\nresistance = ' + "9" * 401
    with pytest.raises(InputError, match=r"motor\.toml, \[uncertainty\] resistance: the number is too large"):
        parse_model(text, where="motor.toml")
