"""The command line. Bad input ends with exit code 2 and one line on stderr, and writes nothing."""

from __future__ import annotations

import importlib.util
import shlex
import shutil
import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from rwn import completion
from rwn.endings import NO_RESULT, run
from rwn.errors import InputError

if TYPE_CHECKING:
    from rwn.model.model import Model

app = typer.Typer(
    name="rwn",
    help="Says what physics a drive simulation leaves out, from recordings of the real drive.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)

Recordings = Annotated[list[Path], typer.Argument(metavar="RECORDING...", help="Files to fit to, of any format.")]
ModelFile = Annotated[Path, typer.Option("--model", help="The nominal model (TOML).")]
Profile = Annotated[
    str | None,
    typer.Option("--profile", help="What wrote them: odrive, moteus, twincat ..", autocompletion=completion.profiles),
]
Overwrite = Annotated[bool, typer.Option("--overwrite", help="Replace results that exist.")]


@app.command()
def diagnose(
    recordings: Recordings,
    model: ModelFile,
    out: Annotated[
        Path, typer.Option("--out", help="Folder for report.html, diagnosis.json, curves.json, corrected.toml.")
    ],
    heldout: Annotated[
        list[Path] | None, typer.Option("--heldout", help="A file to judge by, never fitted to; repeatable.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of everything random.")] = 0,
    jobs: Annotated[int | None, typer.Option(min=1, help="Processors to use (default: all).")] = None,
    effort: Annotated[float, typer.Option(min=0.1, max=1e3, help="Cost of the search, over the usual.")] = 1.0,
    overwrite: Overwrite = False,
    profile: Profile = None,
) -> None:
    """Name the missing physics, model it, prove it and draw where it lies; exit code 3: the model does not run."""
    from rwn.model.recordings import read_recordings
    from rwn.report.output_files import output_folder
    from rwn.report.provenance import sources
    from rwn.report.terminal import print_verdict

    _refuse_strays(sys.argv)
    with output_folder(out, overwrite=overwrite, inputs=[model, *recordings, *(heldout or [])]) as aside:
        nominal = _model(model, profile)
        files = read_recordings([*recordings, *(heldout or [])], nominal)
        fitted, judged = files[: len(recordings)], files[len(recordings) :]
        with _progress() as progress:
            options = {"seed": seed, "jobs": jobs, "effort": effort, "progress": progress}
            found = _rwn().diagnose(fitted, nominal, heldout=judged, **options)
        used = sources(model, fitted, judged)
        found = replace(found, sources=used, command=shlex.join(["rwn", *sys.argv[1:]]))
        found.write(aside)
    print_verdict(found, out)


def _refuse_strays(arguments: list[str]) -> None:
    """A file after `--heldout FILE` would be fitted to, which is hardly what is meant."""
    kept, apart = "", [part for text in arguments for part in (text.split("=", 1) if text.startswith("--") else [text])]
    for flag, stray in pairwise(apart):
        if flag == "--heldout":
            kept = stray
        elif kept and not stray.startswith("-") and (flag == "--overwrite" or not flag.startswith("--")):
            raise InputError(
                f"'{stray}' follows --heldout {kept}", where="command line",
                expected="--heldout before each file that is kept back, files to fit before all options",
                fix=f"write --heldout {stray}, or move it to the front",
            )  # fmt: skip


@app.command()
def simulate(
    model: Annotated[Path, typer.Argument(metavar="MODEL.toml", help="A model file.")],
    recording: Annotated[Path, typer.Option("--input", help="Recording whose input signal drives the model.")],
    out: Annotated[Path, typer.Option("--out", help="CSV to write.")],
    overwrite: Overwrite = False,
    partial: Annotated[bool, typer.Option("--partial", help="Write a run that did not reach its end too.")] = False,
    profile: Profile = None,
) -> None:
    """Run a model freely from the input signal of a recording, in its units; exit code 3 where it ends before that."""
    from rwn.model.recordings import read_recordings
    from rwn.recording.recording import write_csv
    from rwn.report.output_files import output_file
    from rwn.report.simulated import simulated

    with output_file(out, overwrite=overwrite, inputs=[model, recording]) as aside:
        drive = _model(model, profile)
        (source,) = read_recordings([recording], drive, compared=False)
        run = _rwn().simulate(drive, source)
        if run.status == "ok" or partial:
            write_csv(aside, run.time, run.signals, linear=drive.linear, units=source.units)
    if run.status != "ok":
        done = f"The signals in {out} are held from there on." if partial else "Nothing was written."
        typer.echo(f"rwn: {run.status}: {run.advice} {done}", err=True)
        raise typer.Exit(NO_RESULT)
    typer.echo("\n".join(simulated(run, source, out)))


@app.command()
def check(recordings: Recordings, model: ModelFile, profile: Profile = None) -> None:
    """What is odd in recordings, before any physics, and what a diagnosis does about it."""
    from rwn.model.recordings import read_recordings
    from rwn.report.recording_check import checked

    drive = _model(model, profile)
    for line in checked(read_recordings(recordings, drive), drive):
        typer.echo(line)


@app.command()
def identify(
    recordings: Recordings,
    model: ModelFile,
    out: Annotated[Path | None, typer.Option("--out", help="Model file to write.")] = None,
    overwrite: Overwrite = False,
    profile: Profile = None,
) -> None:
    """Fit the parameters of a model, effects included, within their declared uncertainty.

    Ends with exit code 3, and writes nothing, where the fit does not converge, ends at a limit or describes no signal,
    or where a wrong sign, unit or gear explains most of what it leaves.
    """
    from contextlib import nullcontext

    from rwn.model.files import write_model
    from rwn.model.recordings import read_recordings
    from rwn.report import identification
    from rwn.report.output_files import output_file

    with output_file(out, overwrite=overwrite, inputs=[model, *recordings]) if out else nullcontext() as aside:
        nominal = _model(model, profile)
        files = read_recordings(recordings, nominal)
        fit = _rwn().identify(files, nominal)
        for line in identification.lines(fit, nominal):
            typer.echo(line, err=line.startswith("warning"))
        if fit.failure:
            typer.echo(f"rwn: {fit.failure}" + (f"; {out} was not written" if out else ""), err=True)
            raise typer.Exit(NO_RESULT)
        if aside is not None:
            write_model(fit.model, aside)


@app.command()
def effects(
    name: Annotated[
        list[str] | None,
        typer.Argument(help="One effect, in detail, or a word of it.", autocompletion=completion.effect_names),
    ] = None,
    model: Annotated[Path | None, typer.Option("--model", help="A model file: its own effects as well.")] = None,
) -> None:
    """The effects that rwn can name: site, equation, parameters, source; also by a word: rwn effects friction."""
    from rwn.model import vocabulary as known
    from rwn.model.effect_search import effects_by_word, nothing_mentions
    from rwn.model.files import read_model
    from rwn.report.effect_text import lines

    table = read_model(model).effect_table if model else known.table()
    wanted = " ".join(name or [])
    found = [table[wanted]] if wanted in table else effects_by_word(wanted, table) if wanted else list(table.values())
    if not found:
        raise nothing_mentions(wanted, table)
    width = shutil.get_terminal_size().columns if sys.stdout.isatty() else None
    for line in lines(found, width=width):
        typer.echo(line)


@app.command()
def report(
    folders: Annotated[list[Path], typer.Argument(metavar="RESULT...", help="Folders that rwn diagnose wrote.")],
    out: Annotated[Path, typer.Option("--out", help="HTML file to write.")],
    compare: Annotated[bool, typer.Option("--compare", help="Set two results beside each other.")] = False,
    overwrite: Overwrite = False,
) -> None:
    """Draw the report of a result anew, or compare two: before and after a repair."""
    from rwn.report.comparison import comparison
    from rwn.report.diagnosis import Diagnosis
    from rwn.report.exchange import CURVES, MODEL, RESULT
    from rwn.report.output_files import output_file
    from rwn.report.page import page

    if len(folders) != (2 if compare else 1):
        raise InputError(
            f"{len(folders)} result(s) {'with' if compare else 'without'} --compare",
            where="rwn report",
            expected="one result, or two and --compare",
            fix="rwn report before after --compare --out comparison.html",
        )
    inputs = [folder / name for folder in folders for name in (RESULT, CURVES, MODEL)]
    with output_file(out, overwrite=overwrite, inputs=inputs) as aside:
        found = [Diagnosis.load(folder) for folder in folders]
        text = comparison(found[0], found[1], (str(folders[0]), str(folders[1]))) if compare else page(found[0])
        aside.write_text(text, encoding="utf-8")
    typer.echo(f"Report: {out}")


@app.command()
def demo(
    out: Annotated[Path, typer.Option("--out", help="Folder for the results.")] = Path("demo-out"),
    overwrite: Overwrite = False,
) -> None:
    """Diagnose the recording that comes with rwn, whose missing effect is known."""
    folder = Path(__file__).parent / "demo"
    train = sorted(folder.glob("train*.csv"))
    if not train:
        raise InputError("the demo recording is not installed", where=folder, expected="train.csv", fix="reinstall rwn")
    diagnose(train, folder / "model.toml", out, sorted(folder.glob("heldout*.csv")), overwrite=overwrite)


@app.command()
def evidence(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[NAME]...", help="Machines (default: all).", autocompletion=completion.machines),
    ] = None,
    data: Annotated[Path, typer.Option("--data", help="Folder of the recordings.")] = Path("../shared/data"),
    out: Annotated[Path, typer.Option("--out", help="Folder for the table and reports.")] = Path("evidence-out"),
    by_hand: Annotated[
        bool, typer.Option("--by-hand", help="Also the error of a physical fit made by hand with scipy.")
    ] = False,
    page: Annotated[
        Path | None, typer.Option("--page", help="Markdown page whose sections of these machines are written anew.")
    ] = None,
    overwrite: Overwrite = False,
) -> None:
    """Diagnose recordings of real machines: what was found, and the error on recordings that were not fitted."""
    from rwn.report.output_files import output_folder
    from rwn.studies.machines.runner import run_machines

    with output_folder(out, overwrite=overwrite) as aside:
        table = run_machines(names or [], data, aside, by_hand=by_hand, page=page)
    typer.echo(table)


