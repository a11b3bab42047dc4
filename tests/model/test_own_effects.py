from __future__ import annotations

import contextlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rwn.errors import InputError
from rwn.model import formula as expression
from rwn.model.drives import axis
from rwn.model.files import read_model, write_model
from rwn.model.model import Model
from rwn.model.own_effects import OwnEffect, OwnParameter

NAMES = {"speed": "rad/s", "position": "rad", "current": "A", "k": "N m s^2", "a": "N m", "w0": "rad/s"}

VALUES = {"speed": -3.0, "position": 0.7, "current": 2.0, "k": 0.5, "a": 0.1, "w0": 20.0}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-k * speed * abs(speed)", 4.5),
        ("a * sin(14 * position)", 0.1 * np.sin(9.8)),
        ("2 ^ 3 ^ 2 - 1", 511.0),
        ("-2 ^ 2", -4.0),
        ("a / (1 + (speed / w0) ^ 2)", 0.1 / (1 + 0.0225)),
        ("max(a, 0) - min(a, 3) + sign(speed) * pi", -np.pi),
        ("1 - 2 - 3", -4.0),
        ("8 / 4 / 2", 1.0),
        ("+sqrt(exp(log(9)))", 3.0),
        ("tanh(atan(tan(cos(0) * 0.3)))", np.tanh(0.3)),
    ],
)
def test_value(text: str, value: float) -> None:
    read = expression.parse(text, NAMES, where="here")
    assert read.evaluate(VALUES) == pytest.approx(value)
    arrays = {name: np.full(5, x) for name, x in VALUES.items()}
    np.testing.assert_allclose(np.broadcast_to(read.evaluate(arrays), 5), value)


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("", "cannot read"),
        ("k *", "cannot read"),
        ("k * sped", "did you mean 'speed'"),
        ("sinn(speed)", "did you mean 'sin'"),
        ("sin(speed, 2)", "2 arguments"),
        ("sin()", "0 arguments"),
        ("__import__('os').system('ls')", "not allowed"),
        ("speed.real", "not allowed"),
        ("[speed][0]", "not allowed"),
        ("lambda: 1", "not allowed"),
        ("speed if speed else 1", "not allowed"),
        ("speed and k", "not allowed"),
        ("speed < 2", "not allowed"),
        ("'text'", "not allowed"),
        ("True", "not allowed"),
        ("1j", "not allowed"),
        ("1e400", "not allowed"),
        ("speed // 2", "not allowed"),
        ("~1", "not allowed"),
        ("sin(x=1)", "not allowed"),
        ("(x := 3)", "not allowed"),
        ("1" + "+1" * 2000, "at most"),
        ("(" * 300 + "1" + ")" * 300, "cannot read"),
        ("-" * 1900 + "1", "cannot read"),
    ],
)
def test_what_is_refused(text: str, match: str) -> None:
    with pytest.raises(InputError, match=match) as refused:
        expression.parse(text, NAMES, where="here")
    assert "\n" not in str(refused.value)


@pytest.mark.slow
@given(st.text(max_size=40))
def test_no_text_does_anything_but_parse_or_be_refused(text: str) -> None:
    with contextlib.suppress(InputError):
        assert expression.parse(text, NAMES, where="here").program


@pytest.mark.parametrize(
    ("text", "works"),
    [
        ("-k * (speed / w0) * a / k", True),
        ("a * sin(position)", True),
        ("a * tanh(speed / w0)", True),
        ("a + speed", False),
        ("a * sin(current)", False),
        ("a * speed", False),
        ("3", False),
    ],
)
def test_units(text: str, works: bool) -> None:
    read = expression.parse(text, NAMES, where="here")
    if works:
        expression.check_units(read, NAMES, "N m", where="here")
    else:
        with pytest.raises(InputError, match="do not work out"):
            expression.check_units(read, NAMES, "N m", where="here")


