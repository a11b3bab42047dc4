"""Levenberg-Marquardt on a small problem of its own."""

from __future__ import annotations

from collections import Counter

import numpy as np
from numpy.typing import NDArray

from rwn.fit.levenberg_marquardt import DAMPING, FitStatus, Minimum, minimise
from rwn.fit.unknown import Unknown
from rwn.simulate.simulator import NormalEquations

UNKNOWNS = tuple(Unknown(name=name, unit="", index=k, lower=-5.0, upper=5.0) for k, name in enumerate("xy"))


def _rosenbrock(values: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Error and its derivatives; a bent valley, on whose way many steps are not taken."""
    x, y = values
    return np.array([-(1.0 - x), -10.0 * (y - x * x)]), np.array([[-1.0, 0.0], [-20.0 * x, 10.0]])


def _found(*, probed: bool, doubt: int = 1, most: int = 60, roughly: bool = False) -> tuple[Minimum, Counter[str]]:
    calls: Counter[str] = Counter()

    def evaluate(values: NDArray[np.float64]) -> NormalEquations:
        calls["evaluate"] += 1
        error, slopes = _rosenbrock(values)
        return NormalEquations(chi2=float(error @ error), gradient=slopes.T @ error, curvature=slopes.T @ slopes)

    def probe(values: NDArray[np.float64]) -> NormalEquations:
        calls["probe"] += 1
        error, _ = _rosenbrock(values)
        return NormalEquations(chi2=float(error @ error), gradient=np.empty(0), curvature=np.empty((0, 0)))

    start = np.array([-1.9, 2.0])
    found = minimise(
        evaluate, start, UNKNOWNS, tolerance=1e-12, probe=probe if probed else None, doubt=doubt, max_iterations=most,
        roughly=roughly,
    )  # fmt: skip
    return found, calls


def test_the_minimum_is_found() -> None:
    found, _ = _found(probed=False)
    assert found.status is FitStatus.CONVERGED
    np.testing.assert_allclose(found.values, [1.0, 1.0], atol=1e-5)
    assert found.cost < 1e-9 < found.first


def test_a_probe_saves_derivatives_and_changes_no_step() -> None:
    plain, without = _found(probed=False)
    taken = []
    for doubt in (1, 0):
        found, calls = _found(probed=True, doubt=doubt)
        np.testing.assert_array_equal(found.values, plain.values)
        assert found.iterations == plain.iterations
        assert calls["evaluate"] < without["evaluate"]
        taken.append(calls["evaluate"])
    assert taken[1] <= taken[0]  # with every step in doubt derivatives are made of those that are taken, and no others


def test_a_rough_end_saves_the_last_derivatives_and_is_the_same_place() -> None:
    for most in (1, 3):
        plain, needed = _found(probed=True, most=most)
        rough, calls = _found(probed=True, most=most, roughly=True)
        np.testing.assert_array_equal(rough.values, plain.values)
        assert (rough.cost, rough.chi2, rough.iterations) == (plain.cost, plain.chi2, plain.iterations)
        assert calls["evaluate"] <= needed["evaluate"]
    assert _found(probed=True, most=1, roughly=True)[1]["evaluate"] == 1


def test_what_priors_alone_decide_is_found_too() -> None:
    """Of two unknowns the product is known 10 000 times as well as the ratio: damping must not hold that back."""
    strength = 1e5  # of the product

    def evaluate(values: NDArray[np.float64]) -> NormalEquations:
        error = strength * (6.0 - values[0] * values[1])
        slopes = strength * values[::-1]
        return NormalEquations(chi2=error**2, gradient=slopes * error, curvature=np.outer(slopes, slopes))

    unknowns = tuple(
        Unknown(name=n, unit="", index=k, lower=1e-3, upper=1e3, logarithmic=True, tied_to=other, tie_std=0.02)
        for k, (n, other) in enumerate((("a", ""), ("b", "a")))
    )
    found = minimise(evaluate, np.array([2.3, 6.0 / 2.3]), unknowns)
    assert found.status is FitStatus.CONVERGED
    np.testing.assert_allclose(found.values, np.sqrt(6.0), rtol=2e-3)


def test_a_fit_in_legs_need_not_try_again_what_was_refused() -> None:
    """From 3 the undamped step towards the root of the arctangent leads farther off."""
    unknown = (Unknown(name="x", unit="", index=0, lower=-20.0, upper=20.0),)

    def evaluate(values: NDArray[np.float64]) -> NormalEquations:
        error, slope = np.arctan(values), -1.0 / (1.0 + values**2)
        return NormalEquations(chi2=float(error @ error), gradient=slope * error, curvature=np.outer(slope, slope))

    def in_legs(*, kept: bool) -> float:
        values, damping = np.array([3.0]), DAMPING
        for _ in range(30):
            leg = minimise(evaluate, values, unknown, max_iterations=1, tolerance=1e-6, damping=damping)
            values, damping = leg.values, max(leg.damping, DAMPING) if kept else DAMPING
        return float(values[0])

    assert in_legs(kept=False) == 3.0
    assert abs(in_legs(kept=True)) < 1e-3
