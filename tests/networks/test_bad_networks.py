"""Networks that cannot be: each is refused with what was expected."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import rwn
from motor_networks import MOTOR, SAMPLE_TIME, structured
from rwn.networks.rates import Normalised
from rwn.networks.rates.rule import RateReport
from rwn.networks.structured_network import as_start

NETWORK = structured(3, 0)
REFUSED: dict[str, tuple[Callable[[], Any], str]] = {
    "v of four": (lambda: replace(NETWORK, v=np.ones(4)), r"v must have 5 entries .*, got 4"),
    "m of two": (lambda: replace(NETWORK, m=np.ones(2)), r"m must have 3 entries .*, got 2"),
    "no width": (lambda: replace(NETWORK, d=np.array([1.0, 0.0, 1.0])), r"dilation d\[1\] is 0"),
    "theta too short": (lambda: NETWORK.with_theta(np.ones(16)), r"theta must have 17 entries .*, got 16"),
    "no sample time": (
        lambda: rwn.StructuredNetwork.from_motor(MOTOR, sample_time=0.0), "sample_time must be positive, got 0.0",
    ),
    "no inertia": (
        lambda: rwn.StructuredNetwork.from_motor(replace(MOTOR, inertia=0.0), sample_time=SAMPLE_TIME),
        "inertia must be positive, got 0.0",
    ),
    "a start of three": (lambda: as_start([0.0, 0.0, 0.0]), r"start must be \[speed, current\], got 3 entries"),
    "a scale of nothing": (
        lambda: Normalised(scales={"v": 1.0, "x": 1.0}).core_for(("v", "w")),
        "scales: unknown group 'x'; this network has v, w",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_no_network_is_refused(case: str) -> None:
    make, said = REFUSED[case]
    with pytest.raises(ValueError, match=said):
        make()


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({}, ()),
        ({"unstable": 3, "spectral_radius": 1.25}, ("rho(A) reached 1.25 (>= 1) at 3 samples",)),
        ({"defective": 2, "condition": 3e9}, ("M was (nearly) defective, cond 3e+09, at 2 samples",)),
        ({"recurrent": 1, "recurrence": 1.5}, ("|c/d| max|phi'| reached 1.5 (>= 1) at 1 samples",)),
        ({"smallest_dilation": 2e-8}, ("a dilation came within 2e-08 of zero",)),
    ],
)
def test_a_report_warns_of_what_took_the_meaning_from_the_bounds(
    changed: dict[str, Any], said: tuple[str, ...]
) -> None:
    fine = RateReport(
        spectral_radius=0.9, condition=10.0, recurrence=0.2, smallest_dilation=0.5, samples=100, unstable=0,
        defective=0, recurrent=0,
    )  # fmt: skip
    assert replace(fine, **changed).warnings == said
