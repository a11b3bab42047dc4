"""Two diagnoses beside each other: before and after a repair, or two machines of one kind."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from html import escape
from pathlib import Path

from rwn.fit.intervals import Estimate
from rwn.model.vocabulary import table as table_of_effects
from rwn.name.found_effect import FoundEffect
from rwn.report import text as words
from rwn.report.account_picture import account_picture
from rwn.report.diagnosis_data import DiagnosisData
from rwn.report.nominal_fit import FittedParameter
from rwn.report.page import document, figures, section
from rwn.report.proof_sentences import before_after, headline
from rwn.report.sentences import sentences
from rwn.report.tables import table

NO_LAW = "<p>No law is drawn.</p>"


def comparison(first: DiagnosisData, second: DiagnosisData, names: tuple[str, str]) -> str:
    """A page with what each diagnosis says, what both name, and how parameters and laws differ."""
    pair = (first, second)
    head = tuple(escape(name) for name in names)
    columns = "".join(
        section(name, f"<p><b>{escape(sentences(found)[0])}</b></p>{account_picture(found)}")
        for name, found in zip(names, pair, strict=True)
    )
    laws = "".join(
        f"<div><h3>{name}</h3>{figures(found, ('law',), prefix=f'{k}-') or NO_LAW}</div>"
        for k, (name, found) in enumerate(zip(head, pair, strict=True))
    )
    drawn = any(plot.slot == "law" for found in pair for plot in found.curves)
    parts = (
        f'<div class="top even">{columns}</div>',
        section("What differs", table(("What", *names, "Differs"), list(_rows(first, second)), numbers_from=9)),
        section("Laws", f'<div class="top even">{laws}</div>' if drawn else ""),
    )
    body = "\n".join(parts)
    title = f'<header><div class="kind">Comparison</div><h1>{head[0]} and {head[1]}</h1></header>'
    return document(f"{names[0]} and {names[1]}", "#37474f", title + body)


def _rows(first: DiagnosisData, second: DiagnosisData) -> Iterator[list[str]]:
    """Label, what each says, and whether they differ by more than their intervals."""
    yield ["Verdict", first.verdict, second.verdict, _differs(first.verdict != second.verdict)]
    models = [{source.sha256 for source in found.sources if source.use == "model"} for found in (first, second)]
    if all(models):
        yield ["Model that it began with", *map(_model, (first, second)), _differs(models[0] != models[1])]
    yield ["Error, proved", _proof(first), _proof(second), "–"]
    effects = [{effect.name: effect for effect in found.effects} for found in (first, second)]
    fits = [found.nominal_fit.parameters for found in (first, second)]
    told = set[str]()
    for name in dict.fromkeys((*effects[0], *effects[1])):
        yield from _effect(name, effects[0].get(name), effects[1].get(name), fits)
        told |= {*_in_nominal(name).values()}
    for name in dict.fromkeys((*fits[0], *fits[1])):
        if name not in told or all(name in parameters for parameters in fits):
            best = [_best(parameters, name) for parameters in fits]
            yield [escape(words.capital(words.parameter_in_words(name))), *map(_value, best), _apart(*best)]


def _effect(
    name: str, first: FoundEffect | None, second: FoundEffect | None, fits: Sequence[Mapping[str, FittedParameter]]
) -> Iterator[list[str]]:
    """What each result found of an effect, or has of it in the model that it began with."""
    both, nominal = (first, second), _in_nominal(name)
    title = f"<b>{escape(words.capital(words.plain_name(name)))}</b>"
    said = []
    for effect, parameters in zip(both, fits, strict=True):
        known = any(p in parameters for p in nominal.values())
        found = f"probability {words.likelihood(effect.probability)}" if effect else ""
        said.append(found or ("in the model" if known else "not found"))
    yield [title, *said, _differs("not found" in said)]
    for parameter in next(effect for effect in both if effect).parameters:
        values = [
            effect.parameters.get(parameter) if effect else _best(parameters, nominal.get(parameter, ""))
            for effect, parameters in zip(both, fits, strict=True)
        ]
        yield [escape(words.capital(words.parameter_name(name, parameter))), *map(_value, values), _apart(*values)]


def _in_nominal(name: str) -> dict[str, str]:
    """What the parameters of an effect are called in a model that holds it, or the plain law that it takes over."""
    known = table_of_effects().get(name)
    return {p.name: p.replaces or f"{name}.{p.name}" for p in known.parameters} if known else {}


def _best(parameters: Mapping[str, FittedParameter], name: str) -> Estimate | None:
    found = parameters.get(name)
    if found is None:
        return None
    return found.refitted if found.corrected is None else found.corrected


def _model(found: DiagnosisData) -> str:
    return ", ".join(escape(Path(source.path).name) for source in found.sources if source.use == "model")


def _proof(found: DiagnosisData) -> str:
    row = headline(found)
    return "–" if row is None else escape(f"{row.signal}, {row.recording}: {' → '.join(before_after(row))}")


def _value(value: Estimate | None) -> str:
    return "–" if value is None else escape(words.estimate(value))


def _apart(first: Estimate | None, second: Estimate | None) -> str:
    """Whether two values differ by more than their intervals; one without an interval is taken as exact."""
    if first is None or second is None:
        return "–"
    (a, b), (c, d) = (value.interval or (value.value, value.value) for value in (first, second))
    return _differs(b < c or d < a)


def _differs(differs: bool) -> str:
    return '<b class="flag">yes</b>' if differs else "no"
