"""`rwn thesis`: repeats the experiments of the thesis."""

from __future__ import annotations

import importlib.util
import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rwn.errors import InputError
from rwn.report.output_files import check_file, check_folder

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rwn.studies.thesis.experiment import Count, Experiment
    from rwn.studies.thesis.runner import Finished

app = typer.Typer(help="Repeats the tables and figures of Zahidi's thesis.", no_args_is_help=True)


@app.callback()
def thesis() -> None:
    """Repeats the tables and figures of Zahidi's thesis."""


@app.command("list")
def list_experiments() -> None:
    """Lists the experiments with their tables and figures."""
    from rwn.studies.thesis.registry import EXPERIMENTS, ranges

    for e in EXPERIMENTS:
        typer.echo(f"{e.name:20} tables {ranges(e.tables):6} figures {ranges(e.figures):18} {e.title}")


@app.command()
def run(
    *,
    table: Annotated[int | None, typer.Option(help="Only the experiment of this table.")] = None,
    figure: Annotated[int | None, typer.Option(help="Only the experiment of this figure.")] = None,
    everything: Annotated[bool, typer.Option("--all", help="Every experiment.")] = False,
    out: Annotated[Path, typer.Option(help="Finished experiments are kept here; a rerun resumes.")] = Path(
        "thesis-results"
    ),
    quick: Annotated[
        bool, typer.Option("--quick", help="Shortened counts, at most five minutes: a look, not a repetition.")
    ] = False,
    seeds: Annotated[
        int, typer.Option(min=1, help="Starts of the trainings over all cycles (Tables 11-16, 20; Figures 46-54).")
    ] = 1,
    jobs: Annotated[int, typer.Option(min=1, help="Experiments at a time.")] = os.cpu_count() or 1,
    page: Annotated[Path | None, typer.Option(help="The page to write; default OUT/thesis.md.")] = None,
) -> None:
    """Runs experiments, prints the comparison and writes the page with its pictures."""
    from rwn.studies.thesis.registry import select

    if [table is not None, figure is not None, everything].count(True) != 1:
        raise InputError(
            "which experiments?",
            where="rwn thesis run",
            expected="one of --table N, --figure N and --all",
            fix="`rwn thesis list` shows what there is",
        )
    experiments = select(table=table, figure=figure)
    count: Count = "quick" if quick else "full"
    _run(experiments, out, count=count, seeds=seeds, jobs=jobs, page=page or out / "thesis.md")


@app.command()
def check(
    *,
    out: Annotated[
        Path | None, typer.Option(help="Results to check; without, the short experiments are run anew, in full.")
    ] = None,
    archive: Annotated[Path | None, typer.Option(help="An archive; default the one of this package.")] = None,
) -> None:
    """Holds results against the archived numbers; exit code 1 where a word changed or a number is missing."""
    from tempfile import TemporaryDirectory

    from rwn.studies.thesis.archive import ARCHIVE, read_archive, results
    from rwn.studies.thesis.check import differences
    from rwn.studies.thesis.registry import EXPERIMENTS
    from rwn.studies.thesis.runner import SHORT

    old = list(read_archive(archive or ARCHIVE))
    if out is None:
        full = {a.name for a in old if a.count == "full"}
        short = [e for e in EXPERIMENTS if e.minutes <= SHORT and e.name in full]
        with TemporaryDirectory() as folder:
            new = {done.name: done for done in _with_progress(short, Path(folder), "full", 1, os.cpu_count() or 1)}
        old = [a for a in old if a.name in new]
    else:
        new = results(out)
    for m in dict.fromkeys(a.made for a in old):
        typer.echo(f"archived {m.date} from {m.commit} on {m.machine}")
    found = list(differences(old, new))
    for d in found:
        typer.echo(f"{d.where}, {d.case}: {d.archived} archived, {d.found} found")
    changed, of = sum(d.changed for d in found), sum(len(a.numbers) for a in old)
    typer.echo(f"{of} numbers checked, {len(found)} differ by more than 5 %, {changed} in their word or missing")
    raise typer.Exit(1 if changed else 0)


