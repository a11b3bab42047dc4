"""The pictures of a report, as data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rwn.fit.problem import OutputError
from rwn.fit.residuals import Hypothesis
from rwn.locate.dependence import CLEAR, Law
from rwn.locate.unknown_inputs import Unknown, regions, unknown_inputs
from rwn.model.vocabulary import motor_index
from rwn.name.initial_guesses import spectra as hints
from rwn.report.diagnosis import Mark, Plot, Region, Trace

if TYPE_CHECKING:
    from rwn.name.forward import Explanation

Array = NDArray[np.float64]
MOST_POINTS = 4000  # of one line


def describe(where: Sequence[Region], laws: Sequence[Law], *, linear: bool) -> str:
    """The located regions, and what the unknown torque depends on, in words."""
    law = [laws[0].words(linear=linear)] if laws and laws[0].share > CLEAR else []
    strong = [r for r in where if r.share - r.samples_share > 0.1][:2]
    places = [
        f"{r.share:.0%} of the mismatch's energy in {r.samples_share:.0%} of the samples, at "
        + (r.name or f"{r.coordinate} {r.low:.3g} to {r.high:.3g} {r.unit}".rstrip())
        for r in strong
    ]
    return "; ".join(law + places)


def plots(
    found: Explanation, chosen: Hypothesis, unknown: Sequence[Unknown], laws: Sequence[Law], *, linear: bool
) -> tuple[Plot, ...]:
    """Response, residuals over time and speed, torque over speed, what it depends on, spectrum over angle."""
    whole = found.setup.whole
    free = replace(whole, targets=tuple(replace(t, angle=np.empty(0)) for t in whole.targets))
    speed_unit, torque_unit = ("m/s", "N") if linear else ("rad/s", "N m")
    position_unit = "m" if linear else "rad"
    made: list[Plot] = []
    for k, target in enumerate(free.targets):
        signal = "speed" if target.speed.size else target.recorded[-1]
        unit = {"speed": speed_unit, "position": position_unit, "current": "A"}[signal]
        made += _response(free, found, chosen, k, signal, unit)
    if whole.kind == "lti":
        return tuple(made)
    made.append(_residual_speed(unknown, speed_unit, torque_unit))
    made.append(_torque_speed(found, chosen, speed_unit, torque_unit))
    made += [_law(law, torque_unit) for law in laws[:1] if law.share > CLEAR]
    spectrum = _spectrum(found, linear)
    return (*made, spectrum) if spectrum else tuple(made)


def _thin(*arrays: Array) -> list[Array]:
    step = max(1, arrays[0].size // MOST_POINTS)
    return [a[::step] for a in arrays]


def _response(
    free: OutputError, found: Explanation, chosen: Hypothesis, k: int, signal: str, unit: str
) -> list[Plot]:
    target = free.targets[k]
    measured = target.signal(signal)
    refitted = free.simulate(target, found.nominal.vector, found.nominal.candidate.active).signals[signal]
    t, y, a = _thin(target.time, measured, refitted)
    lines = [
        Trace(name="measured", role="measured", x=t, y=y),
        Trace(name="nominal, refitted", role="refitted", x=t, y=a),
    ]
    errors = [Trace(name="nominal, refitted", role="before", x=t, y=y - a)]
    if chosen.fitted.added:
        (b,) = _thin(
            free.simulate(target, chosen.final.vector, chosen.final.candidate.active).signals[signal]
        )
        lines.append(Trace(name="corrected", role="corrected", x=t, y=b))
        errors.append(Trace(name="corrected", role="after", x=t, y=y - b))
    label = f"{signal}"
    return [
        Plot(slot="response", title=f"{signal.capitalize()}, {target.name}", x_label="time", x_unit="s", y_label=label,
             y_unit=unit, traces=tuple(lines)),
        Plot(slot="residual-time", title=f"Error of the free run, {target.name}", x_label="time", x_unit="s",
             y_label=f"{signal} error", y_unit=unit, traces=tuple(errors)),
    ]  # fmt: skip


def _residual_speed(unknown: Sequence[Unknown], speed_unit: str, torque_unit: str) -> Plot:
    speed = np.concatenate([u.speed for u in unknown])
    torque = np.concatenate([u.torque for u in unknown])
    rows = _speed_regions(unknown)
    x, y = _thin(speed, torque)
    return Plot(
        slot="residual-speed", title="Unknown torque of the refitted nominal model over speed", x_label="speed",
        x_unit=speed_unit, y_label="unknown torque", y_unit=torque_unit,
        traces=(
            Trace(name="along the recording", role="before", x=x, y=y, points=True),
            _mean_curve(speed, torque, "mean", "reference"),
        ),
        marks=tuple(rows),
        note="What the refitted nominal equations leave over along the recorded motion, smoothed.",
    )  # fmt: skip


def _speed_regions(unknown: Sequence[Unknown]) -> list[Mark]:
    found = [r for r in regions(unknown) if r.coordinate == "speed" and r.share - r.samples_share > 0.1]
    if not found:
        return []
    r = found[0]
    if r.low < 0.0:
        return [Mark(low=r.low, high=r.high, label=r.name)]
    return [Mark(low=r.low, high=r.high, label=r.name or "located"), Mark(low=-r.high, high=-r.low, label="")]


def _mean_curve(x: Array, y: Array, name: str, role: str) -> Trace:
    edges = np.unique(np.quantile(x, np.linspace(0.0, 1.0, 41)))
    place = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, edges.size - 2)
    n = np.maximum(np.bincount(place, minlength=edges.size - 1), 1)
    means = np.bincount(place, y, edges.size - 1) / n
    middles = np.bincount(place, x, edges.size - 1) / n
    return Trace(name=name, role=role, x=middles, y=means)  # type: ignore[arg-type]


def _torque_speed(found: Explanation, chosen: Hypothesis, speed_unit: str, torque_unit: str) -> Plot:
    """Friction over speed: the recordings' own (drive torque minus acceleration torque) and the models'."""
    whole = found.setup.whole
    bare = chosen.final.vector.copy()
    for name in ("viscous_friction", "coulomb_friction"):
        bare[motor_index(name)] = 0.0
    own = [unknown_inputs(whole, bare, t) for t in whole.targets]
    speed = np.concatenate([u.speed for u in own])
    torque = -np.concatenate([u.torque for u in own])
    x, y = _thin(speed, torque)
    return Plot(
        slot="torque-speed", title="Braking torque over speed", x_label="speed", x_unit=speed_unit,
        y_label="braking torque", y_unit=torque_unit,
        traces=(Trace(name="along the recording", role="measured", x=x, y=y, points=True),
                _mean_curve(speed, torque, "mean", "reference")),
        note="Driving torque minus acceleration torque along the recorded motion, smoothed.",
    )  # fmt: skip


def _law(law: Law, torque_unit: str) -> Plot:
    return Plot(
        slot="other", title=f"Unknown torque over {law.coordinate}, as a wavelet network draws it",
        x_label=law.coordinate, x_unit=law.unit, y_label="unknown torque", y_unit=torque_unit,
        traces=(Trace(name="wavelet network", role="reference", x=law.x, y=law.torque),),
        note=f"It explains {law.share:.0%} of the refitted nominal model's error on samples that it was not fitted to.",
    )  # fmt: skip


def _spectrum(found: Explanation, linear: bool) -> Plot | None:
    """Share of the residual that a torque periodic in angle would explain, where it matters."""
    problem = found.setup.problem
    if not all(t.angle.size and t.speed.size for t in problem.targets):
        return None
    grid = hints.order_grid(problem)
    residuals = problem.residuals(found.nominal.vector, found.nominal.candidate.active)
    share = hints.angle_spectrum(problem, found.nominal.vector, residuals, grid)
    if share.max() < 0.05:
        return None
    return Plot(
        slot="spectrum", title="Residual explained by a torque periodic in angle", x_label="order",
        x_unit="1/m" if linear else "per rev", y_label="share of the residual", y_unit="1",
        traces=(Trace(name="refitted nominal", role="before", x=grid, y=share),),
    )  # fmt: skip
