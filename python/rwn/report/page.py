"""The page of the report: verdict, what acts, proof, place, law, parameters, provenance."""

from __future__ import annotations

import base64
import gzip
import json
import math
import re
from collections.abc import Iterator, Sequence
from html import escape
from pathlib import Path
from typing import Any

from rwn.report import tables
from rwn.report import text as words
from rwn.report.account_picture import account_picture
from rwn.report.diagnosis_data import DiagnosisData
from rwn.report.next_steps import next_steps
from rwn.report.plot import Plot
from rwn.report.plot_text import in_words
from rwn.report.plots import DARK, figure
from rwn.report.proof_sentences import before_after, headline
from rwn.report.sentences import acting, sentences

_VERDICTS = {
    "missing-physics": ("Missing physics", "#0b5563"),
    "adequate": ("Adequate", "#2b6e3f"),
    "unexplained": ("Unexplained", "#8a4b08"),
    "insufficient-excitation": ("Insufficient excitation", "#55595f"),
    "recording-mistake": ("Recording mistake", "#962d3e"),
}
_PANELS = ("response", "residual-time", "input")  # of a recording, over one time axis
_OWN_NUMBERS = " What has a second error was judged with numbers that were fitted to that recording itself."
_OFFLINE = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:"
_HERE = Path(__file__).parent
_PLOTLY = _HERE / "vendor" / "plotly-basic.min.js.gz"


def page(found: DiagnosisData) -> str:
    """The report of a diagnosis, the whole HTML text."""
    kind, colour = _VERDICTS[found.verdict]
    said = sentences(found)
    lead = f'<p class="lead">{_unbroken(" ".join(said[1:]))}</p>' if said[1:] else ""
    head = f'<header><div class="kind">{escape(kind)}</div><h1>{_unbroken(said[0])}</h1>{lead}</header>'
    sections = "\n".join(part for part in _sections(found) if part)
    return document(f"{kind} – rwn diagnosis", colour, f"{head}\n{_facts(found)}\n{sections}")


def plotly_script() -> str:
    """The part of plotly that draws lines and points."""
    return gzip.decompress(_PLOTLY.read_bytes()).decode("utf-8")


def document(title: str, colour: str, body: str) -> str:
    """A whole page of HTML around its body; its content security policy lets nothing in it reach outside."""
    style, script = ((_HERE / name).read_text(encoding="utf-8") for name in ("style.css", "script.js"))
    plotly = base64.b64encode(_PLOTLY.read_bytes()).decode("ascii")
    return f"""<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{_OFFLINE}">
<meta name="viewport" content="width=device-width, initial-scale=1"><meta name="color-scheme" content="light dark">
<title>{escape(title)}</title><style>:root {{ --verdict: {colour}; }}
{style}</style></head><body><main>
{body}
</main><script type="text/plain" id="plotly">{plotly}</script>
<script type="application/json" id="dark">{json.dumps(DARK)}</script>
<script>{script}</script></body></html>
"""


def _sections(found: DiagnosisData) -> Iterator[str]:
    account = section("What acts, and what is left", account_picture(found))
    yield f'<div class="top">{account}{section("What to do next", _list(next_steps(found)))}</div>'
    yield section("Before you trust the rest", _doubts(found))
    yield section("What was found", _findings(found))
    yield section("Does the simulation improve?", _proof(found))
    yield section("Its law", figures(found, ("law", "spectrum")))
    yield section("Where the mismatch is", _place(found))
    yield section("Parameters", _parameters(found))
    yield section("How this was made", _provenance(found))


def _unbroken(text: str) -> str:
    """Text whose line does not break between a number and its unit."""
    return re.sub(r"(?<=\d) (?=[%A-Za-zµΩ°/²]{1,6}\b|%)", "\u00a0", escape(text))


def section(title: str, body: str) -> str:
    """A part of a page with its heading; empty where there is nothing to say."""
    return f"<section><h2>{escape(title)}</h2>{body}</section>" if body else ""


def _list(texts: Sequence[str]) -> str:
    items = "".join(f"<li>{_with_code(text)}</li>" for text in texts)
    return f"<ul>{items}</ul>" if items else ""


