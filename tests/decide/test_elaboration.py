"""An elaborate law is stated only where it adds to its plain one."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rwn.decide.calibration import calibration
from rwn.decide.elaboration import elaborated
from rwn.decide.evidence import Evidence
from rwn.name.weights import RankedFit

ADDS = Evidence(share=0.9, unseen=0.9, part=0.99, odds=100.0, curve=1.0)
IDLE = Evidence(share=0.01, unseen=0.0, part=0.1, odds=0.5, curve=0.5)
PLAIN, TWO_LEVELS, STRIBECK = "coulomb-friction", "asymmetric-friction", "stribeck-friction"


def explained(
    leading: tuple[str, ...], *others: tuple[str, ...], adding: tuple[str, ...] = (), diverged: tuple[str, ...] = ()
) -> Any:
    """Explanations, likeliest first, of whose elaborate laws those of `adding` add to their plain ones."""
    scores = [-np.inf if added == diverged else 10.0 - k for k, added in enumerate((leading, *others))]
    fits = [
        RankedFit(fit=SimpleNamespace(added=added), final=added, score=score, probability=0.1)  # type: ignore[arg-type]
        for added, score in zip((leading, *others), scores, strict=True)
    ]
    compared = []

    def judge(this: Any) -> Any:
        def evidence(name: str, rivals: Any, *, instead: Any) -> Evidence:
            assert not rivals
            compared.append((this.added, name, instead.added))
            return ADDS if name in adding else IDLE

        return SimpleNamespace(evidence=evidence)

    found = elaborated(SimpleNamespace(fits=fits), fits[0], judge)  # type: ignore[arg-type]
    return found, compared


def test_an_elaborate_law_that_adds_stays_and_the_plain_one_is_its_rival() -> None:
    found, compared = explained((TWO_LEVELS, "drag"), (PLAIN, "drag"), adding=(TWO_LEVELS,))
    assert found.leading.added == (TWO_LEVELS, "drag")
    assert compared == [((TWO_LEVELS, "drag"), TWO_LEVELS, (PLAIN, "drag"))]
    adds = calibration().probability(ADDS)
    assert found.odds == {(TWO_LEVELS, PLAIN): pytest.approx((1.0 - adds) / adds)}


def test_one_that_adds_nothing_gives_way_to_its_plain_law_and_stays_a_rival() -> None:
    found, _ = explained((TWO_LEVELS, "drag"), ("other",), ("drag", PLAIN))
    assert found.leading.added == ("drag", PLAIN)
    assert found.leading.score == 10.0, "rivals in the place of friction gain nothing by it"
    adds = calibration().probability(IDLE)
    assert found.odds == {(PLAIN, TWO_LEVELS): pytest.approx(adds / (1.0 - adds))}


@pytest.mark.parametrize(("adding", "kept"), [((STRIBECK,), STRIBECK), ((), PLAIN)])
def test_the_next_elaborate_law_has_its_own_turn(adding: tuple[str, ...], kept: str) -> None:
    found, compared = explained((TWO_LEVELS,), (STRIBECK,), (PLAIN,), adding=adding)
    assert found.leading.added == (kept,)
    assert [name for _, name, _ in compared] == [TWO_LEVELS, STRIBECK]
    assert set(found.odds) == {(kept, name) for name in (TWO_LEVELS, STRIBECK, PLAIN) if name != kept}


def test_what_was_not_tried_in_its_place_leaves_a_name_as_it_is() -> None:
    found, compared = explained((TWO_LEVELS, "drag"), (PLAIN,))
    assert (found.leading.added, found.odds, compared) == ((TWO_LEVELS, "drag"), {}, [])


def test_a_plain_law_that_diverged_is_no_comparison() -> None:
    found, compared = explained((TWO_LEVELS, "drag"), (PLAIN, "drag"), adding=(TWO_LEVELS,), diverged=(PLAIN, "drag"))
    assert (found.leading.added, found.odds, compared) == ((TWO_LEVELS, "drag"), {}, [])


def test_a_law_that_elaborates_nothing_is_not_asked() -> None:
    found, compared = explained((PLAIN, "drag"), (TWO_LEVELS, "drag"))
    assert (found.leading.added, found.odds, compared) == ((PLAIN, "drag"), {}, [])
