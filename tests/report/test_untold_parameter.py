"""A parameter whose interval is that of the data sheet: the recordings do not tell it, and the report says so."""

from __future__ import annotations

from dataclasses import replace

import pytest

import made_up
from rwn.fit.intervals import Estimate
from rwn.report.nominal_fit import FittedParameter
from rwn.report.page import page


@pytest.mark.parametrize(("half", "untold"), [(0.196, True), (0.19, True), (0.18, False), (0.01, False)])
def test_a_tenth_of_what_is_known_has_to_be_the_recordings(half: float, untold: bool) -> None:
    fitted = Estimate(value=2.0, unit="ohm", interval=(2.0 * (1.0 - half), 2.0 * (1.0 + half)))
    assert FittedParameter(nominal=2.0, uncertainty=0.1, refitted=fitted).only_declared(fitted) is untold
    assert not FittedParameter(nominal=2.0, uncertainty=0.0, refitted=fitted).only_declared(fitted)


def test_what_was_moved_beyond_belief_is_told_however_wide_its_interval_is() -> None:
    moved = Estimate(value=8.0, unit="mH", interval=(1.5, 8.2))
    assert not FittedParameter(nominal=2.0, uncertainty=0.1, refitted=moved, corrected=moved).only_declared(moved)


def test_the_report_says_it_beside_the_parameter() -> None:
    one = made_up.found()
    inertia = one.nominal_fit.parameters["inertia"]
    wide = Estimate(value=3.2e-4, unit="kg m^2", interval=(3.2e-4 * (1.0 - 0.235), 3.2e-4 * (1.0 + 0.235)))
    untold = {**one.nominal_fit.parameters, "inertia": replace(inertia, uncertainty=0.12, corrected=wide)}
    said = "the recordings hardly tell it"
    other = replace(one, nominal_fit=replace(one.nominal_fit, parameters=untold))
    assert page(other).count(said) == page(one).count(said) + 1