def _with_code(text: str) -> str:
    return re.sub("`(.*?)`", r"<code>\1</code>", escape(text))


def _facts(found: DiagnosisData) -> str:
    facts = []
    if found.effects:
        equations = dict.fromkeys(effect.equation for effect in found.effects)
        facts.append((words.listing(list(equations)), "equation at fault"))
        likely, rivals = min((acting(found, effect) for effect in found.effects), key=lambda known: known[0])
        one = "this name" if not rivals else "this name or one in its place"
        names = one if len(found.effects) == 1 else "the least sure of these names"
        facts.append((words.likelihood(likely), f"probability of {names}"))
    elif found.verdict == "unexplained":
        left = found.remainder.error**0.5
        times = f"{words.number(left, 2)} × noise" if math.isfinite(left) else "a motion that ran away"
        facts.append((times, "is left, rms, and has no name here"))
    elif found.adequate_probability is not None:
        facts.append((words.likelihood(found.adequate_probability), "probability that nothing is missing"))
    row = headline(found)
    if row is not None:
        models = "as given → refitted" if row.corrected is None else "refitted → corrected"
        facts.append((" → ".join(before_after(row)), f"{row.signal} error on {row.recording}, {models}"))
        if row.noise_floor is not None:
            facts.append((words.quantity(row.noise_floor, row.unit), "noise of that signal, estimated"))
    cells = "".join(f'<div class="fact"><b>{_unbroken(a)}</b><span>{escape(b)}</span></div>' for a, b in facts)
    return f'<div class="facts">{cells}</div>'


def _doubts(found: DiagnosisData) -> str:
    """Warnings, how the signals were measured, and what was odd in the recordings."""
    warnings = "".join(f'<div class="warn">{escape(words.capital(warning))}</div>' for warning in found.warnings)
    filters = _list([words.filter_in_words(f.signal, f.time_constant) for f in found.sensor_filters])
    return warnings + filters + tables.finding_table(found.findings)


def _findings(found: DiagnosisData) -> str:
    parts = [tables.effect_table(found)]
    if len(found.set) > 1:
        names = words.listing([words.plain_name(name) for name in found.set], "or")
        parts.append(f"<p>These recordings cannot tell apart: <b>{escape(names)}</b>.</p>")
    parts.append(tables.alternative_table(found))
    return "".join(parts)


def _proof(found: DiagnosisData) -> str:
    kept_back = any(plot.use == "heldout" for plot in found.curves)
    rows = tables.heldout_table(found.heldout)
    if rows:
        what = "on recordings that were not fitted" if kept_back else "of fits that did not see what they are judged on"
        rows += (
            f'<p class="note">Free run from the input alone, rms error, {what}. '
            "Gain = 1 − corrected / refitted, with its 95 % interval by block bootstrap."
            f"{_OWN_NUMBERS if any(row.simulated is not None for row in found.heldout) else ''}</p>"
        )
    return rows + _recordings(found, "heldout" if kept_back else "fit")


def _place(found: DiagnosisData) -> str:
    said = words.capital(found.location.description)
    text = f"<p>{escape(said)}.</p>" if said else ""
    rows = tables.region_table(found.location.regions)
    if rows:
        rows += (
            '<p class="note">Shares of the square of what the refitted model leaves on the fitted recordings (of a '
            "motor or an axis: in its equation of motion). The proof compares free runs: their errors may be largest "
            "elsewhere.</p>"
        )
    kept_back = any(plot.use == "heldout" for plot in found.curves)
    return (
        text
        + rows
        + figures(found, ("residual-speed",))
        + (_recordings(found, "fit") if kept_back else "")
    )


def _parameters(found: DiagnosisData) -> str:
    body = tables.parameter_table(found)
    advice = found.nominal_fit.advice
    return body + (f'<p class="note">Refitted alone: {escape(advice)}</p>' if body and advice else "")


def _provenance(found: DiagnosisData) -> str:
    command = f"<p><code>{escape(found.command)}</code></p>" if found.command else ""
    made = f"rwn {found.version}, seed {found.seed}" + (f", {found.elapsed:.1f} s" if found.elapsed else "")
    return f'{command}{tables.source_table(found.sources)}<p class="note">{escape(made)}</p>'


