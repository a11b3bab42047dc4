"""Tables of the report."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from rwn.locate.regions import Region
from rwn.name.found_effect import FoundEffect
from rwn.prove.heldout import HeldoutRow
from rwn.report import text as words
from rwn.report.diagnosis import Diagnosis


def table(head: Sequence[str], rows: Sequence[Sequence[str]], *, numbers_from: int = 1) -> str:
    """An HTML table; columns from `numbers_from` on are aligned as numbers. Cells are HTML."""
    if not rows:
        return ""

    def cells(tag: str, values: Sequence[str]) -> str:
        kinds = ["" if k < numbers_from else ' class="n"' for k in range(len(values))]
        return "".join(f"<{tag}{kind}>{value}</{tag}>" for kind, value in zip(kinds, values, strict=True))

    body = "".join(f"<tr>{cells('td', row)}</tr>" for row in rows)
    top = cells("th", head)
    return f'<div class="scroll"><table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>'


def bar(share: float, colour: str, text: str = "") -> str:
    """A share as a bar with its figure, or `text` in its place."""
    width = 100 * min(max(share, 0.0), 1.0)
    fill = f'<span style="width:{width:.1f}%;background:{colour}"></span>'
    return f'<span class="bar">{fill}</span> {escape(text or words.percent(share))}'


def effect_table(effects: Sequence[FoundEffect]) -> str:
    """Each found effect with its formula, parameters, intervals and probability."""
    rows = []
    for effect in effects:
        values = "<br>".join(
            f"{escape(name.replace('_', ' '))} = <b>{escape(words.estimate(value))}</b>"
            for name, value in effect.parameters.items()
        )
        name = f"<b>{escape(words.plain_name(effect.name))}</b><div class=note>{escape(effect.meaning)}</div>"
        formula = f"<code>{escape(effect.formula)}</code>" if effect.formula else ""
        rows.append(
            [
                name,
                escape(effect.equation),
                formula,
                values or "–",
                bar(effect.probability, "#0b7285", words.likelihood(effect.probability)),
            ]
        )
    return table(("Effect", "Equation", "Law", "Parameters (95 %)", "Probability"), rows, numbers_from=9)


def alternative_table(found: Diagnosis) -> str:
    """The other explanations and what would tell them apart."""
    rows = [
        [
            escape(
                words.listing([words.plain_name(name) for name in other.effects])
                if other.effects
                else "nothing missing"
            ),
            bar(other.probability, "#868e96", words.likelihood(other.probability)),
            escape(other.separated_by) or "–",
        ]
        for other in found.alternatives
    ]
    return table(("Other explanation", "Probability", "What would tell them apart"), rows, numbers_from=9)


def region_table(regions: Sequence[Region]) -> str:
    """Where the residual's energy sits."""
    rows = [
        [
            escape(region.name or region.coordinate),
            f"{escape(region.coordinate)} {_range(region)}",
            bar(region.share, "#f59f00"),
            words.percent(region.samples_share),
        ]
        for region in regions
    ]
    return table(("Region", "Range", "Share of the mismatch", "Share of the samples"), rows, numbers_from=3)


def _range(region: Region) -> str:
    scale, unit = words.prefix_for(max(abs(region.low), abs(region.high)), region.unit)
    return escape(f"{words.number(region.low * scale)} to {words.number(region.high * scale)} {unit}".strip())


def heldout_table(rows: Sequence[HeldoutRow]) -> str:
    """Free-run error on recordings not used for fitting, one row per recording, region and signal."""
    return table(
        (
            "Recording",
            "Region",
            "Signal",
            "Samples",
            "Nominal",
            "Refitted",
            "Corrected",
            "Noise floor",
            "Gain (95 %)",
        ),
        [_heldout_row(row) for row in rows],
        numbers_from=3,
    )


def _heldout_row(row: HeldoutRow) -> list[str]:
    errors = (row.nominal, row.refitted, row.corrected, row.noise_floor)
    scale, unit = words.prefix_for(max((abs(e) for e in errors if e is not None), default=0.0), row.unit)
    shown = ["–" if e is None else f"{words.number(e * scale)}&nbsp;{escape(unit)}" for e in errors]
    if row.corrected is not None:
        shown[2] = f"<b>{shown[2]}</b>"
    gain = "–" if row.gain is None else words.percent(row.gain).replace("-", "−")
    if row.gain_interval is not None:
        digits = 1 if row.gain is not None and abs(row.gain) > 0.97 else 0
        low, high = (f"{100 * bound:.{digits}f}".replace("-", "−") for bound in row.gain_interval)
        gain += f" <span class=note>[{low}, {high}]</span>"
    return [escape(row.recording), escape(row.region), escape(row.signal), str(row.samples), *shown, gain]


def parameter_table(found: Diagnosis) -> str:
    """Nominal parameters as given, as refitted, and as fitted together with the found effects."""
    rows = []
    for name, p in found.nominal_fit.parameters.items():
        corrected = "–" if p.corrected is None else f"<b>{escape(words.estimate(p.corrected))}</b>"
        doubt = f"± {words.percent(p.uncertainty)}" if p.uncertainty else "exact"
        nominal = words.quantity(p.nominal, p.refitted.unit, 4)
        label = escape(name.replace("_", " "))
        rows.append([label, escape(nominal), doubt, escape(words.estimate(p.refitted)), corrected])
    return table(("Parameter", "Nominal", "Declared", "Refitted alone", "With the correction"), rows)