@app.command("page")
def page_of_results(
    *,
    out: Annotated[Path, typer.Option(help="Results of experiments.")] = Path("thesis-results"),
    page: Annotated[Path | None, typer.Option(help="The page to write; default OUT/thesis.md.")] = None,
) -> None:
    """Writes the page anew from results that are there, in today's words; runs nothing."""
    from rwn.studies.thesis.archive import results
    from rwn.studies.thesis.page import write_page
    from rwn.studies.thesis.registry import EXPERIMENTS

    target = page or out / "thesis.md"
    found = results(out)
    _check_page(target)
    write_page([found[e.name] for e in EXPERIMENTS if e.name in found], target)
    typer.echo(f"page: {target}")


@app.command("archive")
def archive_results(
    *,
    out: Annotated[Path, typer.Option(help="Results of every experiment.")] = Path("thesis-results"),
    to: Annotated[Path | None, typer.Option(help="The file; default the one of this package.")] = None,
) -> None:
    """Writes the archive that `check` holds results against."""
    from rwn.studies.thesis.archive import ARCHIVE, results, write_archive

    kept = write_archive(results(out).values(), to or ARCHIVE)
    typer.echo(f"{sum(len(a.numbers) for a in kept)} numbers: {to or ARCHIVE}")


@app.command("real-machine")
def real_machine(
    folder: Annotated[Path, typer.Argument(help="The folder of FRA233, with sine_1.mat, ramp_1.mat and others.")],
) -> None:
    """The network of chapter 4 for the friction of a real machine, recurrent and static."""
    from rich.console import Console

    from rwn.studies.thesis.real_machine import compare, table

    stands, heldout = compare(folder)
    Console().print(table(stands, heldout))


@app.command("table-20")
def table_20(
    *, page: Annotated[Path, typer.Option(help="The page to write.")] = Path("table_20.md")
) -> None:
    """Writes a page that walks through Table 20, from the recording to the friction curve."""
    from rwn.studies.thesis.walk_through_page import write_walk_through

    _check_page(page)
    write_walk_through(page)
    typer.echo(f"page: {page}")


def _run(experiments: Sequence[Experiment], out: Path, *, count: Count, seeds: int, jobs: int, page: Path) -> None:
    from rich.console import Console

    from rwn.studies.thesis.comparison import rich_table
    from rwn.studies.thesis.overview import overview_table
    from rwn.studies.thesis.page import write_page

    check_folder(out)
    _check_page(page)
    console = Console()
    if not console.is_terminal:
        console = Console(width=160)  # a file or a pipe has room
    results = _with_progress(experiments, out, count, seeds, jobs)
    console.print(rich_table(results))
    console.print(overview_table(results))
    seconds = sum(r.seconds for r in results)
    console.print(f"{seconds:.0f} s of processor time" + ("" if count == "full" else "; shortened counts"))
    write_page(results, page)
    console.print(f"page: {page}")


def _check_page(page: Path) -> None:
    """What a page needs is there before hours of experiments, not found missing after them. Raises InputError."""
    if importlib.util.find_spec("matplotlib") is None:
        raise InputError(
            "the pictures of the page need matplotlib, which is not installed",
            where="rwn thesis",
            expected="the extra 'thesis'",
            fix="pip install 'rwn[thesis]'",
        )
    check_file(page)


def _with_progress(
    experiments: Sequence[Experiment], out: Path, count: Count, seeds: int, jobs: int
) -> list[Finished]:
    """Runs them; a bar of all on stderr, with the time left at the weights of the experiments, and one
    of each that is under way."""
    from rich.console import Console
    from rich.progress import Progress

    from rwn.studies.thesis.runner import run as run_experiments

    done = dict.fromkeys([e.name for e in experiments], 0.0)
    weights = {e.name: e.minutes_of(seeds) for e in experiments}
    with Progress(console=Console(stderr=True)) as bars:
        every = bars.add_task("all", total=sum(weights.values()))  # first, where a short terminal shows it
        tasks = {e.name: bars.add_task(e.name, total=1.0, visible=False) for e in experiments}

        def show(experiment: Experiment, share: float) -> None:
            done[experiment.name] = share
            bars.update(tasks[experiment.name], completed=share, visible=share < 1.0)
            bars.update(every, completed=sum(weights[name] * part for name, part in done.items()))

        return run_experiments(experiments, out, count=count, seeds=seeds, jobs=jobs, progress=show)
