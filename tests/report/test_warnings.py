"""What a diagnosis warns of, from fits that are written down."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from rwn.fit.levenberg_marquardt import FitStatus
from rwn.name.not_tried import NotTried
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
    ranking: Any = SimpleNamespace(weighted=SimpleNamespace(noise={}), not_tried=(), at_a_limit=())
    chosen: Any = SimpleNamespace(added=added, final=SimpleNamespace(minimum=SimpleNamespace(status=status)))
    found = assemble._warnings(ranking, chosen, (), ())
    assert any("before it converged" in text for text in found) == said


def test_what_ran_into_a_limit_bears_plain_names(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(assemble, "_does_not_run", lambda _: [])
    better = SimpleNamespace(
        added=("amplifier-gain-curve", "coulomb-friction"), limits_met=("amplifier-gain-curve.exponent",)
    )
    ranking: Any = SimpleNamespace(weighted=SimpleNamespace(noise={}), not_tried=(), at_a_limit=(better,))
    chosen: Any = SimpleNamespace(added=(), final=None)
    (said,) = assemble._warnings(ranking, chosen, (), ())
    assert said.startswith("amplifier gain curve + Coulomb friction fits better, but exponent of amplifier gain curve")


@pytest.mark.parametrize(
    ("names", "said"),
    [
        (("cogging-torque",), "cogging torque was not tried"),
        (("cogging-torque", "input-delay"), "cogging torque and input delay were not tried"),
        (tuple("abcdefghi"), "a, b, c, d, e, f, g, h and i were not tried"),
        (tuple("abcdefghij"), "a, b, c, d, e, f, g, h and 2 others (not_tried in diagnosis.json) were not tried"),
    ],
)
def test_what_was_not_tried_is_said_by_name(
    monkeypatch: pytest.MonkeyPatch, names: tuple[str, ...], said: str
) -> None:
    monkeypatch.setattr(assemble, "_does_not_run", lambda _: [])
    left = NotTried(beside=("coulomb-friction", "unbalance"), effects=names)
    ranking: Any = SimpleNamespace(weighted=SimpleNamespace(noise={}), not_tried=(left,), at_a_limit=())
    chosen: Any = SimpleNamespace(added=(), final=None)
    (warning,) = assemble._warnings(ranking, chosen, (), ())
    assert warning.startswith(f"the search ended early: {said} in addition to Coulomb friction + unbalance; --effort")


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
