"""The command line. Bad input ends with exit code 2 and one line on stderr, and writes nothing."""

from __future__ import annotations

import importlib
import importlib.util
import os
import shlex
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from rwn.errors import InputError, unknown

if TYPE_CHECKING:
    from rwn.report.diagnosis import Diagnosis

app = typer.Typer(
    name="rwn",
    help="Says what physics a drive simulation leaves out, from recordings of the real drive.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)

Recordings = Annotated[
    list[Path], typer.Argument(metavar="RECORDING...", help="CSV or .mat files to fit to.")
]
ModelFile = Annotated[Path, typer.Option("--model", help="The nominal model (TOML).")]
Overwrite = Annotated[bool, typer.Option("--overwrite", help="Replace results that exist.")]


@app.command()
def diagnose(
    recordings: Recordings,
    model: ModelFile,
    out: Annotated[
        Path, typer.Option("--out", help="Folder for diagnosis.json, corrected.toml, report.html.")
    ],
    heldout: Annotated[
        list[Path] | None, typer.Option("--heldout", help="A file to judge by, never fitted to; repeatable.")
    ] = None,
    seed: Annotated[int, typer.Option(help="Seed of everything random.")] = 0,
    jobs: Annotated[int | None, typer.Option(min=1, help="Processors to use (default: all).")] = None,
    overwrite: Overwrite = False,
) -> None:
    """Locate the mismatch, name the missing physics, model it and show that the simulation improves."""
    from rwn.model.files import read_model
    from rwn.model.recordings import read_recordings
    from rwn.report.files import output_folder
    from rwn.report.provenance import source

    _refuse_strays(sys.argv)
    with output_folder(out, overwrite=overwrite) as aside:
        nominal = read_model(model)
        files = read_recordings([*recordings, *(heldout or [])], nominal)
        fitted, judged = files[: len(recordings)], files[len(recordings) :]
        with _progress() as progress:
            found = _rwn().diagnose(fitted, nominal, heldout=judged, seed=seed, jobs=jobs, progress=progress)
        used = [
            source(model, "model"),
            *(source(r, "fit") for r in fitted),
            *(source(r, "heldout") for r in judged),
        ]
        found = replace(found, sources=tuple(used), command=shlex.join(["rwn", *sys.argv[1:]]))
        _write_results(found, aside)
    _print_verdict(found, out)


def _refuse_strays(arguments: list[str]) -> None:
    """A file after `--heldout FILE` would be fitted to, which is hardly what is meant."""
    for flag, kept, stray in zip(arguments, arguments[1:], arguments[2:], strict=False):
        if flag == "--heldout" and not stray.startswith("-"):
            raise InputError(
                f"'{stray}' follows --heldout {kept}",
                where="command line",
                expected="--heldout before each file that is kept back, files to fit before all options",
                fix=f"write --heldout {stray}, or move it to the front",
            )


@app.command()
def simulate(
    model: Annotated[Path, typer.Argument(metavar="MODEL.toml", help="A model file.")],
    recording: Annotated[
        Path, typer.Option("--input", help="Recording whose input signal drives the model.")
    ],
    out: Annotated[Path, typer.Option("--out", help="CSV to write.")],
    overwrite: Overwrite = False,
) -> None:
    """Run a model freely from the input signal of a recording."""
    from rwn.model.files import read_model
    from rwn.model.recordings import read_recordings
    from rwn.recording.recording import write_csv
    from rwn.report.files import output_file

    with output_file(out, overwrite=overwrite) as aside:
        drive = read_model(model)
        (source,) = read_recordings([recording], drive, compared=False)
        run = _rwn().simulate(drive, source)
        write_csv(aside, run.time, run.signals, linear=drive.linear)
    typer.echo(f"{len(run.time)} samples of {', '.join(run.signals)} in {out}")
    if run.status != "ok":
        typer.echo(f"warning: {run.status}: {run.advice} The signals are held from there on.", err=True)


@app.command()
def check(recordings: Recordings, model: ModelFile) -> None:
    """What is odd in recordings, before any physics, and what a diagnosis does about it."""
    from rwn.model.files import read_model
    from rwn.model.recordings import read_recordings
    from rwn.report.check import checked

    drive = read_model(model)
    for line in checked(read_recordings(recordings, drive), drive):
        typer.echo(line)


@app.command()
def identify(
    recordings: Recordings,
    model: ModelFile,
    out: Annotated[Path | None, typer.Option("--out", help="Model file to write.")] = None,
    overwrite: Overwrite = False,
) -> None:
    """Fit the parameters of a model, effects included, within their declared uncertainty."""
    from contextlib import nullcontext

    from rwn.model.files import read_model, write_model
    from rwn.model.recordings import read_recordings
    from rwn.report import text as words
    from rwn.report.files import output_file

    with output_file(out, overwrite=overwrite) if out else nullcontext() as aside:
        nominal = read_model(model)
        fit = _rwn().identify(read_recordings(recordings, nominal), nominal)
        if aside is not None:
            write_model(fit.model, aside)
    for name, value in fit.parameters.items():
        typer.echo(f"{name:<22} {words.estimate(value)}")
    if fit.status != "converged":
        typer.echo(f"{fit.status}: {fit.advice}")


@app.command()
def effects(
    name: Annotated[str | None, typer.Argument(help="One effect, in detail.")] = None,
    model: Annotated[Path | None, typer.Option("--model", help="A model file: its own effects as well.")] = None,
) -> None:
    """The effects that rwn can name: site, equation, parameters, source."""
    from rwn.model import vocabulary as known
    from rwn.model.files import read_model

    table = read_model(model).effect_table if model else known.table()
    if name is None:
        for effect in table.values():
            typer.echo(f"{effect.name:<28} {effect.site:<9} {effect.meaning}")
        return
    if name not in table:
        raise unknown("effect", name, table, where="rwn effects")
    effect = table[name]
    typer.echo(f"{effect.name}: {effect.meaning}\nsite: {effect.site}\nequation: {effect.equation}")
    for p in effect.parameters:
        scale = f" x {p.scale.words} of the drive" if p.scale.powers else ""
        typer.echo(f"  {p.name} [{p.unit}]: {p.meaning}; {p.lower:g} to {p.upper:g}{scale}")
    typer.echo(f"source: {effect.source}")


@app.command()
def demo(
    out: Annotated[Path, typer.Option("--out", help="Folder for the results.")] = Path("demo-out"),
    overwrite: Overwrite = False,
) -> None:
    """Diagnose the recording that comes with rwn, whose missing effect is known."""
    folder = Path(__file__).parent / "demo"
    train = sorted(folder.glob("train*.csv"))
    if not train:
        raise InputError(
            "the demo recording is not installed", where=folder, expected="train_1.csv", fix="reinstall rwn"
        )
    diagnose(train, folder / "model.toml", out, sorted(folder.glob("heldout*.csv")), overwrite=overwrite)


@app.command()
def evidence(
    names: Annotated[list[str] | None, typer.Argument(metavar="[NAME]...", help="Machines (default: all).")] = None,
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
    from rwn.report.files import output_folder
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


def _write_results(found: Diagnosis, folder: Path) -> None:
    from rwn.model.files import write_model
    from rwn.report import write_report

    (folder / "diagnosis.json").write_bytes(found.to_json())
    if found.corrected is not None:
        write_model(found.corrected, folder / "corrected.toml")
    write_report(found, folder / "report.html")


def _print_verdict(found: Diagnosis, out: Path) -> None:
    from rwn.report import text as words

    typer.echo(words.verdict_sentence(found))
    for finding in found.findings:
        typer.echo(f"  {finding.recording}: {finding.words}; {finding.done}")
    for effect in found.effects:
        for name, value in effect.parameters.items():
            typer.echo(f"  {effect.name} {name} = {words.estimate(value)}")
    if found.next_experiment:
        typer.echo(f"Next experiment: {found.next_experiment}")
    for warning in found.warnings:
        typer.echo(f"warning: {warning}", err=True)
    typer.echo(f"Report: {out / 'report.html'}")


def _mount(name: str, module: str) -> None:
    """Another package's commands, where it is installed whole; imported only when they are called for."""
    wanted = len(sys.argv) < 2 or sys.argv[1] in (name, "--help")
    try:
        if wanted and importlib.util.find_spec(module) is not None:
            app.add_typer(importlib.import_module(module).app, name=name)
    except ModuleNotFoundError:
        return  # not part of this installation


def main() -> None:
    """The entry point `rwn`."""
    for name in ("thesis", "trials"):
        _mount(name, f"rwn.studies.{name}.cli")
    try:
        status = app(standalone_mode=False)
    except (ValueError, OSError) as error:
        _refuse(error)
    except typer.Abort:
        sys.exit(130)
    except Exception as error:
        if not hasattr(error, "format_message"):  # what typer raises for wrong usage has it
            raise
        _refuse(error)
    sys.exit(status if isinstance(status, int) else 0)


def _refuse(error: Exception) -> None:
    if os.environ.get("RWN_TRACEBACK"):
        raise error
    if hasattr(error, "format_message"):
        if error.format_message().startswith("Usage:"):  # a group called without a command: its help, as it is
            print(error.format_message(), file=sys.stderr)
            sys.exit(2)
        usage = getattr(getattr(error, "ctx", None), "command_path", "rwn")
        text = f"{error.format_message().rstrip('.')}; fix: see {usage} --help"
    elif isinstance(error, OSError) and error.filename is not None:
        text = f"{error.filename}: {error.strerror}; expected a file in reach; fix: check path, permissions, disk space"
    else:
        text = str(error)
    print("rwn: " + " ".join(text.split()), file=sys.stderr)
    sys.exit(2)
