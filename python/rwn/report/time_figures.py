"""Pictures over time: what each recording shows, what the models make of its input, and what they miss."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.hypothesis import Hypothesis
from rwn.fit.problem import Problem
from rwn.name.ranking import Ranking
from rwn.recording.signals import SIGNALS, si_unit
from rwn.report.plot import Plot, Role, Slot, Trace, Use
from rwn.report.thinning import thin_line
from rwn.simulate.run import Run

Array = NDArray[np.float64]

DRAWN = 3  # recordings of each use
STRETCH = 12  # part of a recording that is looked at closely: one of so many


@dataclass(frozen=True, kw_only=True)
class _Model:
    """One of the models that are compared, and how its lines are drawn."""

    name: str
    role: Role
    vector: Array
    active: Sequence[int]
    error: Role | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class Compared:
    """What a recording shows of one signal: arrays (n,), SI; `left_out`: samples that are not compared."""

    recording: str
    time: Array
    driven: str  # name of the input
    input: Array
    signal: str
    measured: Array
    left_out: NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True, eq=False)
class FreeRun:
    """What a model makes (n,) of the input, and how its lines are drawn; without `error` its error is not."""

    name: str
    role: Role
    values: Array
    error: Role | None = None


def over_time(ranking: Ranking, corrected: Fit, heldout: Sequence[Run], *, linear: bool) -> tuple[Plot, ...]:
    """Input, response and error over each recording, those that were not fitted first; at most three of each use.

    `corrected`: what corrected.toml holds.
    """
    whole = ranking.problem.in_free_run()
    models = _models(whole.as_given(), ranking, corrected)
    pictures: list[Plot] = []
    for use, runs in (("heldout", heldout), ("fit", whole.runs)):
        for run in runs[:DRAWN]:
            free = run.following_nothing()
            pictures += _of_one(replace(whole, runs=(free,)), free, models, use, linear=linear)  # type: ignore[arg-type]
    return tuple(pictures)


def _models(given: Hypothesis, ranking: Ranking, corrected: Fit) -> list[_Model]:
    refitted = ranking.nominal_fit
    models = [
        _Model(name="nominal as given", role="nominal", vector=given.vector, active=given.active),
        _Model(
            name="nominal refitted", role="refitted", vector=refitted.vector, active=refitted.active, error="before"
        ),
    ]
    if corrected.added:
        models.append(
            _Model(name="corrected", role="corrected", vector=corrected.vector, active=corrected.active, error="after")
        )
    return models


def _of_one(problem: Problem, run: Run, models: Sequence[_Model], use: Use, *, linear: bool) -> list[Plot]:
    signal = "speed" if run.speed.size else run.recorded[-1]
    made = [
        FreeRun(
            name=m.name, role=m.role, error=m.error, values=problem.simulate(run, m.vector, m.active).signals[signal]
        )
        for m in models
    ]
    compared = Compared(
        recording=run.name, time=run.time, driven=problem.drive.input, input=run.input, signal=signal,
        measured=run.signal(signal), left_out=run.not_compared(signal),
    )  # fmt: skip
    return panels_of(compared, made, use, linear=linear)


def panels_of(compared: Compared, runs: Sequence[FreeRun], use: Use | None, *, linear: bool) -> list[Plot]:
    """Response, error and input over the time of one recording, with the free run of each model."""
    signal, measured, name = compared.signal, compared.measured, compared.recording
    made = [np.where(np.abs(r.values) < 1e6 * (1.0 + np.nanmax(np.abs(measured))), r.values, np.nan) for r in runs]
    errors = [measured - y for y in made]
    begin, end = _shows_most(errors, compared.left_out)
    after_given = made[1:] or made
    kept = thin_line([measured, compared.input, *after_given, errors[-1]], whole=(begin, end))
    time, unit = compared.time[kept], si_unit(SIGNALS[signal], linear)
    zoom = (float(compared.time[begin]), float(compared.time[end - 1]))

    def picture(slot: Slot, title: str, label: str, unit: str, lines: Sequence[tuple[str, Role, Array]]) -> Plot:
        return Plot(
            slot=slot, title=title, x_label="time", x_unit="s", y_label=label, y_unit=unit, recording=name, use=use,
            zoom=zoom, traces=tuple(Trace(name=n, role=r, x=time, y=y[kept]) for n, r, y in lines),
            shown=_shown(lines),
        )  # fmt: skip

    of_models = [(r.name, r.role, y) for r, y in zip(runs, made, strict=True)]
    of_errors = [(r.name, r.error, y) for r, y in zip(runs, errors, strict=True) if r.error]
    return [
        picture("response", f"{signal.capitalize()} in free run, {name}", signal, unit,
                [("measured", "measured", measured), *of_models]),
        picture("residual-time", f"Error of the {signal}, {name}", f"{signal} error", unit, of_errors),
        picture("input", f"Input, {name}", compared.driven, si_unit(SIGNALS[compared.driven], linear),
                [("input", "reference", compared.input)]),
    ]  # fmt: skip


def _shows_most(errors: Sequence[Array], left_out: NDArray[np.bool_]) -> tuple[int, int]:
    """First sample and end of the stretch where the refitted model errs most beyond what is left in the end."""
    refitted, last = (errors[1:] or errors)[0], errors[-1]
    more = refitted**2 - (last**2 if len(errors) > 2 else 0.0)
    more = np.where(np.isfinite(more) & ~left_out, more, 0.0)
    length = max(more.size // STRETCH, min(more.size, 50))
    sums = np.concatenate([[0.0], np.cumsum(more)])
    begin = int(np.argmax(sums[length:] - sums[:-length]))
    return begin, begin + length


def _shown(lines: Sequence[tuple[str, Role, Array]]) -> tuple[float, float] | None:
    """The range of all lines, where the nominal model runs away at most twice as high as the others."""
    others = np.concatenate([y for _, role, y in lines if role != "nominal"])
    others = others[np.isfinite(others)]
    if not others.size or np.ptp(others) == 0.0:
        return None
    low, high = float(others.min()), float(others.max())
    room = 0.5 * (high - low)
    given = np.concatenate([np.empty(0), *(y for _, role, y in lines if role == "nominal")])
    given = np.clip(given[np.isfinite(given)], low - room, high + room)
    low, high = min([low, *given]), max([high, *given])
    return float(low - 0.1 * room), float(high + 0.1 * room)
