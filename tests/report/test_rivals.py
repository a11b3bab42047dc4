"""A name that recordings do not tell from another: one probability of either, said alike wherever it is said."""

from __future__ import annotations

from dataclasses import replace

import made_up
from rwn.report.diagnosis import Diagnosis
from rwn.report.page import page
from rwn.report.sentences import sentences

EITHER = replace(
    made_up.acting("coulomb-friction", 0.43, 0.9), together=0.81, rivals=("presliding-hysteresis",)
)


def _found() -> Diagnosis:
    one = made_up.found()
    (effect,) = one.effects
    return replace(
        one, effects=(replace(effect, probability=0.43),), set=("coulomb-friction", "presliding-hysteresis"),
        account=(EITHER,),
    )  # fmt: skip


def test_the_headline_has_the_probability_of_either() -> None:
    first = sentences(_found())[0]
    assert "Coulomb friction or presliding hysteresis (probability 81 % of one of them" in first


def test_the_report_has_that_of_the_name_beside_that_of_either() -> None:
    shown = page(_found())
    assert "43 %" in shown
    assert "81 % with presliding hysteresis" in shown
    before_the_tile = shown.split("probability of this name or one in its place")[0]
    assert before_the_tile.endswith("<b>81\N{NO-BREAK SPACE}%</b><span>")
