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
