"""What corrected.toml holds of what is stated."""

from __future__ import annotations

import math
from collections.abc import Collection
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from rwn.correct import correction
from rwn.correct.correction import _proved_part, _seen, _without_a_name
from rwn.decide.account import Account, ActingEffect
from rwn.decide.decision import Decision
from rwn.decide.evidence import Evidence
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


CERTAIN = Evidence(share=0.999, unseen=0.99, part=0.999, odds=5000.0, curve=1.0)
KEPT_BACK: Any = ["kept back"]


def kept(
    names: str, errors: dict[str, float], monkeypatch: pytest.MonkeyPatch, *, rivals: str = "", heldout: Any = KEPT_BACK
) -> str:
    """What corrected.toml holds of an explanation by `names` whose parts have these errors on recordings not fitted."""

    def explained(added: Collection[str]) -> Any:
        return SimpleNamespace(added=tuple(added), final=errors["".join(added)])

    def together(_: Any, _leading: Any, chosen: Collection[str]) -> Any:
        return explained(chosen)

    def compared(_: Any, before: float, after: float, *rest: Any, **options: Any) -> float:
        assert (rest, options) == ((heldout,), {"seed": 0})
        return after - before

    def proved(_: Any, this: Any, runs: Any, **options: Any) -> float:
        assert (runs, options) == (heldout, {"seed": 0})
        return float(this.final - errors[""])

    monkeypatch.setattr(correction, "together", together)
    monkeypatch.setattr(correction, "compared", compared)
    monkeypatch.setattr(correction, "proved", proved)
    monkeypatch.setattr(correction, "hurts", lambda rows: not rows <= 0.0)
    monkeypatch.setattr(correction, "log_change", lambda rows: rows)
    acting = [
        ActingEffect(name=n, probability=0.9, together=0.9, share=0.5, evidence=CERTAIN, rivals=tuple(rivals))
        for n in names
    ]
    fits = tuple(map(explained, errors))
    ranking: Any = SimpleNamespace(fits=fits, nothing_missing=explained(""))
    account = Account(effects=tuple(acting), leading=explained(names))
    decided: Any = SimpleNamespace(
        ranking=ranking, account=account, chosen=explained(names), rows=errors[names] - errors[""]
    )
    found: Decision = decided
    part, rows = _proved_part(found, heldout, seed=0)
    stays: Any = errors["".join(part.added)] - errors[""]
    assert rows == stays, "the proof is that of what stays"
    return "".join(part.added)


def test_what_helps_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    assert kept("ab", {"": 9.0, "a": 5.0, "b": 6.0, "ab": 1.0}, monkeypatch) == "ab"


def test_the_part_that_hurts_most_goes_and_then_what_still_does(monkeypatch: pytest.MonkeyPatch) -> None:
    errors = {"": 9.0, "a": 1.0, "b": 8.0, "c": 8.0, "ab": 2.0, "ac": 3.0, "bc": 7.0, "abc": 4.0}
    assert kept("abc", errors, monkeypatch) == "a"
    assert kept("abc", errors | {"a": 3.5}, monkeypatch) == "ab"


def test_two_that_hurt_together_alone_go_together(monkeypatch: pytest.MonkeyPatch) -> None:
    assert kept("ab", {"": 1.0, "a": 5.0, "b": 6.0, "ab": 2.0}, monkeypatch) == ""


def test_of_what_runs_away_only_what_does_it_goes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the first of two effects the motion still runs away: that says nothing against the first."""
    assert kept("ab", {"": 9.0, "a": 5.0, "b": np.inf, "ab": np.inf}, monkeypatch) == "a"


def test_where_nothing_was_kept_back_a_part_goes_only_from_what_is_worse_than_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    errors = {"": 9.0, "a": 1.0, "b": 8.0, "ab": 2.0}
    assert kept("ab", errors, monkeypatch, heldout=()) == "ab"
    assert kept("ab", errors | {"": 1.5}, monkeypatch, heldout=()) == "a"


def test_a_rival_that_predicts_better_takes_the_place_of_what_predicts_worse_than_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    errors = {"": 4.0, "a": 5.0, "b": 6.0, "c": 1.0}
    assert kept("a", errors, monkeypatch, rivals="b", heldout=()) == ""
    assert kept("a", errors, monkeypatch, rivals="c", heldout=()) == "c"


@pytest.mark.parametrize(("against", "stands_in"), [("", "a + b"), ("shaft", "b")])
def test_what_a_half_of_the_drive_contradicts_does_not_stand_in(
    against: str, stands_in: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def together(_: Any, _leading: Any, names: Collection[str]) -> Any:
        return SimpleNamespace(added=tuple(sorted(names)), final=None)

    monkeypatch.setattr(correction, "proved_network", lambda *_, **__: None)
    monkeypatch.setattr(correction, "proved", lambda *_, **__: (_row(2.0, 1.0),))
    monkeypatch.setattr(correction, "helps", lambda _: True)
    monkeypatch.setattr(correction, "fitted_model", lambda *_: "the model")
    monkeypatch.setattr(correction, "together", together)
    effects = tuple(
        ActingEffect(name=name, probability=0.1, together=0.1, share=0.5, evidence=CERTAIN, against=by)
        for name, by in (("a", against), ("b", ""))
    )
    leading: Any = SimpleNamespace(added=("a", "b"), final=None)
    decision = Decision(
        ranking=None, account=Account(effects=effects, leading=leading), chosen=None, remainder=None,  # type: ignore[arg-type]
        verdict="unexplained", rows=(),
    )  # fmt: skip
    found = _without_a_name(decision, KEPT_BACK, None, seed=0)  # type: ignore[arg-type]
    assert found is not None
    assert found.stands_in.startswith(f"{stands_in}, which helps")


@pytest.mark.parametrize(("share", "said"), [(0.001, 0), (0.1, 1)])
def test_a_law_that_is_seen_in_next_to_nothing_is_not_worth_a_word(share: float, said: int) -> None:
    law, left = SimpleNamespace(words="a torque over speed"), SimpleNamespace(share=share)
    decision = SimpleNamespace(other=law, remainder=left)
    assert len(_seen(cast(Any, decision))) == said
