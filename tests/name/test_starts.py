"""Starts that race for the same end."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest

import rwn
from rwn.fit.hypothesis import candidate
from rwn.fit.levenberg_marquardt import FitStatus, Minimum
from rwn.fit.preparation import prepare
from rwn.name.starts import (
    PHASES,
    SIGHTED,
    Racer,
    Row,
    apart,
    best_of_each,
    misleads,
    worth_an_iteration,
)

DEMO = Path(rwn.__file__).parent / "demo"
SAMPLES = 100
BEST = (1.0, 2.0)


def _row(name: str, values: tuple[float, float], cost: float, order: float = 0.0) -> Row:
    information = np.diag([1e4, 1.0])
    m = Minimum(
        values=np.array(values), chi2=cost, cost=cost, first=2.0 * cost, information=information,
        data_information=information, status=FitStatus.CONVERGED, iterations=3,
    )  # fmt: skip
    return Racer(name, order, 0, cast(Any, None)), m


@pytest.mark.parametrize(
    ("other", "kept"),
    [
        (("drag", (1.0001, 2.5), 100.3), 1),
        (("drag", (1.1, 2.0), 100.3), 2),  # as good, elsewhere
        (("drag", (1.0001, 2.5), 105.0), 2),  # near, and not yet as good
        (("lag", BEST, 100.0), 2),
    ],
    ids=["met", "another minimum", "under way", "another effect"],
)
def test_of_starts_that_have_met_the_better_goes_on(other: tuple[str, tuple[float, float], float], kept: int) -> None:
    rows = [_row(*other), _row("drag", BEST, 100.0)]
    left = apart(rows, SAMPLES)
    assert len(left) == kept
    assert any(racer.name == "drag" and m.cost == 100.0 for racer, m in left)


def test_where_the_error_is_large_starts_have_met_from_farther_off() -> None:
    rows = [_row("drag", BEST, 1e4), _row("drag", (1.0, 7.0), 1e4 + 50.0)]
    assert len(apart(rows, SAMPLES)) == 1
    assert len(apart(rows, int(1e4))) == 2


def test_of_a_periodic_effect_the_best_start_of_the_best_orders_goes_on() -> None:
    ripple = [_row("ripple", BEST, cost, order) for order, cost in ((7.0, 5.0), (7.0, 4.0), (14.0, 3.0), (9.0, 6.0))]
    rows = [*ripple, *(_row("drag", BEST, cost) for cost in (9.0, 7.0, 8.0))]
    kept = [(racer.name, racer.order, m.cost) for racer, m in best_of_each(rows, 2, orders=2)]
    assert kept == [("ripple", 14.0, 3.0), ("ripple", 7.0, 4.0), ("drag", 0.0, 7.0), ("drag", 0.0, 8.0)]


def test_where_derivatives_mislead_the_foremost_of_each_kind_get_an_iteration() -> None:
    model = rwn.read_model(DEMO / "model.toml")
    setup = prepare([rwn.read_recording(DEMO / "train.csv", layout=model.recording)], model)

    def starts(name: str, count: int, order: float = 0.0) -> list[Racer]:
        return [Racer(name, order, 0, candidate(setup.nominal, (name,), setup.scales))] * count

    straight = [*starts("quadratic-drag", 2), *starts("shaft-compliance", 18)]
    astray = [
        *starts("cogging-torque", 5, 7.0), *starts("cogging-torque", 1, 14.0), *starts("backlash", SIGHTED + 1),
        *starts("input-delay", 24),
    ]  # fmt: skip
    assert [r for r in (*straight, *astray) if misleads(r)] == astray
    kept = Counter((r.name, r.order) for r in worth_an_iteration(astray))
    assert kept == {
        ("cogging-torque", 7.0): PHASES, ("cogging-torque", 14.0): 1, ("backlash", 0.0): SIGHTED,
        ("input-delay", 0.0): SIGHTED,
    }  # fmt: skip
