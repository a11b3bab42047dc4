from __future__ import annotations

import inspect
import json
import re
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from rwn.errors import InputError
from rwn.studies.thesis.cli import app
from rwn.studies.thesis.comparison import markdown_table, number, tally
from rwn.studies.thesis.experiment import Experiment, Outcome, Row, Settings, curve, median_row
from rwn.studies.thesis.registry import EXPERIMENTS, select
from rwn.studies.thesis.runner import run
from rwn.studies.thesis.summary import causes, wanted_table
from rwn.studies.thesis.words import word


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that keeps the reduced results of all experiments between the tests of this file."""
    return tmp_path_factory.mktemp("thesis")


@pytest.mark.slow
@pytest.mark.parametrize("experiment", EXPERIMENTS, ids=lambda e: e.name)
def test_every_experiment_runs_at_a_reduced_count(experiment: Experiment, results: Path) -> None:
    shares: list[float] = []
    (done,) = run([experiment], results, reduced=True, progress=lambda _, share: shares.append(share))
    assert done.rows
    assert shares == sorted(shares)
    assert shares[-1] == pytest.approx(1.0)
    assert {f.number for f in done.figures if f.number is not None} == set(experiment.figures)
    tables = {f"Table {t}" for t in experiment.tables}
    assert tables <= {row.where for row in done.rows}
    for row in done.rows:
        assert row.ours is None or np.isfinite(row.ours)
        assert row.count or row.judge in ("none", "claim")
    assert len(experiment.choices) > 80, "the file must state at its top what the thesis leaves open"


def test_names_and_figures_are_unique() -> None:
    names = [e.name for e in EXPERIMENTS]
    figures = [f for e in EXPERIMENTS for f in e.figures]
    assert len(set(names)) == len(names)
    assert len(set(figures)) == len(figures)


def row(thesis: float | None, ours: float | None, **rest: object) -> Row:
    return Row(where="Table 0", case="c", thesis=thesis, ours=ours, **rest)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("rows", "want"),
    [
        ([row(1.0, 1.9)], "reproduced"),
        ([row(1.0, 2.1)], "not reproducible"),
        ([row(1.0, None)], "not reproducible"),
        ([row(1.0, 5.0, group="g"), row(2.0, 9.0, group="g")], "trend"),
        ([row(1.0, 5.0, group="g"), row(2.0, 4.0, group="g")], "not reproducible"),
        ([row(1.0, 5.0, group="g"), row(2.0, None, group="g")], "not reproducible"),
        ([row(11.0, 11.9, judge="percentage-point")], "reproduced"),
        ([row(11.0, 12.1, judge="percentage-point")], "not reproducible"),
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


def one(calls: list[int]) -> Experiment:
    def run_it(settings: Settings) -> Outcome:
        calls.append(1)
        settings.progress(0.5)
        return Outcome(rows=[row(1.0, 1.0)])

    return Experiment(name="one", title="One", run=run_it)


def test_a_finished_experiment_is_not_run_again(tmp_path: Path) -> None:
    calls: list[int] = []
    first = run([one(calls)], tmp_path)
    assert run([one(calls)], tmp_path) == first
    assert len(calls) == 1
    run([one(calls)], tmp_path, reduced=True)
    assert len(calls) == 2, "another count is another run"
    assert tally(first) == {"reproduced": 1}


def test_the_results_do_not_depend_on_the_number_of_jobs(tmp_path: Path) -> None:
    chosen = [e for e in EXPERIMENTS if e.name in ("siso-size", "siso-rate", "siso-wavelets")]
    alone = run(chosen, tmp_path / "alone", reduced=True)
    together = run(chosen, tmp_path / "together", reduced=True, jobs=3)
    assert [r.rows for r in alone] == [r.rows for r in together]


@pytest.mark.parametrize("damage", ["", "{", "{}", json.dumps({"name": "one"})])
def test_a_damaged_result_is_made_again(tmp_path: Path, damage: str) -> None:
    calls: list[int] = []
    (tmp_path / "one.json").write_text(damage)
    run([one(calls)], tmp_path)
    assert len(calls) == 1


def test_select_names_what_exists() -> None:
    assert [e.tables for e in select(table=3)] == [(3,)]
    with pytest.raises(ValueError, match="no experiment makes table 99; expected one of tables 1-20"):
        select(table=99)


@pytest.mark.slow
def test_the_command_prints_the_comparison_and_writes_the_page(results: Path) -> None:
    pytest.importorskip("matplotlib")
    answer = CliRunner().invoke(app, ["run", "--figure", "18", "--reduced", "--out", str(results)])
    assert answer.exit_code == 0, answer.output
    assert "Table 3" in answer.output
    page = (results / "thesis.md").read_text()
    assert "not stated: both start from the dyadic grid" in " ".join(page.split())
    assert (results / "thesis" / "figure_18.png").stat().st_size > 10_000


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


def test_the_summary_names_what_was_not_reached_and_what_was_not_reproduced(tmp_path: Path) -> None:
    def run_it(_: Settings) -> Outcome:
        rows = [
            row(None, 2.0, judge="wanted", wanted=1.0),
            row(1.0, 9.0, reason="because"),
            row(1.0, 1.0, reason="fine"),
        ]
        return Outcome(rows=rows)

    results = run([Experiment(name="one", title="One", run=run_it)], tmp_path)
    assert "at most 1 | 2 | not reached" in wanted_table(results)
    assert "| 1 | 9 | not reproducible | because |" in causes(results)
    assert "fine" not in causes(results)


PAGE = Path(__file__).resolve().parents[2] / "docs" / "thesis.md"


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
