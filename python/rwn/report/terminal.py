"""What a terminal says of a diagnosis, a line each; colours vanish where the output is no terminal."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import typer

from rwn.report.diagnosis_data import DiagnosisData
from rwn.report.next_steps import next_steps
from rwn.report.proof_sentences import SLIGHT
from rwn.report.sentences import about_shares, sentences, shown
from rwn.report.text import (
    capital,
    estimate,
    filter_in_words,
    likelihood,
    listing,
    number,
    parameter_in_words,
    parameter_name,
    percent,
    plain_name,
)

_COLOURS = {"missing-physics": "cyan", "adequate": "green", "recording-mistake": "red"}  # else yellow
_BAR = 20  # characters of a share of one


def print_verdict(found: DiagnosisData, out: Path) -> None:
    """Prints them, warnings on stderr, and where the report is."""
    plain = bool(os.environ.get("NO_COLOR"))  # https://no-color.org
    for line in lines(found):
        typer.echo(line, color=False if plain else None)
    for warning in found.warnings:
        typer.echo(f"warning: {warning}", err=True)
    typer.echo(f"Report: {out / 'report.html'}")


def lines(found: DiagnosisData) -> Iterator[str]:
    """Verdict, account, parameters, what was odd, and what to do next."""
    first, *others = sentences(found)
    yield typer.style(first, fg=_COLOURS.get(found.verdict, "yellow"), bold=True)
    yield from others
    yield from _titled("What acts, and how much of the mismatch goes with it:", _account(found))
    yield from _titled("Parameters, 95 %:", _parameters(found))
    yield from _titled("How it was measured:", _measured(found))
    yield from _titled("Next:", next_steps(found))


def _titled(title: str, texts: Iterator[str] | tuple[str, ...]) -> Iterator[str]:
    rows = list(texts)
    if rows:
        yield typer.style(title, bold=True)
        yield from (f"  {row}" for row in rows)


def _account(found: DiagnosisData) -> Iterator[str]:
    if found.verdict in ("adequate", "insufficient-excitation"):
        return
    rows = []
    for effect in shown(found.account):
        names = listing([plain_name(name) for name in (effect.name, *effect.rivals)], "or")
        said = "" if effect.stated else ", not stated"
        rows.append((capital(names), effect.share, f"probability {likelihood(effect.together)}{said}"))
    left = found.remainder
    if left.signals and left.share >= SLIGHT:
        rows.append(("No name here", left.share, f"of the {listing(left.signals)}"))
    width = max((len(name) for name, _, _ in rows), default=0)
    for name, share, said in rows:
        kept = min(max(share, 0.0), 1.0)
        full = round(_BAR * kept)
        yield f"{name:<{width}}  {'█' * full}{'·' * (_BAR - full)} {percent(kept):>8}  {said}"
    if len(rows) > 1:
        yield about_shares(shown(found.account))
    if found.verdict == "unexplained" and found.location.description:
        yield f"Where: {found.location.description}."


def _parameters(found: DiagnosisData) -> Iterator[str]:
    for effect in found.effects:
        for name, value in effect.parameters.items():
            yield f"{capital(plain_name(effect.name))}: {parameter_name(effect.name, name)} = {estimate(value)}"
    if not found.effects:
        yield from _off_the_data_sheet(found)


def _off_the_data_sheet(found: DiagnosisData) -> Iterator[str]:
    """The parameters whose given values lie outside what the recordings say, the farthest first."""
    fitted = [(name, p) for name, p in found.nominal_fit.parameters.items() if p.uncertainty]
    for name, p in sorted(fitted, key=lambda pair: -pair[1].off(pair[1].best)):
        low, high = p.best.interval or (p.nominal, p.nominal)
        if not low <= p.nominal <= high:
            off = f"{number(p.off(p.best), 2)} declared deviations from the data sheet"
            yield f"{capital(parameter_in_words(name))} = {estimate(p.best)}, {off}"


def _measured(found: DiagnosisData) -> Iterator[str]:
    for finding in found.findings:
        yield f"{finding.recording}: {finding.words}" + (f"; {finding.done}" if finding.done else "")
    for fitted in found.sensor_filters:
        yield filter_in_words(fitted.signal, fitted.time_constant)
