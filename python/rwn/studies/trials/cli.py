"""`rwn trials make | spoil | run | score`: the proof on recordings whose missing physics is concealed."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    help="Blind trials: make recordings with concealed physics, diagnose them, score the answers.",
)

Folder = Annotated[Path, typer.Argument(help="Folder of trials, each with a model.toml.", exists=True)]
Results = Annotated[
    Path | None, typer.Option(help="Diagnoses go to a folder per trial in here (default: TRIAL/out).")
]
Jobs = Annotated[int, typer.Option(min=1, help="Processes.")]


@app.command()
def make(
    seed: Annotated[int, typer.Option(help="A seed: below 10000 for development, from 10000 on for tests.")],
    count: Annotated[int, typer.Option(min=1, help="Number of trials.")],
    out: Annotated[Path, typer.Option(help="Folder to make.")],
    first: Annotated[int | None, typer.Option(min=1, help="Make so many of the COUNT, from the first on.")] = None,
    split: Annotated[str | None, typer.Option(help="development or test; must agree with the seed.")] = None,
    bench: Annotated[bool, typer.Option("--bench", help="Imperfect recordings, unnamed physics, two judges.")] = False,
    judge: Annotated[str | None, typer.Option(help="With --bench: plant or mujoco alone (default: both).")] = None,
    jobs: Jobs = 2,
) -> None:
    """Make COUNT trials with independent plants and seal their answers."""
    from rwn.report.output_files import check_folder
    from rwn.studies.trials import make as sets

    check_folder(out)
    if judge is not None and not bench:
        raise ValueError("--judge is for trials of a bench; give --bench too")
    if bench:
        digest = sets.make_bench(
            seed, count, out, first=first, split=split, judge=judge, jobs=jobs, progress=_progress
        )
    else:
        digest = sets.make(seed, count, out, first=first, split=split, jobs=jobs, progress=_progress)
    made = f"{count} trials" if first is None else f"the first {first} of {count} trials"
    typer.echo(f"{made} in {out}; SHA-256 of the sealed answers: {digest}")


@app.command()
def spoil(
    folder: Annotated[Path, typer.Argument(help="A finished set of trials.", exists=True)],
    out: Annotated[Path, typer.Option(help="Folder to make.")],
) -> None:
    """Put a recording mistake (unit, sign, gear ratio, a channel out of step) into every trial of FOLDER."""
    from rwn.report.output_files import check_folder
    from rwn.studies.trials.spoil import spoil as spoil_set

    check_folder(out)
    digest = spoil_set(folder, out)
    typer.echo(f"the trials with mistakes in {out}; SHA-256 of the sealed answers: {digest}")


@app.command()
def run(folder: Folder, results: Results = None, jobs: Jobs = 2) -> None:
    """Diagnose every trial of FOLDER that has no diagnosis yet."""
    from rwn.report.output_files import check_folder
    from rwn.studies.trials.run import run as run_set

    if results is not None:
        check_folder(results)
    failed = run_set(folder, results=results, jobs=jobs, progress=_progress)
    if failed:
        typer.echo(f"{len(failed)} failed (see error.txt there): {', '.join(failed)}", err=True)
        raise typer.Exit(1)


@app.command()
def score(
    folders: Annotated[list[Path], typer.Argument(help="Folders of trials; several count as one set.", exists=True)],
    results: Annotated[
        Path | None,
        typer.Option(help="Where the diagnoses are; of several FOLDERS, in a folder for each (default: TRIAL/out)."),
    ] = None,
    plot: Annotated[Path | None, typer.Option(help="HTML file for the reliability plot.")] = None,
    page: Annotated[Path | None, typer.Option(help="Markdown page whose section of them is written anew.")] = None,
) -> None:
    """Open the sealed answers (or the answer.json files) and print how good the diagnoses are."""
    from rich.console import Console

    from rwn.studies.trials.bench_trials import grade as bench_grade
    from rwn.studies.trials.bench_trials import score as bench_score
    from rwn.studies.trials.bench_trials import tables as bench_tables
    from rwn.studies.trials.grade import grade_folders
    from rwn.studies.trials.page import check_page, write_page
    from rwn.studies.trials.score import reliability
    from rwn.studies.trials.tables import reliability_plot, shown

    if page is not None:
        check_page(page, folders)
    if any(bench_grade.is_bench(folder) for folder in folders):
        on_benches = bench_grade.grade_folders(folders, results=results)
        tables = bench_tables.shown(on_benches)
        bins = bench_score.reliability(on_benches.grades)
    else:
        graded = grade_folders(folders, results=results)
        tables = shown(graded)
        bins = reliability(graded.grades)
    console = Console(width=None if sys.stdout.isatty() else 150)  # a file has room
    for part in tables:
        console.print(part)
    if plot is not None:
        reliability_plot(bins, plot)
    if page is not None:
        write_page(page, folders, tables, results=results)


@app.command()
def calibrate(
    folders: Annotated[list[Path], typer.Argument(help="Development sets whose trials were run.", exists=True)],
    results: Annotated[Path | None, typer.Option(help="As for score.")] = None,
    out: Annotated[Path | None, typer.Option(help="Write calibration.json here (default: print alone).")] = None,
) -> None:
    """Fit the probability that an effect acts to the evidence and answers of development trials."""
    from rwn.studies.trials.calibrate import calibrated, names_of, origin, words, write

    names = names_of(folders, results=results)
    found = calibrated(names, what=origin(names.counted, folders, results=results))
    if out is not None:
        write(found.calibration, out)
    typer.echo(words(found))


def _progress(done: int, count: int, name: str) -> None:
    typer.echo(f"{done}/{count} {name}", err=True)
