from __future__ import annotations

import inspect
import json
import os
import re
import shutil
import struct
import subprocess
import sys
from collections import Counter
from pathlib import Path

import msgspec
import numpy as np
import pytest
from typer.testing import CliRunner

import rwn
from rwn import _core
from rwn.errors import InputError
from rwn.studies.thesis.archive import ARCHIVE, Archived, numbers, read_archive
from rwn.studies.thesis.check import differences
from rwn.studies.thesis.cli import app
from rwn.studies.thesis.comparison import markdown_table
from rwn.studies.thesis.dependencies import sources
from rwn.studies.thesis.experiment import Experiment, Outcome, Row, Search, Settings, curve, median_row
from rwn.studies.thesis.formats import number
from rwn.studies.thesis.overview import NUMBERS, answers, counts, totals
from rwn.studies.thesis.page import write_page
from rwn.studies.thesis.registry import EXPERIMENTS, select
from rwn.studies.thesis.runner import run
from rwn.studies.thesis.summary import wanted_table
from rwn.studies.thesis.words import word


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
    assert tables <= {row.where for row in done.rows}
    for found in done.searches:
        assert all(len(values) == len(found.numbers) for values in found.lines.values())
        assert found.taken in ("", *found.lines)
    for row in done.rows:
        assert row.ours is None or np.isfinite(row.ours)
        assert row.thesis is not None or not row.answer
        assert row.count or row.judge in ("none", "claim")
    assert len(experiment.choices) > 80, "the file must state at its top what the thesis leaves open"


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


def row(thesis: float | None, ours: float | None, **rest: object) -> Row:
    return Row(where="Table 0", case="c", thesis=thesis, ours=ours, **rest)  # type: ignore[arg-type]


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
    run([one(calls)], tmp_path, count="tiny")
    assert len(calls) == 2, "another count is another run"


def test_a_result_depends_on_the_helpers_of_its_experiment() -> None:
    found = sources("rwn.studies.thesis.viscous")
    assert {"rwn.studies.thesis.linear", "rwn.studies.thesis.drive", "rwn.networks.rates.thesis"} <= set(found)
    assert "rwn.networks.online_training" in found, "reached by `rwn.train_structured`"
    assert "rwn.diagnose" not in found, "and not all that `import rwn` offers"
    assert "rwn.studies.thesis.pictures" not in found


PATCHED = """
import sys
from collections import Counter
from pathlib import Path
from rwn.studies.thesis.registry import select
from rwn.studies.thesis.runner import run
done = run([e for e in select() if e.name == "siso-trainers"], Path(sys.argv[1]), count="tiny")[0]
print(done.fingerprint, done.rows[0].ours)
"""


def test_another_kernel_makes_the_results_again(tmp_path: Path) -> None:
    """A constant of the kernels' exponential is altered in a copy of the package: the experiment runs again, and
    says another number."""
    package = tmp_path / "python" / "rwn"
    shutil.copytree(Path(rwn.__file__).parent, package, ignore=shutil.ignore_patterns("__pycache__"))

    def result() -> list[str]:
        answer = subprocess.run(
            [sys.executable, "-c", PATCHED, str(tmp_path / "results")],
            env={**os.environ, "PYTHONPATH": str(package.parent)},
            capture_output=True,
            text=True,
            check=True,
        )
        return answer.stdout.split()

    first = result()
    assert result() == first
    core = package / Path(_core.__file__).name
    constant = struct.pack("<d", 0.50000000000000010221)  # of r^2 in exp, cpp/include/rwn/numerics/pack.hpp
    code = core.read_bytes()
    assert constant in code
    core.unlink()
    core.write_bytes(code.replace(constant, struct.pack("<d", 0.51)))
    second = result()
    assert second[0] != first[0]
    assert second[1] != first[1]


