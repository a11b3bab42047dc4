"""What corrected.toml holds of what a diagnosis states."""

from __future__ import annotations

from rwn.report.diagnosis_data import DiagnosisData
from rwn.report.text import listing, plain_name


def held_part(found: DiagnosisData) -> str:
    """What corrected.toml holds where that is not the explanation that is stated; empty where it is."""
    stated = set(found.explanation.effects) if found.explanation else set()
    if not found.added or stated == set(found.added):
        return ""
    names = listing([plain_name(name) for name in found.added])
    return f"{names} alone" if stated > set(found.added) else names


def holds_no_effect(found: DiagnosisData) -> bool:
    """Whether corrected.toml leaves out all that is stated: what was not fitted is simulated better without it."""
    named = found.explanation is not None and bool(found.explanation.effects)
    return named and bool(found.heldout) and all(row.corrected is None for row in found.heldout)
