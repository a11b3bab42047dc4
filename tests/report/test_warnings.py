"""What a diagnosis warns of, from fits that are written down."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from rwn.fit.levenberg_marquardt import FitStatus
from rwn.report import assemble


@pytest.mark.parametrize(
    ("status", "added", "said"),
    [
        (FitStatus.ITERATION_LIMIT, ("coulomb-friction",), True),
        (FitStatus.CONVERGED, ("coulomb-friction",), False),
        (FitStatus.ITERATION_LIMIT, (), False),  # nothing is stated
    ],
)
def test_a_fit_that_did_not_converge_is_said(
    monkeypatch: pytest.MonkeyPatch, status: FitStatus, added: tuple[str, ...], said: bool
) -> None:
    monkeypatch.setattr(assemble, "_does_not_run", lambda _: [])
    ranking: Any = SimpleNamespace(weighted=SimpleNamespace(noise={}), cut_short=0, at_a_limit=())
    chosen: Any = SimpleNamespace(added=added, final=SimpleNamespace(minimum=SimpleNamespace(status=status)))
    found = assemble._warnings(ranking, chosen, (), ())
    assert any("before it converged" in text for text in found) == said