@app.callback(invoke_without_command=True)
def _options(version: Annotated[bool, typer.Option("--version", help="Print the version.")] = False) -> None:
    if version:
        typer.echo(_rwn().__version__)
        raise typer.Exit


def _rwn() -> Any:
    """The library, late: starting the command line should not cost its imports."""
    return importlib.import_module("rwn")


def _progress() -> Any:
    from rwn.report.progress import Progress

    return Progress(sys.stderr)


def _model(path: Path, profile: str | None) -> Model:
    from rwn.model.files import read_model
    from rwn.recording.profiles import known_profile

    model, name = read_model(path), known_profile(profile, where="--profile")
    return replace(model, recording=replace(model.recording, profile=name)) if name else model


def _mount(name: str, module: str) -> None:
    """Another package's commands, where it is installed whole; imported only when they are called for."""
    wanted = len(sys.argv) < 2 or sys.argv[1] in (name, "--help")
    try:
        if wanted and importlib.util.find_spec(module) is not None:
            app.add_typer(importlib.import_module(module).app, name=name)
    except ModuleNotFoundError:
        return  # not part of this installation


def _command() -> Any:
    for name in ("thesis", "trials"):
        _mount(name, f"rwn.studies.{name}.cli")
    return app(standalone_mode=False, prog_name="rwn")  # also as `python -m rwn`: the shell completes this name


def main() -> None:
    """The entry point `rwn`."""
    run(_command)
