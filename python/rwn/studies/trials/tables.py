"""A score as tables, and its reliability plot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from rich.table import Table

from rwn.report.page import plotly_script
from rwn.studies.trials import score
from rwn.studies.trials.grade import NO_RESULT, Grade, Graded
from rwn.studies.trials.plan import FIRST_TEST_SEED

BREAKDOWNS = {
    "visibility": lambda g: g.level,
    "mode": lambda g: g.mode,
    "signals": lambda g: g.signals,
    "effect": lambda g: g.truth[0],
}


def shown(graded: Graded) -> list[str | Table]:
    """Everything that the score says, the promised figures first."""
    grades = graded.grades
    missing = sum(g.verdict == NO_RESULT for g in grades)
    spoilt = score.mistakes(grades)
    return [
        heading(f"{len(grades)} trials", missing, graded.seeds, graded.split),
        target_table(score.targets(grades)),
        *(rows(f"single effects by {name}", name, score.broken_down(grades, by)) for name, by in BREAKDOWNS.items()),
        *([rows("recording mistakes", "mistake", spoilt)] if spoilt else []),
        reliability_table(score.brier(grades), score.reliability(grades), "named"),
        rows("parameters of rightly named effects", "parameter", score.parameter_errors(grades)),
        _confusion(grades),
        _misses(grades),
    ]


def heading(trials: str, missing: int, numbers: Sequence[int], split: str | None) -> str:
    """What was scored: `numbers` are the seeds, none where the answers lay open."""
    trials += f" ({missing} WITHOUT A DIAGNOSIS)" if missing else ""
    if not numbers:
        return f"{trials} with open answers"
    note = "" if split == "test" else f" (not evidence: test seeds start at {FIRST_TEST_SEED})"
    seeds = f"seed{'s' if len(numbers) > 1 else ''} {', '.join(map(str, numbers))}"
    return f"{trials}, {seeds}, {split} split{note}"


def target_table(targets: Sequence[score.Target]) -> Table:
    """What is asked beside what was found."""
    table = Table("figure", "asked", "found", "met", title="targets")
    for target in targets:
        table.add_row(
            target.name, target.asked, target.found, {True: "yes", False: "NO", None: "-"}[target.met]
        )
    return table


def rows(title: str, key: str, figures_of: Mapping[str, Mapping[str, object]]) -> Table:
    """A row of figures for each name."""
    columns = list(next(iter(figures_of.values()))) if figures_of else []
    table = Table(key, *columns, title=title)
    for name, figures in figures_of.items():
        table.add_row(name, *(str(value) for value in figures.values()))
    return table


def reliability_table(brier: tuple[float, int], bins: Sequence[score.Bin], what: str) -> Table:
    """Stated probability against the share that was right."""
    table = Table("stated", "mean", "right", title=f"reliability; Brier {brier[0]:.3f} over {brier[1]} {what}")
    for each in bins:
        table.add_row(f"{each.low:.1f}-{each.high:.1f}", f"{each.stated:.3f}", str(each.right))
    return table


def _confusion(grades: list[Grade]) -> Table:
    table = Table("truth", "answers given", title="confusion (two effects apart)")
    for truth, given in score.confusion(grades).items():
        ordered = sorted(given.items(), key=lambda item: -item[1])
        table.add_row(truth, ", ".join(f"{name} {count}" for name, count in ordered))
    return table


def _misses(grades: list[Grade]) -> Table:
    """The trials that count against a target."""
    table = Table("trial", "mode", "visibility", "signals", "truth", "answer", "p", title="misses")
    for g in grades:
        if not _missed(g):
            continue
        answer = ", ".join(g.names) or g.verdict
        stated = "" if g.probability is None else f"{g.probability:.2f}"
        table.add_row(g.case, g.mode, f"{g.visibility:.1f}", g.signals, ", ".join(g.truth), answer, stated)
    return table


def _missed(g: Grade) -> bool:
    if g.mode == "double":
        return not score.both_found(g)
    if g.mode == "novel":
        return g.confidently_wrong
    return g.false_alarm if g.mode == "null" else not score.named_right(g)


def reliability_plot(bins: Sequence[score.Bin], path: Path) -> None:
    """Stated probability against the share that was right, as a self-contained HTML file."""
    import plotly.graph_objects as go

    figure = go.Figure(layout={"template": "simple_white", "width": 560, "height": 520})
    figure.add_scatter(
        x=[0, 1], y=[0, 1], mode="lines", line={"dash": "dot", "color": "grey"}, name="calibrated"
    )
    figure.add_scatter(
        x=[each.stated for each in bins],
        y=[each.right.hits / each.right.count for each in bins],
        text=[str(each.right) for each in bins],
        mode="lines+markers",
        name="stated",
    )
    figure.update_xaxes(title="stated probability", range=[0, 1])
    figure.update_yaxes(title="share right", range=[0, 1])
    config = {"plotlyServerURL": "", "displaylogo": False}  # nothing leads out of a page that is read offline
    drawn = figure.to_html(include_plotlyjs=False, full_html=False, config=config)
    head = f'<meta charset="utf-8"><title>Reliability</title><script>{plotly_script()}</script>'
    path.write_text(f"<!doctype html><html><head>{head}</head><body>{drawn}</body></html>", encoding="utf-8")
