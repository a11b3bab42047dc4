"""How sure the values of what a diagnosis states are."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from rwn.fit.residuals import Statistics
from rwn.report import assemble


def test_recordings_count_in_the_values_by_misfit_and_as_their_halves_agree() -> None:
    left = Statistics(count=9000, variance=4.0, correlation_time=3.0, structured=("speed",))
    assert left.effective_with_misfit < left.effective
    decision: Any = SimpleNamespace(left=left, account=SimpleNamespace(birge=2.0))
    assert assemble._independent_samples(decision) == left.effective_with_misfit / 4.0
