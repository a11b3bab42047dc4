"""The stack machine that runs users' formulas in the core, against NumPy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from made_up_motor import own
from rwn import _core
from rwn.errors import InputError
from rwn.model import formula as expression
from rwn.model.own_effects import TERMS, VARIABLES, OwnEffect
from rwn.model.vocabulary import motor_parameters

LEAVES = st.sampled_from(["x", "y", "speed", "current", "pi"]) | st.floats(-3, 3).map(lambda v: f"({v!r})")


def _grown(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    unary = st.sampled_from([name for name, (count, _) in expression.FUNCTIONS.items() if count == 1])
    return (
        st.builds("({} {} {})".format, inner, st.sampled_from("+-*/^"), inner)
        | st.builds("{}({})".format, unary, inner)
        | st.builds("{}({}, {})".format, st.sampled_from(["min", "max"]), inner, inner)
        | st.builds("(-{})".format, inner)
    )


FORMULAS = st.recursive(LEAVES, _grown, max_leaves=12)
NUMBERS = st.floats(-3, 3).filter(lambda v: abs(v) > 1e-3)


def _run(effect: OwnEffect, values: dict[str, float]) -> tuple[float, list[float]]:
    variables = [values.get(name, 0.0) for name in VARIABLES]
    parameters = [values[p.name] for p in effect.parameters]
    padded = parameters + [0.0] * (_core.max_own_parameters - len(parameters))
    value, slopes = effect.core.evaluate(variables, [0.0] * len(motor_parameters()), padded)
    return value, slopes[: len(parameters)]


# the same formulas every time: libraries may differ in the last digit, and a formula can make that as large as it likes
@pytest.mark.slow
@settings(derandomize=True, max_examples=400, deadline=None)
@given(text=FORMULAS, numbers=st.lists(NUMBERS, min_size=4, max_size=4))
def test_the_core_computes_what_numpy_does(text: str, numbers: list[float]) -> None:
    values = dict(zip(("x", "y", "speed", "current"), numbers, strict=True))
    names = {"x": "1", "y": "1", "speed": "1", "current": "1"}
    formula = expression.parse(text, names, where="here")
    effect = _without_units(text)
    with np.errstate(all="ignore"):
        want = float(formula.evaluate({k: np.float64(v) for k, v in values.items()}))
    got, _ = _run(effect, values)
    if np.isfinite(want):
        assert got == pytest.approx(want, rel=1e-9, abs=1e-12)
    else:
        assert not np.isfinite(got) or abs(got) > 1e250


def _without_units(text: str) -> OwnEffect:
    """The formula with units that always work out: what is tested is the arithmetic."""
    effect = own("resistance", "x + y", x="1", y="1")
    names = dict.fromkeys(("x", "y", "speed", "current"), "1")
    vars(effect)["formula"] = expression.parse(text, names, where="here")
    return effect


# sums of wavelets, which the core takes at once: over a variable and over sines of it, weights numbers and parameters
NETWORK = (
    "x * mexican_hat((speed / 4 + 0.3) / 0.4) - 2 * y * mexican_hat((0.2 - speed) / 1.7) + mexican_hat(speed) / 3 "
    "- x * mexican_hat(sin(0.5 * speed - 0.3) / 0.7) + 0.4 * mexican_hat(sin(2 - 0.5 * speed) / 0.7)"
)


def test_sums_of_wavelets_against_numpy() -> None:
    effect = _without_units(NETWORK)
    for speed in np.linspace(-12.0, 12.0, 101):
        values = {"x": 1.3, "y": -0.7, "speed": float(speed)}
        assert _run(effect, values)[0] == pytest.approx(float(effect.formula.evaluate(values)), rel=1e-13, abs=1e-15)


@pytest.mark.parametrize(
    "text",
    ["x * speed * abs(y)", "x ^ y", "y ^ x ^ 0.5", "tan(x) + atan(y * x)", "min(x, y) * max(x, 2 * y)", "x / y - y / x",
     "mexican_hat(x * y - 0.4)", NETWORK, f"y * ({NETWORK}) - x * speed",
     "sqrt(x) * log(y)", "exp(-(x / y)^2) + tanh(x - y)", "sign(x) * x + sin(y) * cos(x)"],
)  # fmt: skip
def test_slopes_against_central_differences(text: str) -> None:
    effect = _without_units(text)
    values = {"x": 1.3, "y": 0.7, "speed": -2.0}
    _, slopes = _run(effect, values)
    for name, slope in zip(("x", "y"), slopes, strict=True):
        high, low = (_run(effect, {**values, name: values[name] + h})[0] for h in (1e-6, -1e-6))
        assert slope == pytest.approx((high - low) / 2e-6, rel=1e-7, abs=1e-9)


def test_python_and_core_use_the_same_words() -> None:
    words = _core.formula_words()
    assert words["variables"] == list(VARIABLES)
    assert words["terms"] == list(TERMS)
    assert set(expression.FUNCTIONS) < set(words["operations"])


def test_formulas_that_the_core_has_no_room_for_are_refused() -> None:
    with pytest.raises(InputError, match="values at once"):
        own("resistance", "x + (" * 40 + "x" + ")" * 40, x="1")
    with pytest.raises(InputError, match="9 parameters"):
        own("resistance", "x0", **{f"x{k}": "1" for k in range(9)})


def _refused(text: str, names: dict[str, str]) -> InputError:
    with pytest.raises(InputError) as refused:
        expression.parse(text, names, where="here")
    assert refused.value.where == "here"
    return refused.value


def test_a_formula_is_as_long_as_it_may_be() -> None:
    longest = "x" + " " * (expression.MAX_LENGTH - 2) + "1"
    assert "cannot read the formula 'x   " in _refused(longest, {"x": "1"}).what
    assert expression.parse("x".ljust(expression.MAX_LENGTH), {"x": "1"}, where="here").names == ("x",)
    said = _refused("x".ljust(expression.MAX_LENGTH + 1), {"x": "1"})
    assert (said.what, said.expected) == ("the formula has 2001 characters", "at most 2000")


def test_a_formula_holds_as_many_values_as_the_core_has_room_for() -> None:
    most = _core.formula_depth
    nested = "x + (" * (most - 1) + "x" + ")" * (most - 1)
    assert expression.parse(nested, {"x": "1"}, where="here").evaluate({"x": 2.0}) == 2.0 * most
    said = _refused(f"x + ({nested})", {"x": "1"})
    assert said.what == f"the formula holds {most + 1} values at once"
    assert said.expected == f"at most {most}"
    calls = "max(x, " * (most - 1) + "x" + ")" * (most - 1)
    assert expression.parse(calls, {"x": "1"}, where="here").evaluate({"x": 2.0}) == 2.0
    said = _refused("-x + (" * most + "x" + ")" * most, {"x": "1"})
    assert said.what == f"the formula holds {most + 1} values at once", "a sign takes no room and makes none"
    flat = "sin(-x) + " * 3 * most + "x"  # each is added before the next
    expression.parse(flat, {"x": "1"}, where="here")


@pytest.mark.parametrize(
    ("text", "value"),
    [("+x", 3.0), ("-x", -3.0), ("--x", 3.0), ("2 ^ 3 ^ 2", 512.0), ("-x ^ 2", -9.0), ("x - 1 - 1", 1.0),
     ("12 / x / 2", 2.0), ("min(x, 2)", 2.0), ("max(x, 2)", 3.0), ("x * -2", -6.0), ("pi", np.pi), ("1e3", 1e3),
     (" x ", 3.0), ("mexican_hat(0)", 1.0), ("mexican_hat(1)", 0.0)],
)  # fmt: skip
def test_what_a_formula_says_is_what_it_is(text: str, value: float) -> None:
    assert expression.parse(text, {"x": "1"}, where="here").evaluate({"x": 3.0}) == pytest.approx(value)


def test_names_are_those_that_are_used_in_the_order_of_their_first_use() -> None:
    read = expression.parse("y * sin(x) + y ^ 2 - pi", {"x": "1", "y": "1", "z": "1"}, where="here")
    assert (read.names, read.text) == (("y", "x"), "y * sin(x) + y ^ 2 - pi")


@pytest.mark.parametrize(
    ("text", "what", "fix"),
    [
        ("x +", "cannot read the formula 'x +'", "see docs/own_effects.md"),
        ("x if x else 2", "'x if x else 2' is not allowed in a formula", "see docs/own_effects.md"),
        ("x % 2", "'x % 2' is not allowed in a formula", "see docs/own_effects.md"),
        ("~x", "'~x' is not allowed in a formula", "see docs/own_effects.md"),
        ("not x", "'not x' is not allowed in a formula", "see docs/own_effects.md"),
        ("True", "'True' is not allowed in a formula", "see docs/own_effects.md"),
        ("1e300", "'1e+300' is not allowed in a formula", "see docs/own_effects.md"),
        ("'a'", "''a'' is not allowed in a formula", "see docs/own_effects.md"),
        ("max(x, y=2)", "'max(x, y=2)' is not allowed in a formula", "did you mean 'max'?"),
        ("x.real", "'x.real' is not allowed in a formula", "see docs/own_effects.md"),
        ("z", "unknown name 'z'", "remove or rename 'z'"),
        ("sinn(x)", "unknown function 'sinn'", "did you mean 'sin'?"),
        ("sin(x, x)", "sin has 2 arguments", "see docs/own_effects.md"),
        ("min(x)", "min has 1 arguments", "see docs/own_effects.md"),
    ],
)
def test_what_is_no_formula_is_refused_with_its_remedy(text: str, what: str, fix: str) -> None:
    said = _refused(text, {"x": "1"})
    if "max(" not in text:
        assert (said.what, said.fix) == (what, fix)
    assert said.what == what


def test_a_long_piece_that_is_not_allowed_is_cut_where_it_is_shown() -> None:
    assert _refused(f"[{'x, ' * 50}x]", {"x": "1"}).what == f"'[{'x, ' * 19}x,' is not allowed in a formula"
    assert _refused("x " * 60, {"x": "1"}).what == f"cannot read the formula '{'x ' * 40}'"


def test_units_work_out_or_the_line_says_which_clash() -> None:
    names = {"speed": "rad/s", "k": "N m s/rad", "t": "N m"}
    read = expression.parse("k * speed + t", names, where="here")
    expression.check_units(read, names, "N m", where="here")
    for text, unit, clash in (
        ("k + t", "N m", "N m s/rad is not N m"), ("k * speed", "V", "N m is not V"),
        ("sin(t)", "1", "N m is not rad"), ("t + 1", "N m", "N m is not a plain number"),
    ):  # fmt: skip
        with pytest.raises(InputError) as refused:
            expression.check_units(expression.parse(text, names, where="here"), names, unit, where="here")
        assert refused.value.what == f"the units of '{text}' do not work out ({clash})"
        assert (refused.value.where, refused.value.expected) == ("here", f"a formula in {unit}")
    long = expression.parse("t + " * 30 + "speed", names, where="here")
    with pytest.raises(InputError, match=rf"the units of '{'t . ' * 20}' do not work out"):
        expression.check_units(long, names, "N m", where="here")
