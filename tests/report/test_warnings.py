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


def test_what_ran_into_a_limit_bears_plain_names(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(assemble, "_does_not_run", lambda _: [])
    better = SimpleNamespace(
        added=("amplifier-gain-curve", "coulomb-friction"), limits_met=("amplifier-gain-curve.exponent",)
    )
    ranking: Any = SimpleNamespace(weighted=SimpleNamespace(noise={}), cut_short=0, at_a_limit=(better,))
    chosen: Any = SimpleNamespace(added=(), final=None)
    (said,) = assemble._warnings(ranking, chosen, (), ())
    assert said.startswith("amplifier gain curve + Coulomb friction fits better, but exponent of amplifier gain curve")


@pytest.mark.parametrize(
    ("value", "said"), [(0.2, "2.0 times what was given, 13.9 declared deviations"), (0.0, "zero")]
)
def test_a_contradicted_parameter_bears_its_plain_name(value: float, said: str) -> None:
    unknown = SimpleNamespace(name="back_emf_constant", prior=0.1)
    chosen: Any = SimpleNamespace(
        final=SimpleNamespace(
            hypothesis=SimpleNamespace(unknowns=[unknown]), minimum=SimpleNamespace(values=[value])
        )
    )
    model: Any = SimpleNamespace(uncertainty={"back_emf_constant": 0.05})
    (warning,) = assemble._contradictions(chosen, model)
    assert warning.endswith(f"in back emf constant: it moved to {said}")
