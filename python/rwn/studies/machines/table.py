"""The table of `rwn evidence`, as Markdown: readable on a screen and in the documentation."""

from __future__ import annotations

from collections.abc import Sequence

from rwn.studies.machines.machine import Error, Outcome

HEAD = (
    "| machine | begins with | found | error on recordings not fitted | nominal | refitted | corrected "
    "| by hand | wanted | published |\n"
    "|---|---|---|---|---|---|---|---|---|---|"
)


def markdown(outcomes: Sequence[Outcome]) -> str:
    """One line per error, then what else was found."""
    lines = [HEAD]
    for outcome in outcomes:
        for k, error in enumerate(outcome.errors):
            begins = (outcome.machine, outcome.begins_with, found_words(outcome)) if k == 0 else ("", "", "")
            lines.append("| " + " | ".join((*begins, *_cells(error))) + " |")
    notes = [f"- {outcome.machine}: {note}" for outcome in outcomes for note in (*_said(outcome), *outcome.notes)]
    return "\n".join([*lines, *(["", *notes] if notes else [])]) + "\n"


def found_words(outcome: Outcome) -> str:
    """The verdict with names, probabilities, and what is not told apart."""
    found = outcome.found
    if not found.effects:
        leads = ", ".join(f"{' + '.join(a.effects)} {a.probability:.2f}" for a in found.alternatives[:3])
        stands_in = f"; stands in: {found.stand_in}" if found.stand_in else ""
        return found.verdict + stands_in + (f" (leads: {leads})" if leads else "")
    names = ", ".join(f"{e.name} {e.probability:.2f}" for e in found.effects)
    same = f"; not told apart: {', '.join(found.set)}" if len(found.set) > 1 else ""
    return names + same


def _said(outcome: Outcome) -> list[str]:
    """What the check of the recordings found."""
    return [f"{of.recording}: {of.words} ({of.done})" for of in outcome.found.findings]


def _cells(error: Error) -> tuple[str, ...]:
    numbers = (error.nominal, error.refitted, error.corrected, error.by_hand)
    wanted = "" if error.wanted is None else f"<= {error.wanted:g}"
    return (error.measure, *("" if n is None else f"{n:.3g}" for n in numbers), wanted, error.published)