BRAKE = OwnEffect(
    name="eddy-brake",
    term="torque",
    equation="-2 * peak * (speed / corner) / (1 + (speed / corner)^2)",
    meaning="eddy currents in a disc: torque falls again at high speed",
    parameters=(
        OwnParameter(
            name="peak", unit="N m", lower=0, upper=0.5, start=0.01, strength=True, meaning="most torque"
        ),
        OwnParameter(name="corner", unit="rad/s", lower=1, upper=500, start=100),
    ),
)


def test_the_worked_example() -> None:
    at_corner = BRAKE.formula.evaluate({"peak": 0.2, "corner": 50.0, "speed": np.array([50.0, -50.0, 0.0])})
    np.testing.assert_allclose(at_corner, [-0.2, 0.2, 0.0])
    assert BRAKE.site == "torque"
    assert BRAKE.formula.names == ("peak", "speed", "corner")


@pytest.mark.parametrize(
    ("changes", "match"),
    [
        ({"name": "Eddy Brake"}, "small letters"),
        ({"term": "torqe"}, "did you mean 'torque'"),
        ({"term": "drop"}, "do not work out"),
        ({"equation": "-peak * sped"}, "did you mean 'speed'"),
        (
            {"parameters": (replace(BRAKE.parameters[0], start=0.6), BRAKE.parameters[1])},
            "peak starts at 0.6",
        ),
        (
            {"parameters": (replace(BRAKE.parameters[0], strength=False), BRAKE.parameters[1])},
            "strength = true",
        ),
        ({"parameters": (replace(BRAKE.parameters[0], unit="N furz"), BRAKE.parameters[1])}, "N furz"),
        ({"parameters": (replace(BRAKE.parameters[0], name="speed"),)}, "cannot be called 'speed'"),
        ({"drive": axis.LINEAR_AXIS}, "do not work out"),
    ],
)
def test_wrong_definitions(changes: dict[str, object], match: str) -> None:
    with pytest.raises(InputError, match=match):
        replace(BRAKE, **changes)  # type: ignore[arg-type]


TOML = """[motor]
kind = "axis"
inertia = 0.1
viscous_friction = 0.01
[own_effects.eddy-brake]
term = "torque"
equation = "-2 * peak * (speed / corner) / (1 + (speed / corner)^2)"
parameters.peak = { unit = "N m", lower = 0, upper = 0.5, start = 0.01, strength = true }
parameters.corner = { unit = "rad/s", lower = 1, upper = 500, start = 100 }
[effects.eddy-brake]
peak = 0.2
corner = "500 rpm"
"""


def _read(folder: Path, text: str) -> Model:
    (folder / "model.toml").write_text(text, encoding="utf-8")
    return read_model(folder / "model.toml")


def test_in_a_model_file(tmp_path: Path) -> None:
    model = _read(tmp_path, TOML)
    (effect,) = model.own_effects
    assert effect.drive is axis.AXIS
    assert model.effects["eddy-brake"]["corner"] == pytest.approx(52.36, rel=1e-4)
    write_model(model, tmp_path / "again.toml")
    assert read_model(tmp_path / "again.toml") == model


@pytest.mark.parametrize(
    ("old", "new", "match"),
    [
        ("term =", "trem =", "did you mean 'term'"),
        ("strength = true", "strenght = true", "did you mean 'strength'"),
        ("start = 100", 'start = "fast"', "own_effects"),
        ("eddy-brake]\nterm", "quadratic-drag]\nterm", "rename it"),
        ("lower = 1, upper = 500", "lower = 100, upper = 100", "52.3599 rad/s.*expected 100 rad/s, the constant"),
        ("(speed / corner)^2", "(speeed / corner)^2", "did you mean 'speed'"),
        (
            'kind = "axis"\ninertia = 0.1\nviscous_friction = 0.01',
            'kind = "lti"\norder = 2',
            "transfer function",
        ),
    ],
)
def test_slips_in_a_model_file(tmp_path: Path, old: str, new: str, match: str) -> None:
    assert old in TOML
    with pytest.raises(InputError, match=match) as refused:
        _read(tmp_path, TOML.replace(old, new, 1))
    assert "model.toml" in str(refused.value)
