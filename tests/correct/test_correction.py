"""What corrected.toml holds of what is stated."""

from __future__ import annotations

import math

import pytest

from rwn.prove.heldout import HeldoutRow, log_change


def _row(refitted: float, corrected: float | None, region: str = "all") -> HeldoutRow:
    return HeldoutRow(
        recording="run", region=region, signal="speed", unit="rad/s", samples=100, nominal=1.0, refitted=refitted,
        corrected=corrected, noise_floor=0.1,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("errors", "better"),
    [
        ([(2.0, 1.0)], True),
        ([(1.0, 2.0)], False),
        ([(1.0, 1.1), (1.0, 0.5)], True),
        ([(1.5, 7.4), (8.0, 7.9)], False),  # a load that acted in one recording alone
        ([(1.0, float("inf")), (1.0, 0.01)], False),
    ],
)
def test_a_correction_is_judged_by_the_mean_logarithm_of_its_errors(
    errors: list[tuple[float, float]], better: bool
) -> None:
    assert (log_change([_row(*pair) for pair in errors]) < 0.0) is better


def test_regions_and_what_was_not_corrected_do_not_count() -> None:
    assert log_change([_row(1.0, 9.0, "low speed"), _row(1.0, None)]) == -math.inf
