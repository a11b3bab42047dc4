"""Results of the thesis's experiments: kept, made again where what they depend on has changed, held to the archive."""

from __future__ import annotations

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
import pytest
from typer.testing import CliRunner

import rwn
from rwn import _core
from rwn.errors import InputError
from rwn.studies.thesis.archive import ARCHIVE, Archived, numbers, read_archive
from rwn.studies.thesis.causes import CAUSES, cause
from rwn.studies.thesis.check import differences
from rwn.studies.thesis.cli import app
from rwn.studies.thesis.dependencies import sources
from rwn.studies.thesis.experiment import Experiment, Outcome, Row, Settings
from rwn.studies.thesis.formats import number
from rwn.studies.thesis.overview import NUMBERS
from rwn.studies.thesis.registry import EXPERIMENTS
from rwn.studies.thesis.runner import Finished, run
from thesis_rows import PAGE, row


def one(calls: list[int]) -> Experiment:
    def run_it(settings: Settings) -> Outcome:
        calls.append(1)
        settings.progress(0.5)
        return Outcome(rows=[row(1.0, 1.0)])

    return Experiment(name="one", title="One", run=run_it)


def archived(done: Finished) -> Archived:
    return Archived(
        name=done.name,
        count=done.count,
        fingerprint=done.fingerprint,
        made=done.made,
        seconds=done.seconds,
        numbers=numbers(done),
        seeds=done.seeds,
    )


def test_a_finished_experiment_is_not_run_again(tmp_path: Path) -> None:
    calls: list[int] = []
    first = run([one(calls)], tmp_path)
    assert run([one(calls)], tmp_path) == first
    assert len(calls) == 1
    run([one(calls)], tmp_path, count="tiny")
    assert len(calls) == 2, "another count is another run"


@pytest.mark.slow
def test_the_longest_trainings_are_made_from_as_many_seeds_as_asked(tmp_path: Path) -> None:
    asked: list[int] = []

    def run_it(settings: Settings) -> Outcome:
        asked.append(settings.seeds)
        return Outcome(rows=[row(1.0, 1.0, answer=True)])

    long, short = (
        Experiment(name=name, title=name, run=run_it, seed_minutes=minutes)
        for name, minutes in (("long", 1.0), ("short", 0.0))
    )
    found = run([long, short], tmp_path, seeds=3)
    assert (asked, [f.seeds for f in found]) == ([3, 1], [3, None])
    run([long, short], tmp_path, seeds=3)
    run([long, short], tmp_path)
    assert asked == [3, 1, 1], "another number of seeds is another run, where there are such trainings"
    old = archived(found[0])
    (one,) = run([long], tmp_path)
    (difference,) = differences([old], {"long": one})
    assert (difference.found, difference.changed) == ("missing (--seeds 1, the archive has 3)", True)


@pytest.mark.slow
def test_every_start_has_its_own_training_and_the_median_speaks(tmp_path: Path) -> None:
    experiment = next(e for e in EXPERIMENTS if e.name == "structured-friction")
    shares: list[float] = []
    (one,) = run([experiment], tmp_path / "1", count="tiny")
    (three,) = run([experiment], tmp_path / "3", count="tiny", seeds=3, progress=lambda _, s: shares.append(s))
    alone, among = (next(r for r in done.rows if r.answer) for done in (one, three))
    assert alone.spread == (alone.ours, alone.ours)
    assert among.count.endswith("3 seeds")
    low, high = among.spread or (0.0, 0.0)
    assert low <= min(alone.ours or 0.0, among.ours or 0.0) < high
    assert one.figures == three.figures, "of the first seed"
    assert shares == sorted(shares)


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


@pytest.mark.slow
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


def test_check_names_what_differs_from_an_archive(tmp_path: Path) -> None:
    value = 1.0

    def run_it(_: Settings) -> Outcome:
        return Outcome(rows=[row(1.0, value, answer=True), row(None, 3.0 * value, judge="none")])

    experiment, archive = Experiment(name="one", title="One", run=run_it), tmp_path / "archive.json"
    (done,) = run([experiment], tmp_path / "first")
    archive.write_bytes(msgspec.json.encode([archived(done)]))
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
    found = [n for kept in read_archive() for n in kept.numbers]
    assert Counter(n.where for n in found) == NUMBERS
    assert ARCHIVE.stat().st_size < 200_000
    page = PAGE.read_text(encoding="utf-8")
    for n in found:
        (line,) = re.findall(rf"^\| {re.escape(f'{n.where} | {n.case} |')}.*\| {n.word} \|.*$", page, re.MULTILINE)[:1]
        assert f"| {number(n.thesis, n.unit)} | {number(n.ours, n.unit)} |" in line


def test_every_number_that_is_not_reproduced_has_a_cause() -> None:
    for n in (n for kept in read_archive() for n in kept.numbers if n.word != "reproduced"):
        assert cause(Row(where=n.where, case=n.case, thesis=n.thesis, ours=n.ours, answer=True)), f"{n.where}, {n.case}"


@pytest.mark.parametrize(("where", "said"), [(where, said) for where, _, said in CAUSES if "(choices" in said])
def test_the_choices_that_a_cause_points_to_are_on_the_page(where: str, said: str) -> None:
    pointed = re.search(r"\(choices of Table (\d+)\)", said)
    wanted = pointed[1] if pointed else where.split()[1]
    titles = re.findall(r"^\*\*((?:Table|Figure).*)\*\*", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    assert any(wanted in re.findall(r"\d+", title.partition(":")[0]) for title in titles), said


def test_the_code_gives_the_archived_numbers(tmp_path: Path) -> None:
    """Those of Table 19, in full; `rwn thesis check` runs every short experiment."""
    (done,) = run([e for e in EXPERIMENTS if e.name == "three-parameters"], tmp_path)
    old = [kept for kept in read_archive() if kept.name == done.name]
    assert sum(len(kept.numbers) for kept in old) == 5
    assert not list(differences(old, {done.name: done}))
