from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import made_up
from rwn.report import write_report
from rwn.report.diagnosis import Diagnosis
from rwn.report.page import page
from rwn.report.proof_sentences import before_after, headline
from rwn.report.tables import alternative_table, heldout_table


def _text(found: Diagnosis, folder: Path) -> str:
    write_report(found, folder / "report.html")
    return (folder / "report.html").read_text(encoding="utf-8")


def _body(text: str) -> str:
    return text.split("</main>")[0]


def test_a_signal_of_one_recording_has_one_unit_in_the_table() -> None:
    whole = next(row for row in made_up.found().heldout if row.region == "all")
    large = replace(whole, unit="A", signal="current", nominal=2.0, refitted=1.5, corrected=1.2, noise_floor=0.1)
    small = replace(large, region="low speed", refitted=0.0671, corrected=0.0123)
    assert "67.1&nbsp;mA" in heldout_table([small])
    assert "mA" not in heldout_table([large, small])


@pytest.mark.parametrize("state", made_up.ALL)
def test_every_state_opens_offline(state: str, tmp_path: Path) -> None:
    text = _text(made_up.ALL[state](), tmp_path)
    assert not re.search(r'(src|href)="', text.split("</main>")[0])
    assert not re.search(r"<link|@import", _body(text))
    assert text.count("<h1>") == 1
    assert text.rstrip().endswith("</html>")


def test_the_report_shows_what_was_found(tmp_path: Path) -> None:
    body = _body(_text(made_up.found(), tmp_path))
    for shown in (
        "Coulomb friction",
        "20.8 ± 0.5 mN m",
        "97 %",
        "reversals",
        "heldout_2.csv",
        "0.830",
        "[83, 90]",
    ):
        assert shown in body


@pytest.mark.parametrize("state", made_up.ALL)
def test_every_curve_is_drawn_once(state: str, tmp_path: Path) -> None:
    found = made_up.ALL[state]()
    drawn = re.findall(r'<script type="application/json" id="figure-\d+">(.*?)</script>', _text(found, tmp_path))
    lines = sum(len(json.loads(text)["data"]) for text in drawn)
    bands = sum(2 for plot in found.curves for trace in plot.traces if trace.low is not None)
    assert lines == bands + sum(len(plot.traces) for plot in found.curves)


def test_a_row_that_got_worse_is_flagged_by_more_than_colour() -> None:
    good = made_up.found().heldout[0]
    bad = replace(good, gain=-0.2, gain_interval=(-0.3, -0.1))
    unsure = replace(good, gain=-0.2, gain_interval=(-0.3, 0.1))
    assert [heldout_table([row]).count("▲ worse") for row in (good, bad, unsure)] == [0, 1, 0]


@pytest.mark.parametrize("state", made_up.ALL)
def test_headline_tile_and_table_say_the_same_two_numbers(state: str, tmp_path: Path) -> None:
    found = made_up.ALL[state]()
    row = headline(found)
    if row is None:
        return
    before, after = before_after(row)
    body = _body(_text(found, tmp_path)).replace("&nbsp;", " ").replace("\u00a0", " ")
    assert f"{before} → {after}" in body
    assert f"<b>{before}</b>" in body
    assert f"<b>{after}</b>" in body


def test_the_account_shows_what_is_stated_what_is_not_and_what_is_left(tmp_path: Path) -> None:
    body = _body(_text(made_up.unexplained(), tmp_path))
    assert re.findall(r'<li class="(\w+)"><span class="name">([^<]*)', body) == [
        ("doubtful", "Unbalance"), ("doubtful", "Coulomb friction"), ("left", "No name here"),
    ]  # fmt: skip
    assert "acts with probability 31 %: not stated" in body


def test_what_was_odd_in_recordings_and_the_filters_of_sensors_are_shown(tmp_path: Path) -> None:
    body = _body(_text(made_up.found(), tmp_path))
    assert "3 single samples of the speed are far off" in body
    assert "first-order filter of 2.70 ± 0.10 ms" in body


def test_text_of_the_user_cannot_break_the_page(tmp_path: Path) -> None:
    found = made_up.found()
    evil = "</script><script>alert(1)</script>"
    plot = replace(found.curves[0], title=evil, traces=(replace(found.curves[0].traces[0], name=evil),))
    body = _body(_text(replace(found, curves=(plot,), warnings=(evil,), command=evil), tmp_path))
    assert "<script>alert" not in body


@pytest.mark.parametrize(
    ("changed", "said", "unsaid"),
    [
        ({"adequate_probability": None}, "noise of that signal, estimated", "probability that nothing is missing"),
        ({"heldout": ()}, "probability that nothing is missing", "noise of that signal, estimated"),
    ],
)
def test_facts_that_are_not_known_take_no_place(
    changed: dict[str, Any], said: str, unsaid: str, tmp_path: Path
) -> None:
    body = _body(_text(replace(made_up.adequate(), **changed), tmp_path))
    assert said in body
    assert unsaid not in body


def test_an_error_without_a_noise_floor_has_no_fact_of_it(tmp_path: Path) -> None:
    found = made_up.adequate()
    rows = (replace(found.heldout[0], noise_floor=None),)
    assert "noise of that signal, estimated" not in _body(_text(replace(found, heldout=rows), tmp_path))


def test_a_recording_without_a_stretch_that_shows_most_is_drawn_whole_alone(tmp_path: Path) -> None:
    found = made_up.found()
    whole = tuple(replace(plot, zoom=None) for plot in found.curves)
    assert "Close-up: " in _body(_text(found, tmp_path))
    body = _body(_text(replace(found, curves=whole), tmp_path))
    assert "Whole recording" in body
    assert "Close-up: " not in body


def test_missing_numbers_are_dashes() -> None:
    row = replace(made_up.found().heldout[0], corrected=None, noise_floor=None, gain=None, gain_interval=None)
    assert heldout_table([row]).count(">–<") == 3


@pytest.mark.parametrize("state", made_up.ALL)
def test_it_is_small(state: str, tmp_path: Path) -> None:
    assert len(_text(made_up.ALL[state](), tmp_path).encode()) < 1_500_000


def test_the_stated_explanation_is_the_first_of_the_table_that_others_are_compared_in() -> None:
    shown = alternative_table(made_up.found())
    assert "Weight by fit alone" in shown, "the page has another probability, that an effect acts"
    rows = shown.split("<tr>")
    assert "Explanation" in rows[1]
    assert "<b>Coulomb friction</b> <span class=note>(stated)</span>" in rows[2]
    assert "94 %" in rows[2]
    assert "Stribeck friction" in rows[3]
    assert not alternative_table(replace(made_up.found(), alternatives=()))


def test_other_explanations_are_not_said_to_explain_where_nothing_does() -> None:
    """Their probabilities are of each other: beside "no effect that has a name comes near" 70 % reads as near."""
    others = replace(made_up.unexplained(), alternatives=made_up.found().alternatives)
    assert "Of what has a name, the likeliest" in alternative_table(others)
    assert "Other explanation" in alternative_table(replace(made_up.found(), explanation=None))  # of an older file
    assert "Refitted alone: The fit converged." in page(
        replace(made_up.found(), nominal_fit=replace(made_up.found().nominal_fit, advice="The fit converged."))
    )
