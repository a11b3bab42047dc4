"""Numbers that are not finite: whatever is saved can be read, and what ran away is said in words."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import msgspec
import numpy as np
import pytest

import made_up
from rwn.prove.heldout import HeldoutRow
from rwn.report.diagnosis import Diagnosis
from rwn.report.page import page
from rwn.report.sentences import sentences
from rwn.report.tables import heldout_table

INF = float("inf")


def _numbers(plain: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The place of every float."""
    if isinstance(plain, float):
        yield path
    items = plain.items() if isinstance(plain, dict) else enumerate(plain) if isinstance(plain, list) else ()
    for key, value in items:
        yield from _numbers(value, (*path, key))


@pytest.mark.parametrize("value", [INF, -INF, float("nan")])
@pytest.mark.parametrize("made", made_up.ALL.values(), ids=list(made_up.ALL))
def test_whatever_number_is_not_finite_what_is_saved_can_be_read(made: Any, value: float) -> None:
    schema = jsonschema.Draft202012Validator(Diagnosis.schema())
    plain = json.loads(made().to_json())
    places = list(_numbers(plain))
    assert len(places) > 5
    for *way, last in places:
        there = plain
        for key in way:
            there = there[key]
        known, there[last] = there[last], value
        found = msgspec.convert({k: v for k, v in plain.items() if k != "format"}, Diagnosis)
        there[last] = known
        again = Diagnosis.from_json(found.to_json())
        assert again == found, (way, last)
        schema.validate(json.loads(found.to_json()))


def test_a_mark_without_an_end_is_read_with_the_curves() -> None:
    found = made_up.found()
    plot = replace(found.curves[0], zoom=(0.0, INF))
    again = Diagnosis.from_json(found.to_json(), replace(found, curves=(plot,)).curves_json())
    assert again.curves[0].zoom == (0.0, INF)


def _of(refitted: float, corrected: float | None, signal: str = "speed") -> HeldoutRow:
    row = made_up.found().heldout[0]
    return replace(
        row, signal=signal, nominal=refitted, refitted=refitted, corrected=corrected, gain=None, gain_interval=None
    )


@pytest.mark.parametrize(
    ("row", "said"),
    [
        (_of(1.0, INF), "makes the simulated speed on heldout_1.csv, not used for fitting, run away."),
        (_of(INF, INF), "does not keep the simulated speed on heldout_1.csv, not used for fitting, from running away."),
        (_of(INF, 1.0), "not used for fitting, from running away: its error is 1.00 rad/s."),
        (
            _of(0.0, 0.83),
            "increases the speed error on heldout_1.csv, not used for fitting, from 0 rad/s, refitted alone, to 0.83",
        ),
        (_of(0.0, 0.0), "changes nothing in the speed error on heldout_1.csv, not used for fitting, 0 rad/s"),
    ],
)
def test_what_ran_away_is_said(row: HeldoutRow, said: str, tmp_path: Path) -> None:
    found = replace(made_up.found(), heldout=(row,))
    text = " ".join(sentences(found))
    assert said in text
    assert "inf" not in text
    assert "nan" not in text
    found.save(tmp_path / "a")
    cells = heldout_table(Diagnosis.load(tmp_path / "a").heldout)
    assert cells == heldout_table(found.heldout)
    assert ("ran&nbsp;away" in cells) == (INF in (row.refitted, row.corrected))


def test_another_signal_that_runs_away_is_said_too() -> None:
    first = made_up.found().heldout[0]
    for row, said in (
        (_of(0.1, INF, "current"), "But the simulated current on heldout_1.csv runs away."),
        (_of(INF, INF, "current"), "The current there runs away with and without it."),
    ):
        assert said in " ".join(sentences(replace(made_up.found(), heldout=(first, row))))


def test_an_adequate_model_that_runs_away_elsewhere_is_doubted() -> None:
    found = replace(made_up.adequate(), heldout=(_of(INF, None),))
    assert "the simulated speed runs away: that run shows" in " ".join(sentences(found))


def test_a_remainder_that_ran_away_is_drawn_as_such() -> None:
    found = made_up.unexplained()
    assert "a motion that ran away" in page(replace(found, remainder=replace(found.remainder, error=np.inf)))
