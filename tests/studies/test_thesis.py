from __future__ import annotations

import inspect
import re
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from rwn.errors import InputError
from rwn.studies.thesis.cli import app
from rwn.studies.thesis.comparison import markdown_table
from rwn.studies.thesis.experiment import Experiment, Outcome, Row, Search, Settings, curve, median_row
from rwn.studies.thesis.formats import number
from rwn.studies.thesis.overview import NUMBERS, answers, counts, totals
from rwn.studies.thesis.page import write_page
from rwn.studies.thesis.registry import EXPERIMENTS, select
from rwn.studies.thesis.runner import run
from rwn.studies.thesis.summary import wanted_table
from rwn.studies.thesis.words import word
from thesis_rows import PAGE, row


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that keeps the reduced results of all experiments between the tests of this file."""
    return tmp_path_factory.mktemp("thesis")


@pytest.mark.slow
@pytest.mark.parametrize("experiment", EXPERIMENTS, ids=lambda e: e.name)
def test_every_experiment_runs_at_a_tiny_count(experiment: Experiment, results: Path) -> None:
    shares: list[float] = []
    (done,) = run([experiment], results, count="tiny", progress=lambda _, share: shares.append(share))
    assert done.rows or done.searches
    assert shares == sorted(shares)
    assert shares[-1] == pytest.approx(1.0)
    assert {f.number for f in done.figures if f.number is not None} == set(experiment.figures)
    tables = {f"Table {t}" for t in experiment.tables}
    assert tables <= {line.where for line in done.rows}
    for found in done.searches:
        assert all(len(values) == len(found.numbers) for values in found.lines.values())
        assert found.taken in ("", *found.lines)
    for line in done.rows:
        assert line.ours is None or np.isfinite(line.ours)
        assert line.thesis is not None or not line.answer
        assert line.count or line.judge in ("none", "claim")
    assert len(experiment.choices) > 80, "the file must state at its top what the thesis leaves open"


@pytest.mark.slow
def test_every_number_of_the_thesis_has_one_row(results: Path) -> None:
    """Runs on what the test above has left in the folder, and makes what is missing."""
    found = run(EXPERIMENTS, results, count="tiny")
    assert {where: sum(by_word.values()) for where, by_word in counts(found).items()} == NUMBERS
    assert sum(NUMBERS.values()) == sum(totals(found).values()) == 85
    values = [(row.where, row.case) for row, _ in answers(found)]
    assert len(set(values)) == 85
    assert list(counts(found)) == list(NUMBERS), "the order of the thesis"


def test_names_and_figures_are_unique() -> None:
    names = [e.name for e in EXPERIMENTS]
    figures = [f for e in EXPERIMENTS for f in e.figures]
    assert len(set(names)) == len(names)
    assert len(set(figures)) == len(figures)


@pytest.mark.parametrize(
    ("rows", "want"),
    [
        ([row(1.0, 1.9)], "reproduced"),
        ([row(1.0, 0.5)], "reproduced"),
        ([row(1.0, 0.49)], "better than printed"),
        ([row(1.0, 0.0)], "better than printed"),
        ([row(1.0, -0.1)], "not reproducible"),
        ([row(1.0, 2.1)], "not reproducible"),
        ([row(1.0, None)], "not reproducible"),
        ([row(1.0, 5.0, group="g"), row(2.0, 9.0, group="g")], "trend"),
        ([row(1.0, 5.0, group="g"), row(2.0, 4.0, group="g")], "not reproducible"),
        ([row(1.0, 5.0, group="g"), row(2.0, None, group="g")], "not reproducible"),
        ([row(11.0, 11.9, judge="percentage-point")], "reproduced"),
        ([row(11.0, 12.1, judge="percentage-point")], "not reproducible"),
        ([row(11.0, -3.0, judge="percentage-point")], "better than printed"),
        ([row(0.0, -3.0, judge="percentage-point")], "not reproducible"),
        ([row(None, 1e-9, judge="wanted", wanted=1e-8)], "reached"),
        ([row(None, None, judge="wanted", wanted=1e-8)], "not reached"),
        ([row(None, 0.96, judge="claim", wanted=0.95)], "holds"),
        ([row(None, 0.7, judge="claim", wanted=0.95)], "holds in part"),
        ([row(None, 0.4, judge="claim", wanted=0.95)], "does not hold"),
        ([row(None, 0.95, judge="coverage")], "reached"),
        ([row(None, 0.89, judge="coverage")], "not reached"),
        ([row(None, 0.99, judge="coverage")], "not reached"),
    ],
)
def test_words_are_computed(rows: list[Row], want: str) -> None:
    assert word(rows[0], rows) == want


def test_a_diverged_run_counts_as_infinite() -> None:
    made = median_row("Table 0", "c", 1.0, [1.0, np.inf, np.nan])
    assert made.ours is None
    assert number(made.ours) == "diverged"
    assert median_row("Table 0", "c", 1.0, [1.0, 2.0, np.inf]).ours == 2.0


def test_long_curves_are_thinned_and_keep_their_ends() -> None:
    thin = curve(np.arange(10_000.0))
    assert len(thin.x) <= 400
    assert (thin.x[0], thin.x[-1]) == (0.0, 9999.0)


def test_reasons_are_shown_only_where_the_word_is_not_the_best() -> None:
    text = markdown_table([row(1.0, 1.0, reason="fine"), row(1.0, 9.0, reason="because")])
    assert "because" in text
    assert "fine" not in text


def test_select_names_what_exists() -> None:
    assert [e.tables for e in select(table=3)] == [(3,)]
    with pytest.raises(ValueError, match="no experiment makes table 99; expected one of tables 1-20"):
        select(table=99)


@pytest.mark.slow
def test_the_command_prints_the_comparison_and_writes_the_page(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    answer = CliRunner().invoke(app, ["run", "--figure", "26", "--quick", "--out", str(tmp_path)])
    assert answer.exit_code == 0, answer.output
    assert "Table 7" in answer.output
    page = (tmp_path / "thesis.md").read_text()
    assert page.index("Shortened") < page.index("## Overview") < page.index("| Table 7 | 2 |")
    assert "not stated: both start from the dyadic grid" in " ".join(page.split())
    assert (tmp_path / "thesis" / "figure_26.png").stat().st_size > 10_000
    again = CliRunner().invoke(app, ["page", "--out", str(tmp_path), "--page", str(tmp_path / "again" / "thesis.md")])
    assert again.exit_code == 0, again.output
    assert (tmp_path / "again" / "thesis.md").read_text() == page, "from what was kept"


@pytest.mark.parametrize("options", [[], ["--table", "99"], ["--all", "--table", "1"]])
def test_the_command_refuses_what_it_cannot_run(options: list[str], tmp_path: Path) -> None:
    answer = CliRunner().invoke(app, ["run", *options, "--out", str(tmp_path / "new")])
    assert isinstance(answer.exception, InputError)  # one line and exit code 2 from `rwn`
    assert not (tmp_path / "new").exists()


@pytest.mark.slow
def test_the_walk_through_is_written_and_the_repositorys_shows_the_code_as_it_is(tmp_path: Path) -> None:
    """`rwn thesis table-20 --page docs/table_20.md` writes it."""
    pytest.importorskip("matplotlib")
    page = tmp_path / "table_20.md"
    answer = CliRunner().invoke(app, ["table-20", "--page", str(page)])
    assert answer.exit_code == 0, answer.output
    kept = PAGE.with_name("table_20.md").read_text(encoding="utf-8")
    codes = re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    assert len(codes) == 6
    assert all(code in kept for code in codes)
    pictures = re.findall(r"\((table_20/.*?png)\)", kept)
    assert len(pictures) == 6
    assert all((tmp_path / name).is_file() and (PAGE.parent / name).is_file() for name in pictures)


def test_the_page_begins_with_the_numbers_and_the_cause_of_each_that_is_not_reproduced(tmp_path: Path) -> None:
    def run_it(_: Settings) -> Outcome:
        rows = [
            row(None, 2.0, judge="wanted", wanted=1.0),
            Row(where="Table 17", case="case 1, J", thesis=1.0, ours=9.0, answer=True),
            row(1.0, 1.0, answer=True),
        ]
        lines: dict[str, list[float | None]] = {"small": [1.5, None], "large": [9.0, 2.0]}
        choices = Search(title="Size", numbers={"a": 1.0, "b": 2.0}, lines=lines, taken="small")
        return Outcome(rows=rows, searches=[choices])

    pytest.importorskip("matplotlib")
    results = run([Experiment(name="one", title="One", run=run_it)], tmp_path)
    assert "at most 1 | 2 | not reached" in wanted_table(results)
    assert totals(results) == {"reproduced": 1, "better than printed": 0, "trend": 0, "not reproducible": 1}
    write_page(results, tmp_path / "page.md")
    page = (tmp_path / "page.md").read_text()
    assert "| 1 | 9 |  | not reproducible | a correction acts after" in page
    assert "| reproduced |  |" in page, "no cause is asked"
    assert "| **small** | 1.5 | diverged | 1 of 2 |" in page
    assert "Shortened" not in page
    assert page.index("## Overview") < page.index("## Choices") < page.index("## Beyond the thesis")


@pytest.mark.parametrize("experiment", EXPERIMENTS, ids=lambda e: e.name)
def test_the_page_of_the_repository_holds_every_experiment(experiment: Experiment) -> None:
    """`rwn thesis run --all --page docs/thesis.md` writes it."""
    page = PAGE.read_text(encoding="utf-8")
    assert f"## {experiment.title}\n" in page
    assert inspect.cleandoc(experiment.choices) in page, "the open choices were changed: write the page again"
    for figure in experiment.figures:
        picture = PAGE.with_suffix("") / f"figure_{figure:02d}.png"
        assert f"(thesis/{picture.name})" in page
        assert picture.is_file()
