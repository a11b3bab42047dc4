"""Tables of the report."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from rwn.mismatch_map.regions import Region
from rwn.prove.heldout import HeldoutRow
from rwn.recording.inspection import Finding
from rwn.report import text as words
from rwn.report.diagnosis_data import Alternative, DiagnosisData, Source
from rwn.report.proof_sentences import error_in_words, row_prefix, worse
from rwn.report.sentences import acting

UNLIKELY = 0.01  # probability below which another explanation is none


def table(
    head: Sequence[str], rows: Sequence[Sequence[str]], *, numbers_from: int = 1, marked: Sequence[bool] = ()
) -> str:
    """An HTML table; columns from `numbers_from` on are aligned as numbers. Cells are HTML; `marked` rows stand out.

    Every cell bears the name of its column, which a narrow screen shows in place of the head.
    """
    if not rows:
        return ""
    kinds = ["" if k < numbers_from else ' class="n"' for k in range(len(head))]
    top = "".join(f'<th scope="col"{kind}>{escape(name)}</th>' for kind, name in zip(kinds, head, strict=True))

    def line(cells: Sequence[str]) -> str:
        return "".join(
            f'<td data-label="{escape(name)}"{kind}>{cell}</td>'
            for name, kind, cell in zip(head, kinds, cells, strict=True)
        )

    flags = [*marked, *[False] * (len(rows) - len(marked))]
    body = "".join(
        f"<tr{' class=worse' if flag else ''}>{line(row)}</tr>" for row, flag in zip(rows, flags, strict=True)
    )
    return f"<table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table>"


def bar(share: float, text: str = "") -> str:
    """A share as a bar with its figure, or `text` in its place."""
    width = 100 * min(max(share, 0.0), 1.0)
    fill = f'<span style="width:{width:.1f}%"></span>'
    return f'<span class="bar" aria-hidden="true">{fill}</span> {escape(text or words.percent(share))}'


def effect_table(found: DiagnosisData) -> str:
    """Each found effect with its formula, parameters, intervals and probability, with that of its rivals beside it."""
    rows = []
    for effect in found.effects:
        values = "<br>".join(
            f"{_parameter(effect.name, name)} = <b>{escape(words.estimate(value))}</b>"
            for name, value in effect.parameters.items()
        )
        title = words.capital(words.plain_name(effect.name))
        name = f"<b>{escape(title)}</b><div class=note>{escape(effect.meaning)}</div>"
        formula = f"<code>{escape(effect.formula)}</code>" if effect.formula else "–"
        probability = bar(effect.probability, words.likelihood(effect.probability))
        together, rivals = acting(found, effect)
        if rivals:
            either = words.listing([words.plain_name(rival) for rival in rivals], "or")
            probability += f"<div class=note>{words.likelihood(together)} with {escape(either)}</div>"
        rows.append([name, escape(effect.equation), formula, values or "–", probability])
    return table(("Effect", "Equation", "Law", "Parameters (95 %)", "Probability"), rows, numbers_from=9)


def _parameter(effect: str, parameter: str) -> str:
    """The name of a parameter, its symbol set as in the law."""
    name = words.plain_name(parameter)
    sign = words.parameter_name(effect, parameter).removeprefix(name).strip()
    return escape(name) + (f" <code>{escape(sign)}</code>" if sign else "")


FIT_ALONE = (
    "By how well each fits what was fitted, less what its parameters cost. That an effect acts is judged by more: "
    "by what goes with it of what was not fitted, and by whether it is the same in every part."
)


def alternative_table(found: DiagnosisData) -> str:
    """The stated explanation, the others, and what would tell them apart; empty where there are no others."""
    others = [_explanation(other) for other in found.alternatives if other.probability >= UNLIKELY]
    stated = found.explanation
    rows = [_explanation(stated, stated=True), *others] if stated and others else others
    nameless = "unexplained" in (found.verdict, found.beneath.verdict if found.beneath else "")
    head = "Of what has a name, the likeliest" if nameless else "Explanation" if stated else "Other explanation"
    shown = table((head, "Weight by fit alone", "What would tell them apart"), rows, numbers_from=9)
    return shown and f'{shown}<p class="note">{FIT_ALONE}</p>'


def _explanation(this: Alternative, *, stated: bool = False) -> list[str]:
    names = words.listing([words.plain_name(name) for name in this.effects]) if this.effects else "nothing missing"
    name = escape(words.capital(names))
    return [
        f"<b>{name}</b> <span class=note>(stated)</span>" if stated else name,
        bar(this.probability, words.likelihood(this.probability)),
        escape(this.separated_by) or "–",
    ]


def region_table(regions: Sequence[Region]) -> str:
    """Where the residual's energy sits."""
    rows = [
        [
            escape(words.capital(region.name or region.coordinate)),
            _range(region),
            bar(region.share),
            words.percent(region.samples_share),
        ]
        for region in regions
    ]
    return table(("Where", "Range", "Share of the mismatch", "Share of the samples"), rows, numbers_from=3)