def pictures(curves: Sequence[Plot]) -> dict[str, Plot]:
    """The figures of a report by name, each by the first of its plots: recordings over time, then the others."""
    named: dict[str, Plot] = {}
    for plot in curves:
        if plot.slot not in _PANELS[1:]:
            named.setdefault(plot.recording or plot.title, plot)
    return named


def panels(curves: Sequence[Plot], first: Plot) -> list[Plot]:
    """The plots that make one figure with this one: those of its recording, from the top down, or itself alone."""
    if not first.recording:
        return [first]
    of_it = [plot for plot in curves if (plot.recording, plot.use) == (first.recording, first.use)]
    return [plot for slot in _PANELS for plot in of_it if plot.slot == slot]


def _recordings(found: DiagnosisData, use: str) -> str:
    """The pictures over time of the recordings of one use: whole, and the stretch that shows most."""
    firsts = [(k, plot) for k, plot in enumerate(found.curves) if plot.use == use and plot.slot == _PANELS[0]]
    return "".join(_recording(str(k), panels(found.curves, plot)) for k, plot in firsts)


def _recording(index: str, plots: Sequence[Plot]) -> str:
    drawn, first, name = figure(plots), plots[0], plots[0].recording
    use = "fitted" if first.use == "fit" else "not fitted"
    scale, unit = words.prefix_for(max(float(abs(trace.x).max()) for trace in first.traces), first.x_unit)
    ident = f'data-figure="figure-{index}" data-recording="{escape(name)}" data-scale="{scale!r}"'
    close = ""
    if first.zoom:
        low, high = (words.number(bound * scale) for bound in first.zoom)
        close = (
            f'<div><div class="note at">Close-up: {low} to {high} {unit}, where it shows most</div>'
            f'<div class="plot" {ident} data-zoom></div></div>'
        )
    return (
        f'<figure class="recording {first.use}"><figcaption>{escape(name)} <span class="note">({use}; free run from '
        f'the input alone)</span></figcaption><p class="unseen">{escape(in_words(plots))}</p><div class="pair"><div>'
        f'<div class="note">Whole recording</div><div class="plot" {ident}></div></div>{close}</div>'
        f"{_data(index, drawn)}</figure>"
    )


def figures(found: DiagnosisData, slots: Sequence[str], *, prefix: str = "") -> str:
    """The pictures of these slots; `prefix` keeps those of several diagnoses on one page apart."""
    numbered = [(k, plot) for slot in slots for k, plot in enumerate(found.curves) if plot.slot == slot]
    odd = {numbered[-1][0]} if len(numbered) % 2 else set()  # the odd one out fills its row
    drawn = "".join(_figure(f"{prefix}{k}", plot, wide=k in odd) for k, plot in numbered)
    return f'<div class="plots">{drawn}</div>' if drawn else ""


def _figure(index: str, plot: Plot, *, wide: bool) -> str:
    note = plot.note
    if any(trace.at is not None for trace in plot.traces):
        note += " A click on a point leads to its instant in the recording."
    if plot.shown:
        note += " A few points lie outside of what is shown."
    return (
        f"<figure{' class=wide' if wide else ''}><figcaption>{escape(plot.title)}</figcaption>"
        f'<div class="note">{escape(note.strip())}</div><p class="unseen">{escape(in_words([plot]))}</p>'
        f'<div class="plot" data-figure="figure-{index}"></div>{_data(index, figure([plot]))}</figure>'
    )


def _data(index: str, drawn: dict[str, Any]) -> str:
    """A figure as JSON, arrays that several of its lines share written once."""
    places: dict[str, int] = {}
    lines = [dict(line) for line in drawn["data"]]
    for line in lines:
        for key in ("x", "y", "customdata"):
            if key in line:
                line[key] = places.setdefault(line[key]["bdata"], len(places))
    arrays = [{"dtype": "f4", "bdata": text} for text in places]
    text = json.dumps({**drawn, "data": lines, "arrays": arrays}, separators=(",", ":")).replace("<", "\\u003c")
    return f'<script type="application/json" id="figure-{index}">{text}</script>'