def test_the_results_do_not_depend_on_the_number_of_jobs(tmp_path: Path) -> None:
    chosen = [e for e in EXPERIMENTS if e.name in ("siso-size", "siso-rate", "siso-wavelets")]
    alone = run(chosen, tmp_path / "alone", count="tiny")
    together = run(chosen, tmp_path / "together", count="tiny", jobs=3)
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
def test_the_command_prints_the_comparison_and_writes_the_page(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    answer = CliRunner().invoke(app, ["run", "--figure", "26", "--quick", "--out", str(tmp_path)])
    assert answer.exit_code == 0, answer.output
    assert "Table 7" in answer.output
    page = (tmp_path / "thesis.md").read_text()
    assert page.index("Shortened") < page.index("## Overview") < page.index("| Table 7 | 2 |")
    assert "not stated: both start from the dyadic grid" in " ".join(page.split())
    assert (tmp_path / "thesis" / "figure_26.png").stat().st_size > 10_000


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
            row(1.0, 9.0, reason="because", answer=True),
            row(1.0, 1.0, reason="fine", answer=True),
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
    assert "| 1 | 9 |  | not reproducible | because |" in page
    assert "| reproduced |  |" in page, "no cause is asked"
    assert "| **small** | 1.5 | diverged | 1 of 2 |" in page
    assert "Shortened" not in page
    assert page.index("## Overview") < page.index("## Choices") < page.index("## Beyond the thesis")


def test_check_names_what_differs_from_an_archive(tmp_path: Path) -> None:
    value = 1.0

    def run_it(_: Settings) -> Outcome:
        return Outcome(rows=[row(1.0, value, answer=True), row(None, 3.0 * value, judge="none")])

    experiment, archive = Experiment(name="one", title="One", run=run_it), tmp_path / "archive.json"
    (done,) = run([experiment], tmp_path / "first")
    kept = Archived(
        name="one", count="full", fingerprint=done.fingerprint, made=done.made, seconds=1.0, numbers=numbers(done)
    )
    archive.write_bytes(msgspec.json.encode([kept]))
    for value, code, text in ((1.04, 0, "0 differ"), (1.5, 0, "1 differ"), (9.0, 1, "1 (reproduced) archived, 9 (not")):
        out = tmp_path / f"{value}"
        run([experiment], out)
        answer = CliRunner().invoke(app, ["check", "--archive", str(archive), "--out", str(out)])
        assert answer.exit_code == code, answer.output
        assert text in answer.output
    run([experiment], tmp_path / "short", count="tiny")
    shortened = CliRunner().invoke(app, ["check", "--archive", str(archive), "--out", str(tmp_path / "short")])
    assert shortened.exit_code == 1
    assert "missing found" in shortened.output, "shortened results say nothing of the archive's"


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (["check", "--out", "{0}/nothing"], "no results here"),
        (["check", "--archive", "{0}/nothing"], "no archive"),
        (["archive", "--out", "{0}/one", "--to", "{0}/a.json"], "84 of 85 numbers missing"),
    ],
)
def test_what_is_no_archive_and_no_result_is_refused(options: list[str], text: str, tmp_path: Path) -> None:
    experiment = Experiment(name="one", title="One", run=lambda _: Outcome(rows=[row(1.0, 1.0, answer=True)]))
    run([experiment], tmp_path / "one")
    answer = CliRunner().invoke(app, [option.format(tmp_path) for option in options])
    assert isinstance(answer.exception, InputError)
    assert text in str(answer.exception)
    assert not (tmp_path / "a.json").exists()


def test_the_archive_holds_the_numbers_that_the_page_shows() -> None:
    """`rwn thesis archive` writes the one, `rwn thesis run --all --page` the other."""
    found = [n for archived in read_archive() for n in archived.numbers]
    assert Counter(n.where for n in found) == NUMBERS
    assert ARCHIVE.stat().st_size < 200_000
    page = PAGE.read_text(encoding="utf-8")
    for n in found:
        (line,) = re.findall(rf"^\| {re.escape(f'{n.where} | {n.case} |')}.*\| {n.word} \|.*$", page, re.MULTILINE)[:1]
        assert f"| {number(n.thesis, n.unit)} | {number(n.ours, n.unit)} |" in line


def test_the_code_gives_the_archived_numbers(tmp_path: Path) -> None:
    """Those of Table 19, in full; `rwn thesis check` runs every short experiment."""
    (done,) = run([e for e in EXPERIMENTS if e.name == "three-parameters"], tmp_path)
    old = [archived for archived in read_archive() if archived.name == done.name]
    assert sum(len(archived.numbers) for archived in old) == 5
    assert not list(differences(old, {done.name: done}))


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