def _range(region: Region) -> str:
    if region.coordinate == "direction":
        return "forward" if region.high > 0.0 else "backward"
    scale, unit = words.prefix_for(max(abs(region.low), abs(region.high)), region.unit)
    text = f"{region.coordinate} {words.number(region.low * scale)} to {words.number(region.high * scale)} {unit}"
    return escape(text.strip())


def heldout_table(rows: Sequence[HeldoutRow]) -> str:
    """Free-run error on recordings not used for fitting, one row per recording, region and signal."""
    head = (
        "Recording",
        "Region",
        "Signal",
        "Samples",
        "As given",
        "Refitted",
        "Corrected",
        "Noise floor",
        "Gain (95 %)",
    )
    whole = {(row.recording, row.signal): row for row in reversed(rows)}  # the first: of all regions
    shown = [_heldout_row(row, *row_prefix(whole[row.recording, row.signal])) for row in rows]
    return table(head, shown, numbers_from=3, marked=[worse(row) for row in rows])


def _heldout_row(row: HeldoutRow, scale: float, unit: str) -> list[str]:
    errors = (row.nominal, row.refitted, row.corrected, row.noise_floor)
    shown = ["–" if e is None else escape(error_in_words(e, scale, unit)).replace(" ", "&nbsp;") for e in errors]
    said = (0, 1) if row.corrected is None else (1, 2)
    shown = [f"<b>{text}</b>" if k in said else text for k, text in enumerate(shown)]
    if row.simulated is not None:
        simulated = error_in_words(row.simulated, *words.prefix_for(row.simulated, row.unit))
        shown[said[1]] += f" <span class=note>{escape(simulated)} as rwn simulate runs it</span>"
    gain = "–" if row.gain is None else words.percent(row.gain).replace("-", "−")
    if row.gain_interval is not None:
        digits = 1 if row.gain is not None and abs(row.gain) > 0.97 else 0
        low, high = (f"{100 * bound:.{digits}f}".replace("-", "−") for bound in row.gain_interval)
        gain += f" <span class=note>[{low}, {high}]</span>"
    if worse(row):
        gain = f'<b class="flag">▲ worse</b> {gain}'
    return [escape(row.recording), escape(row.region), escape(row.signal), str(row.samples), *shown, gain]


def parameter_table(found: DiagnosisData) -> str:
    """Nominal parameters as given, as refitted, and as fitted together with the found effects."""
    rows = []
    for name, p in found.nominal_fit.parameters.items():
        corrected = "–" if p.corrected is None else f"<b>{escape(words.estimate(p.corrected))}</b>"
        declared = f"± {words.percent(p.uncertainty)}" if p.uncertainty else "exact"
        doubt = "unknown" if p.uncertainty is None else declared
        nominal = words.quantity(p.nominal, p.refitted.unit, 4)
        label = escape(words.capital(words.parameter_in_words(name)))
        if p.only_declared(p.corrected or p.refitted):
            label += "<div class=note>the recordings hardly tell it: as declared</div>"
        rows.append([label, escape(nominal), doubt, escape(words.estimate(p.refitted)), corrected])
    return table(("Parameter", "Nominal", "Declared", "Refitted alone", "With the correction"), rows)


def finding_table(findings: Sequence[Finding]) -> str:
    """What was odd in the recordings before any physics, and what was done about it."""
    rows = [[escape(f.recording), escape(words.capital(f.words)), escape(f.done) or "–"] for f in findings]
    return table(("Recording", "Found before any physics", "What was done"), rows, numbers_from=9)


def source_table(sources: Sequence[Source]) -> str:
    """Every file that was used, with the hash of its bytes."""
    rows = [
        [
            escape(s.path),
            s.use,
            str(s.samples or "–"),
            words.quantity(s.duration, "s") if s.duration else "–",
            f"<code>{escape(s.sha256[:12])}</code>" if s.sha256 else "–",
        ]
        for s in sources
    ]
    return table(("File", "Used as", "Samples", "Duration", "SHA-256"), rows, numbers_from=2)
