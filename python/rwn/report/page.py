"""The page of the report: verdict, findings, proof, place, law, parameters, provenance."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from pathlib import Path

from rwn.report import tables
from rwn.report import text as words
from rwn.report.diagnosis import Diagnosis, Plot
from rwn.report.plots import figure

_VERDICTS = {
    "missing-physics": ("Missing physics", "#0b5563"),
    "adequate": ("Adequate", "#2b6e3f"),
    "unexplained": ("Unexplained", "#8a4b08"),
    "insufficient-excitation": ("Insufficient excitation", "#55595f"),
    "recording-mistake": ("Recording mistake", "#962d3e"),
}
_WIDE = ("response", "residual-time", "spectrum")

_SCRIPT = """
for (const box of document.querySelectorAll('.plot')) {
  const drawn = JSON.parse(document.getElementById(box.dataset.figure).textContent);
  const unused = ['lasso2d', 'select2d', 'autoScale2d'];
  const config = {responsive: true, displaylogo: false, modeBarButtonsToRemove: unused};
  Plotly.newPlot(box, drawn.data, drawn.layout, config);
}
"""


def page(found: Diagnosis) -> str:
    """The whole HTML text."""
    from plotly.offline import get_plotlyjs

    kind, colour = _VERDICTS[found.verdict]
    style = (Path(__file__).parent / "style.css").read_text(encoding="utf-8")
    sections = "\n".join(section for section in _sections(found) if section)
    return f"""<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(kind)} – rwn diagnosis</title><style>:root {{ --verdict: {colour}; }}
{style}</style></head><body><main>
<header><div class="kind">{escape(kind)}</div><h1>{escape(words.verdict_sentence(found))}</h1></header>
{_facts(found)}
{sections}
</main><script>{get_plotlyjs()}</script><script>{_SCRIPT}</script></body></html>
"""


def _sections(found: Diagnosis) -> Iterator[str]:
    yield _section(
        "Before you trust the rest", "".join(f'<div class="warn">{escape(w)}</div>' for w in found.warnings)
    )
    yield _section("What was found", _findings(found))
    yield _section("Does the simulation improve?", _proof(found))
    yield _section("Where the mismatch is", _place(found))
    yield _section("Its law", _figures(found, ("torque-speed", "spectrum", "other")))
    yield _section("Parameters", _parameters(found))
    yield _section("How this was made", _provenance(found))


def _section(title: str, body: str) -> str:
    return f"<section><h2>{escape(title)}</h2>{body}</section>" if body else ""


def _facts(found: Diagnosis) -> str:
    facts = [(found.equation or "none", "equation at fault")] if found.verdict != "adequate" else []
    if found.effects:
        likely = min(effect.probability for effect in found.effects)
        facts.append(
            (
                words.likelihood(likely),
                "probability of " + ("this name" if len(found.effects) == 1 else "these"),
            )
        )
    elif found.adequate_probability is not None:
        facts.append((words.likelihood(found.adequate_probability), "probability that nothing is missing"))
    row = words.headline(found)
    if row is not None:
        last = row.refitted if row.corrected is None else row.corrected
        scale, unit = words.prefix_for(max(row.nominal, last), row.unit)
        change = f"{words.number(row.nominal * scale)} → {words.number(last * scale)} {unit}"
        facts.append((change, f"{row.signal} error on {row.recording}"))
        if row.noise_floor is not None:
            facts.append((words.quantity(row.noise_floor, row.unit), "noise floor"))
    cells = "".join(f'<div class="fact"><b>{escape(a)}</b><span>{escape(b)}</span></div>' for a, b in facts)
    return f'<div class="facts">{cells}</div>'


def _findings(found: Diagnosis) -> str:
    parts = [tables.effect_table(found.effects)]
    if len(found.set) > 1:
        names = words.listing([words.plain_name(name) for name in found.set], "or")
        parts.append(f"<p>These recordings cannot tell apart: <b>{escape(names)}</b>.</p>")
    parts.append(tables.alternative_table(found))
    if found.next_experiment:
        parts.append(f'<div class="next"><b>Next experiment.</b> {escape(found.next_experiment)}</div>')
    return "".join(parts)


def _proof(found: Diagnosis) -> str:
    rows = tables.heldout_table(found.heldout)
    if rows:
        rows += (
            '<p class="note">Free run from the input alone, rms error, on recordings not used for fitting. '
            "Gain = 1 − corrected / refitted; interval by block bootstrap.</p>"
        )
    return _figures(found, ("response",)) + rows


def _place(found: Diagnosis) -> str:
    text = f"<p>{escape(found.location.description)}</p>" if found.location.description else ""
    figures = _figures(found, ("residual-time", "residual-speed", "residual-angle"))
    return text + tables.region_table(found.location.regions) + figures


def _parameters(found: Diagnosis) -> str:
    body = tables.parameter_table(found)
    advice = found.nominal_fit.advice
    return body + (f'<p class="note">{escape(advice)}</p>' if body and advice else "")


def _provenance(found: Diagnosis) -> str:
    rows = [
        [
            escape(s.path),
            s.use,
            str(s.samples or "–"),
            words.quantity(s.duration, "s") if s.duration else "–",
            f"<code>{escape(s.sha256[:12])}</code>" if s.sha256 else "–",
        ]
        for s in found.sources
    ]
    files = tables.table(("File", "Used as", "Samples", "Duration", "SHA-256"), rows, numbers_from=2)
    command = f"<p><code>{escape(found.command)}</code></p>" if found.command else ""
    made = f"rwn {found.version}, seed {found.seed}" + (f", {found.elapsed:.1f} s" if found.elapsed else "")
    return f'{command}{files}<p class="note">{escape(made)}</p>'


def _figures(found: Diagnosis, slots: Sequence[str]) -> str:
    numbered = [(k, plot) for slot in slots for k, plot in enumerate(found.curves) if plot.slot == slot]
    narrow = [k for k, plot in numbered if plot.slot not in _WIDE]
    alone = set(narrow[-1:] if len(narrow) % 2 else ())  # the odd one out fills its row
    figures = "".join(_figure(k, plot, wide=plot.slot in _WIDE or k in alone) for k, plot in numbered)
    return f'<div class="plots">{figures}</div>' if figures else ""


def _figure(index: int, plot: Plot, *, wide: bool) -> str:
    note = f'<div class="note">{escape(plot.note)}</div>' if plot.note else ""
    return (
        f"<figure{' class=wide' if wide else ''}><figcaption>{escape(plot.title)}</figcaption>{note}"
        f'<div class="plot" data-figure="figure-{index}"></div>'
        f'<script type="application/json" id="figure-{index}">{figure(plot)}</script></figure>'
    )
