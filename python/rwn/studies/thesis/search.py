"""What the searches over unstated choices share: every choice tried, our numbers in one line each, as text."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from rwn.studies.thesis.experiment import Search
from rwn.studies.thesis.formats import number

Values = Sequence[float | None]


def median(values: Sequence[float]) -> float | None:
    """Median over seeds, a run that diverged counting as infinite; None where that is the median."""
    found = float(np.median(np.where(np.isfinite(values), values, np.inf)))
    return found if np.isfinite(found) else None


def search(
    title: str,
    numbers: Mapping[str, float],
    choices: Mapping[str, Callable[[], Values]],
    *,
    taken: str,
    count: str = "",
    unit: str = "",
    progress: Callable[[float], None] = lambda _: None,
) -> Search:
    """Tries every choice; progress(share done)."""
    lines: dict[str, list[float | None]] = {}
    for choice, values in choices.items():
        lines[choice] = [None if v is None or not np.isfinite(v) else float(v) for v in values()]
        progress(len(lines) / len(choices))
    return Search(title=title, numbers=dict(numbers), lines=lines, taken=taken, count=count, unit=unit)


def markdown(found: Search) -> str:
    """The choices as lines, the thesis's numbers as columns; the choice that is taken in bold."""
    thesis = [number(v, found.unit) for v in found.numbers.values()]
    lines = [
        f"**{found.title}**" + (f" ({found.count})" if found.count else ""),
        "",
        "| choice | " + " | ".join(found.numbers) + " | reproduced |",
        "|" + "---|" * (len(found.numbers) + 2),
        "| the thesis | " + " | ".join(thesis) + " | |",
    ]
    for choice, values in found.lines.items():
        name = f"**{choice}**" if choice == found.taken else choice
        cells = " | ".join(number(v, found.unit) for v in values)
        lines.append(f"| {name} | {cells} | {found.near(choice)} of {len(values)} |")
    return "\n".join(lines)
