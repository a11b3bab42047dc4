"""The pictures of a report, as data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rwn.correct.network import NetworkCorrection
from rwn.fit.network_formula import states_of, unit_of_state
from rwn.fit.problem import Problem
from rwn.locate.dependence import CLEAR, Law
from rwn.locate.regions import Region, regions
from rwn.model.vocabulary import motor_index
from rwn.name.initial_guesses import spectra
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.report.diagnosis import Mark, Plot, Trace
from rwn.report.text import law_in_words
from rwn.simulate.run import Run
from rwn.simulate.unknown_inputs import UnknownInputs, unknown_inputs

Array = NDArray[np.float64]
MOST_POINTS = 4000  # of one line


def describe(where: Sequence[Region], laws: Sequence[Law], *, linear: bool) -> str:
    """The located regions, and what the unknown torque depends on, in words."""
    law = [law_in_words(laws[0], linear=linear)] if laws and laws[0].share > CLEAR else []
    strong = [r for r in where if r.share - r.samples_share > 0.1][:2]
    places = [
        f"{r.share:.0%} of the mismatch's energy in {r.samples_share:.0%} of the samples, at "
        + (r.name or f"{r.coordinate} {r.low:.3g} to {r.high:.3g} {r.unit}".rstrip())
        for r in strong
    ]
    return "; ".join(law + places)


def plots(
    ranking: Ranking, chosen: RankedFit, unknown: Sequence[UnknownInputs], laws: Sequence[Law], *, linear: bool
) -> tuple[Plot, ...]:
    """Response, residuals over time and speed, torque over speed, what it depends on, spectrum over angle."""
    whole = ranking.problem.in_free_run()
    free = replace(whole, runs=tuple(r.following_nothing() for r in whole.runs))
    speed_unit, torque_unit = ("m/s", "N") if linear else ("rad/s", "N m")
    position_unit = "m" if linear else "rad"
    made: list[Plot] = []
    for run in free.runs:
        signal = "speed" if run.speed.size else run.recorded[-1]
        unit = {"speed": speed_unit, "position": position_unit, "current": "A"}[signal]
        made += _response(free, ranking, chosen, run, signal, unit)
    if whole.drive.coefficients:
        return tuple(made)
    made.append(_residual_speed(unknown, speed_unit, torque_unit))
    made.append(_torque_speed(whole, chosen, speed_unit, torque_unit))
    made += [_law(law, torque_unit) for law in laws[:1] if law.share > CLEAR]
    spectrum = _spectrum(ranking, linear)
    return (*made, spectrum) if spectrum else tuple(made)


def _thin(x: Array, *lines: Array) -> list[Array]:
    """The same lines over fewer instants, the extremes of every stretch kept so that no spike is lost."""
    stretches = MOST_POINTS // (2 * len(lines))
    if x.size <= MOST_POINTS:
        return [x, *lines]
    edges = np.linspace(0, x.size, stretches + 1).astype(int)
    kept = {0, x.size - 1}
    for y in lines:
        for begin, end in pairwise(edges):
            part = y[begin:end]
            kept |= {int(begin + np.argmin(part)), int(begin + np.argmax(part))}
    chosen = np.array(sorted(kept))
    return [a[chosen] for a in (x, *lines)]


def _thinned_cloud(x: Array, y: Array) -> tuple[Array, Array]:
    """Points of a cloud, evenly spaced in their order, and the farthest out."""
    if x.size <= MOST_POINTS:
        return x, y
    far = np.argsort(np.abs(y - np.median(y)))[-MOST_POINTS // 20 :]
    chosen = np.union1d(np.arange(0, x.size, 1 + x.size // MOST_POINTS), far)
    return x[chosen], y[chosen]


def _response(
    free: Problem, ranking: Ranking, chosen: RankedFit, run: Run, signal: str, unit: str
) -> list[Plot]:
    measured = run.signal(signal)
    refitted = free.simulate(run, ranking.nominal.vector, ranking.nominal.active).signals[signal]
    named = chosen.added
    corrected = free.simulate(run, chosen.final.vector, chosen.final.active).signals[signal] if named else refitted
    t, y, a, b, *_ = _thin(run.time, measured, refitted, corrected, measured - refitted, measured - corrected)
    lines = [
        Trace(name="measured", role="measured", x=t, y=y),
        Trace(name="nominal, refitted", role="refitted", x=t, y=a),
    ]
    errors = [Trace(name="nominal, refitted", role="before", x=t, y=y - a)]
    if named:
        lines.append(Trace(name="corrected", role="corrected", x=t, y=b))
        errors.append(Trace(name="corrected", role="after", x=t, y=y - b))
    label = f"{signal}"
    return [
        Plot(slot="response", title=f"{signal.capitalize()}, {run.name}", x_label="time", x_unit="s", y_label=label,
             y_unit=unit, traces=tuple(lines)),
        Plot(slot="residual-time", title=f"Error of the free run, {run.name}", x_label="time", x_unit="s",
             y_label=f"{signal} error", y_unit=unit, traces=tuple(errors)),
    ]  # fmt: skip


def _residual_speed(unknown: Sequence[UnknownInputs], speed_unit: str, torque_unit: str) -> Plot:
    speed = np.concatenate([u.speed for u in unknown])
    torque = np.concatenate([u.torque for u in unknown])
    rows = _speed_regions(unknown)
    x, y = _thinned_cloud(speed, torque)
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


def _speed_regions(unknown: Sequence[UnknownInputs]) -> list[Mark]:
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


def _torque_speed(whole: Problem, chosen: RankedFit, speed_unit: str, torque_unit: str) -> Plot:
    """Friction over speed: the recordings' own (drive torque minus acceleration torque) and the models'."""
    bare = chosen.final.vector.copy()
    for name in ("viscous_friction", "coulomb_friction"):
        bare[motor_index(name)] = 0.0
    own = [unknown_inputs(whole.drive, whole.simulator, r, bare) for r in whole.runs]
    speed = np.concatenate([u.speed for u in own])
    torque = -np.concatenate([u.torque for u in own])
    x, y = _thinned_cloud(speed, torque)
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


def _spectrum(ranking: Ranking, linear: bool) -> Plot | None:
    """Share of the residual that a torque periodic in angle would explain, where it matters."""
    problem, nominal = ranking.problem, ranking.nominal
    if not all(r.angle.size and r.speed.size for r in problem.runs):
        return None
    grid = spectra.order_grid(problem)
    residuals = problem.residuals(nominal.vector, nominal.active)
    share = spectra.angle_spectrum(problem, nominal.vector, residuals, grid)
    if share.max() < 0.05:
        return None
    return Plot(
        slot="spectrum", title="Residual explained by a torque periodic in angle", x_label="order",
        x_unit="1/m" if linear else "per rev", y_label="share of the residual", y_unit="1",
        traces=(Trace(name="refitted nominal", role="before", x=grid, y=share),),
    )  # fmt: skip


def network_over_its_state(made: NetworkCorrection) -> Plot:
    """The network that stands in for what has no name, as corrected.toml gives it."""
    effect, place = made.model.own_effects[-1], made.place
    states = states_of(made.ranking.problem, place)
    low, high = np.percentile(states, [0.05, 99.95])
    x = np.linspace(0.0, 2.0 * np.pi / place.periods, 400) if place.periods else np.linspace(low, high, 400)
    values = {p.name: p.start for p in effect.parameters} | made.values | {place.state: x}
    return Plot(
        slot="other", title=f"What corrected.toml holds for it: {place.words}",
        x_label=place.state, x_unit=unit_of_state(place),
        y_label="voltage lost" if place.term == "drop" else "force" if place.linear else "torque", y_unit=place.unit,
        traces=(Trace(name="wavelet network", role="corrected", x=x, y=effect.formula.evaluate(values)),),
        note="Fitted in free run together with the nominal parameters.",
    )  # fmt: skip
