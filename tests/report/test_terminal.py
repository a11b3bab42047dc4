"""What a terminal says of a diagnosis, and how it shows progress."""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

import made_up
from rwn.model.vocabulary import table
from rwn.report.account_picture import account_picture
from rwn.report.diagnosis import Diagnosis
from rwn.report.effect_text import lines as effect_lines
from rwn.report.progress import Progress, remaining
from rwn.report.terminal import lines, print_verdict


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


COLOUR = re.compile(r"\x1b\[[0-9;]*m")


@pytest.mark.parametrize("made", made_up.ALL.values(), ids=list(made_up.ALL))
def test_the_verdict_comes_first_and_nothing_is_wide(made: Callable[[], Diagnosis]) -> None:
    said = [COLOUR.sub("", line) for line in lines(made())]
    assert said[0].startswith(("The model", "Something is missing", "The recordings", "These"))
    assert not any("\n" in line for line in said)


def test_the_account_the_findings_and_the_filters_are_said() -> None:
    said = COLOUR.sub("", "\n".join(lines(made_up.unexplained())))
    assert re.search(r"Unbalance +█+·+ +22 % +probability 31 %, not stated", said)
    assert re.search(r"No name here +█{20} +100 % +of the speed", said)
    assert "train_1.csv: 3 single samples of the speed are far off those beside them; left out" in said
    assert "first-order filter of 2.70 ± 0.10 ms" in said


def test_shares_that_need_not_add_up_to_the_whole_are_said_to_be_that() -> None:
    """22 %, 4 % and 100 % without a word read as parts of 126 %."""
    many, clause = COLOUR.sub("", "\n".join(lines(made_up.unexplained()))), "shares need not add up to 100 %"
    assert f"without that effect alone; {clause}, and what is left includes what is not stated." in many
    assert clause not in "\n".join(lines(made_up.found()))  # one row
    two = (made_up.acting("coulomb-friction", 0.97, 0.9), made_up.acting("unbalance", 0.9, 0.8))
    assert f"{clause}." in "\n".join(lines(replace(made_up.found(), account=two)))
    assert f"{clause}, and what is left" in account_picture(made_up.unexplained())


def test_what_hardly_acts_is_shown_neither_here_nor_on_the_page() -> None:
    faint = (made_up.acting("coulomb-friction", 0.97, 0.9), made_up.acting("unbalance", 0.01, 0.0))
    found = replace(made_up.found(), account=faint)
    assert "Unbalance" not in "\n".join(lines(found))
    assert "Unbalance" not in account_picture(found)


def test_warnings_are_kept_apart_from_what_may_be_piped(capsys: pytest.CaptureFixture[str]) -> None:
    print_verdict(replace(made_up.found(), warnings=("a gap of 4 samples",)), Path("out"))
    said = capsys.readouterr()
    assert said.err == "warning: a gap of 4 samples\n"
    assert said.out.startswith("The model lacks")
    assert said.out.endswith("Report: out/report.html\n")


@pytest.mark.parametrize("width", [70, 100])
def test_a_list_of_effects_is_as_wide_as_the_terminal(width: int) -> None:
    effects = list(table().values())
    listed = list(effect_lines(effects, width=width))
    assert [entry.split()[0] for entry in listed] == [effect.name for effect in effects]
    rows = [row for entry in listed for row in entry.split("\n")]
    assert max(map(len, rows)) <= width
    assert len(rows) > len(effects)
    assert "\n" not in "".join(effect_lines(effects))  # piped: a line each


def test_names_agree_with_the_headline() -> None:
    said = COLOUR.sub("", "\n".join(lines(made_up.found())))
    assert "The model lacks Coulomb friction of 20.8 ± 0.5 mN m" in said
    assert "Coulomb friction: Coulomb torque T_c = 20.8 ± 0.5 mN m" in said
    assert "coulomb-friction" not in said


def test_an_adequate_model_has_no_account() -> None:
    found = replace(made_up.adequate(), account=(made_up.acting("unbalance", 0.1, 0.2),))
    assert "What acts" not in "\n".join(lines(found))


def test_a_search_that_begins_anew_is_counted() -> None:
    stream = io.StringIO()
    with Progress(stream) as progress:
        for stage, fraction in (("effects one by one", 0.4), ("filters", 0.6), ("effects one by one", 0.1)):
            progress(stage, fraction)
    last = stream.getvalue().splitlines()[-1]
    assert last == " 10 %  search 2: effects one by one"


def test_piped_progress_is_a_line_for_each_stage() -> None:
    stream = io.StringIO()
    with Progress(stream) as progress:
        for stage, fraction in (("reading", 0.0), ("reading", 0.1), ("fitting", 0.5)):
            progress(stage, fraction)
    assert stream.getvalue() == "  0 %  reading\n 50 %  fitting\n"


def test_the_time_that_is_left_is_that_of_what_is_done_once_more(monkeypatch: pytest.MonkeyPatch) -> None:
    """100 s for a search, then 5 s for a tenth of a longer one: 45 s are left, not 945 s."""
    clock, said = [0.0], []
    monkeypatch.setattr("rwn.report.progress.time.monotonic", lambda: clock[0])
    with Progress(_Terminal()) as progress:
        assert progress._bar is not None
        monkeypatch.setattr(progress._bar, "update", lambda *_, left, **__: said.append(left))
        for clock[0], fraction in ((100.0, 0.85), (100.0, 0.0), (105.0, 0.1)):
            progress("searching", fraction)
    assert said == ["about 18 s left", "", "about 45 s left of this search"]


def test_a_terminal_sees_a_bar_that_vanishes() -> None:
    stream = _Terminal()
    with Progress(stream) as progress:
        progress("fitting", 0.5)
    assert "fitting" in stream.getvalue()
    assert stream.getvalue().rstrip("\n").endswith("\x1b[2K")


@pytest.mark.parametrize(
    ("elapsed", "fraction", "said"),
    [(1.0, 0.01, ""), (10.0, 0.2, "about 40 s left"), (100.0, 0.1, "about 15 min left"), (9.0, 1.0, "")],
)
def test_the_time_that_is_left(elapsed: float, fraction: float, said: str) -> None:
    assert remaining(elapsed, fraction) == said
