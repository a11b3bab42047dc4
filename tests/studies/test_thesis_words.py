"""The words, counts and pictures of the thesis's experiments, from rows and panels that are made up."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner

from rwn.studies.thesis.check import _same
from rwn.studies.thesis.cli import app
from rwn.studies.thesis.experiment import Figure, Outcome, Panel, Search, Surface, curve
from rwn.studies.thesis.registry import EXPERIMENTS
from rwn.studies.thesis.summary import claims_table
from rwn.studies.thesis.words import word
from thesis_rows import row


@pytest.mark.parametrize(
    ("judge", "thesis", "ours", "wanted", "said"),
    [
        ("factor-2", None, 1.0, None, "not reproducible"),
        ("factor-2", 1.0, None, None, "not reproducible"),
        ("factor-2", 1.0, 1.9, None, "reproduced"),
        ("factor-2", 1.0, 0.4, None, "better than printed"),
        ("percentage-point", None, 1.0, None, "not reproducible"),
        ("percentage-point", 5.0, None, None, "not reproducible"),
        ("percentage-point", 5.0, -4.2, None, "better than printed"),
        ("percentage-point", 5.0, 5.9, None, "reproduced"),
        ("claim", None, None, 0.9, "does not hold"),
        ("claim", None, 0.95, None, "does not hold"),
        ("claim", None, 0.95, 0.9, "holds"),
        ("claim", None, 0.6, 0.9, "holds in part"),
        ("claim", None, 0.4, 0.9, "does not hold"),
        ("wanted", None, None, 0.1, "not reached"),
        ("wanted", None, 0.1, 0.1, "reached"),
        ("coverage", None, 0.94, None, "reached"),
        ("coverage", None, 0.99, None, "not reached"),
        ("none", 1.0, 9.0, None, ""),
    ],
)
def test_the_word_of_a_row(
    judge: str, thesis: float | None, ours: float | None, wanted: float | None, said: str
) -> None:
    this = row(thesis, ours, judge=judge, wanted=wanted)
    assert word(this, [this]) == said


@pytest.mark.parametrize(("unit", "near"), [("", 3), ("%", 1)])
def test_a_choice_reproduces_within_a_factor_or_a_point(unit: str, near: int) -> None:
    numbers = {"a": 5.0, "b": 5.0, "c": 5.0, "d": 5.0}
    search = Search(title="t", numbers=numbers, lines={"x": [5.9, 9.0, 3.0, None]}, taken="x", unit=unit)
    assert search.near("x") == near


@pytest.mark.parametrize(
    ("a", "b", "same"),
    [(None, None, True), (None, 1.0, False), (1.0, None, False), (1.0, 1.0, True), (1.0, 9.0, False)],
)
def test_a_run_that_diverged_is_the_same_as_one_that_did(a: float | None, b: float | None, same: bool) -> None:
    assert _same(a, b) == same


def test_claims_are_a_table_of_their_own() -> None:
    claim = row(None, 0.95, judge="claim", wanted=0.9, count="20 seeds")
    lost = replace(claim, case="claim: it learns", ours=None, missing="diverged")
    plain = row(1.0, 1.0)
    done = replace(Outcome(rows=[claim, lost, plain]))
    lines = claims_table([done]).splitlines()  # type: ignore[list-item]
    assert len(lines) == 4
    assert lines[2] == "| Table 0 | c | 0.95 | 20 seeds | holds |"
    assert lines[3] == "| Table 0 | it learns | diverged | 20 seeds | does not hold |"
    assert claims_table([replace(done, rows=[plain])]) == ""  # type: ignore[list-item]


def test_surfaces_are_drawn_flat_or_solid_beside_curves(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    from rwn.studies.thesis.pictures import draw

    z = [[1.0, 10.0, 100.0], [2.0, 20.0, 200.0]]
    solid = Surface(x=[0.0, 1.0, 2.0], y=[0.0, 1.0], z=z, label="error")
    flat = replace(solid, flat=True, log=True, limits=(0.0, 2.0))
    panels = [Panel(surface=solid), Panel(surface=flat), Panel(surface=replace(flat, log=False, limits=None))]
    panels.append(Panel(curves=[curve([1.0, 2.0])]))
    (picture,) = draw([Figure(number=None, title="t", panels=panels, name="s")], tmp_path)
    assert picture.name == "s.png"
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_the_experiments_are_listed_with_what_they_repeat() -> None:
    listed = CliRunner().invoke(app, ["list"])
    assert listed.exit_code == 0
    names = [line.split()[0] for line in listed.output.splitlines()]
    assert names == [e.name for e in EXPERIMENTS]
