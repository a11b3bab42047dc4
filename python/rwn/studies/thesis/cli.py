"""`rwn thesis`: repeats the experiments of the thesis."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rwn.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rwn.studies.thesis.experiment import Experiment

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
    reduced: Annotated[
        bool, typer.Option("--reduced", help="Small counts: a quick look, not a proof.")
    ] = False,
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
    _run(experiments, out, reduced=reduced, jobs=jobs, page=page or out / "thesis.md")


@app.command("table-20")
def table_20(
    *, page: Annotated[Path, typer.Option(help="The page to write.")] = Path("table_20.md")
) -> None:
    """Writes a page that walks through Table 20, from the recording to the friction curve."""
    from rwn.studies.thesis.walk_through_page import write_walk_through

    write_walk_through(page)
    typer.echo(f"page: {page}")


def _run(experiments: Sequence[Experiment], out: Path, *, reduced: bool, jobs: int, page: Path) -> None:
    from rich.console import Console
    from rich.progress import Progress

    from rwn.studies.thesis.comparison import rich_table, tally
    from rwn.studies.thesis.page import write_page
    from rwn.studies.thesis.runner import run as run_experiments

    console = Console()
    if not console.is_terminal:
        console = Console(width=160)  # a file or a pipe has room
    with Progress(console=Console(stderr=True)) as bars:
        tasks = {e.name: bars.add_task(e.name, total=1.0) for e in experiments}
        results = run_experiments(
            experiments,
            out,
            reduced=reduced,
            jobs=jobs,
            progress=lambda e, share: bars.update(tasks[e.name], completed=share),
        )
    console.print(rich_table(results))
    console.print(
        ", ".join(f"{w}: {n}" for w, n in tally(results).items()),
        f"in {sum(r.seconds for r in results):.0f} s",
    )
    write_page(results, page)
    console.print(f"page: {page}")
