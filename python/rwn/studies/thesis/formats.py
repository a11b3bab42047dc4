"""Numbers and places of the thesis as text."""

from __future__ import annotations


def number(value: float | None, unit: str = "") -> str:
    """Three digits, plain or as a power of ten."""
    if value is None:
        return "diverged"
    plain = value == 0 or 1e-3 <= abs(value) < 1e5
    text = f"{value:.3g}" if plain else f"{value:.2e}".replace("e-0", "e-").replace("e+0", "e+")
    return text + (f" {unit}" if unit else "")


# The first table behind each figure that has a number of its own.
_BEFORE = {30: 9, 37: 10, 46: 11, 49: 11, 51: 11, 54: 11, 104: 21}


def where_order(where: str) -> tuple[float, int]:
    """Sorts "Table 9" and "Figure 30" as the thesis has them."""
    kind, _, text = where.partition(" ")
    digits = int(text) if text.isdigit() else 10_000
    return (digits, 0) if kind == "Table" else (_BEFORE.get(digits, digits) - 0.5, digits)
