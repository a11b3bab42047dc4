"""The score of bench trials as tables."""

from __future__ import annotations

from collections.abc import Sequence

from rich.table import Table

from rwn.studies.trials.bench_trials import score
from rwn.studies.trials.bench_trials.grade import BenchGrade, BenchGraded
from rwn.studies.trials.grade import NO_RESULT
from rwn.studies.trials.tables import heading, reliability_table, rows, target_table


def shown(graded: BenchGraded) -> list[str | Table]:
    """Everything that the score says, the figures with targets first."""
    grades = graded.grades
    missing = sum(g.verdict == NO_RESULT for g in grades)
    return [
        heading(f"{len(grades)} bench trials", missing, graded.seeds, graded.split),
        target_table(score.targets(grades)),
        *(rows(f"by {name}", name, score.broken_down(grades, keys)) for name, keys in score.BREAKDOWNS.items()),
        reliability_table(score.brier(grades), score.reliability(grades), "statements"),
        _misses(grades),
    ]


def _misses(grades: Sequence[BenchGrade]) -> Table:
    """The trials that count against a target."""
    table = Table("trial", "truth", "visibility", "background", "imperfections", "judge", "stated", title="misses")
    for g in filter(score.missed, grades):
        stated = ", ".join(f"{s.name or 'nothing missing'} {s.probability:.2f}" for s in g.stated)
        notes = [stated or g.verdict, *(["corrected is worse"] if any(g.worse) else [])]
        truth = ", ".join(g.truth) or "-"
        table.add_row(
            g.case, truth, f"{g.visibility:.1f}", g.background, ", ".join(g.kinds), g.judge, "; ".join(notes)
        )
    return table
