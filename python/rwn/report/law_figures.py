"""The laws that were found, drawn over the points that they are to explain."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.mismatch_map.dependence import Law
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.report.plot import Plot, Trace
from rwn.report.text import plain_name
from rwn.report.thinning import MOST_POINTS, thin_cloud, thin_line, worth_seeing
from rwn.simulate.unknown_inputs import UnknownInputs, unknown_inputs

Array = NDArray[np.float64]

LAWS = 3  # effects whose law is drawn
BINS = 240  # of a curve over its state
LEAST_SHOWN = 0.5  # share of an effect's own energy that a curve over one state must show, to be drawn
UNITS = {"speed": "rad/s", "angle": "rad", "current": "A", "acceleration": "rad/s^2", "time": "s"}


class _Along(NamedTuple):
    """One signal along all recordings: what is left without an effect, and what the effect adds there."""

    label: str
    unit: str
    left: Array
    effect: Array


def laws_of_effects(ranking: Ranking, chosen: RankedFit, *, linear: bool) -> tuple[Plot, ...]:
    """Each named effect over the state that it depends on most, on what all else leaves; those that show it alone."""
    problem, this = ranking.problem.in_free_run(), chosen.final
    table = this.hypothesis.table

    def inputs(active: Sequence[int]) -> list[UnknownInputs]:
        return [unknown_inputs(problem.drive, problem.simulator, r, this.vector, active) for r in problem.whole]

    full = inputs(this.active)
    made = []
    for name in chosen.added[:LAWS]:
        without = inputs([k for k in this.active if k != table[name].index])
        plot = _law(name, full, without, linear=linear)
        if plot is not None:
            made.append(plot)
    return tuple(made)


def _law(name: str, full: Sequence[UnknownInputs], without: Sequence[UnknownInputs], *, linear: bool) -> Plot | None:
    signals = [_along("torque", "N" if linear else "N m", full, without)]
    if all(u.voltage.size for u in full):
        signals.append(_along("voltage", "V", full, without))
    shares = [float(np.sum(s.effect**2) / max(np.sum(s.left**2), 1e-300)) for s in signals]
    best = signals[int(np.argmax(shares))]
    if not np.isfinite(shares).all() or max(shares) < 0.05:
        return None
    states = _states(full)
    shares_shown = {state: _share_shown(x, best.effect) for state, x in states.items()}
    state = max(shares_shown, key=lambda s: shares_shown[s])
    if shares_shown[state] < LEAST_SHOWN:
        return None
    x, unit = states[state], UNITS[state].replace("rad/s", "m/s") if linear else UNITS[state]
    runs = [u.time.size for u in full]
    curve = _over_time(x, best.effect, runs) if state == "time" else _curve(x, best.effect)
    kept = thin_cloud(best.left)
    outside = worth_seeing(best.left, curve.y)
    return Plot(
        slot="law", title=f"{plain_name(name).capitalize()} over {state}".replace("coulomb", "Coulomb"), x_label=state,
        x_unit=unit, y_label=f"unknown {'force' if best.unit == 'N' else best.label}", y_unit=best.unit, shown=outside,
        traces=(
            Trace(name="left by all else", role="measured", x=x[kept], y=best.left[kept], points=True),
            Trace(name=plain_name(name), role="corrected", x=curve.x, y=curve.y),
        ),
        note="Points: what the corrected model leaves over along the recorded motion without this effect, smoothed. "
        "Line: the effect as it was fitted.",
    )  # fmt: skip


def _along(label: str, unit: str, full: Sequence[UnknownInputs], without: Sequence[UnknownInputs]) -> _Along:
    left, rest = (np.concatenate([getattr(u, label) for u in us]) for us in (without, full))
    return _Along(label, unit, left, left - rest)


def _states(inputs: Sequence[UnknownInputs]) -> dict[str, Array]:
    """What a law may depend on (n,); the angle within one revolution, where there was more than one."""
    states = {name: np.concatenate([getattr(u, name) for u in inputs]) for name in UNITS}
    if np.ptp(states["angle"]) > 2.0 * np.pi:
        states["angle"] = np.mod(states["angle"], 2.0 * np.pi)
    return {name: x for name, x in states.items() if np.ptp(x) > 0.0}


def _share_shown(x: Array, y: Array) -> float:
    """Share of the energy of y (n,) that a curve over x (n,) shows."""
    place, n = _bins(x)
    means = np.bincount(place, y, n.size) / n
    return float(1.0 - np.sum((y - means[place]) ** 2) / max(np.sum(y**2), 1e-300))


def _curve(x: Array, y: Array) -> Trace:
    place, n = _bins(x)
    return Trace(name="", role="corrected", x=np.bincount(place, x, n.size) / n, y=np.bincount(place, y, n.size) / n)


def _over_time(time: Array, y: Array, runs: Sequence[int]) -> Trace:
    """The values themselves (n,) with their peaks, recording by recording: means would flatten what oscillates."""
    ends, most = np.cumsum(runs), MOST_POINTS // len(runs)
    parts = [(time[end - n : end], y[end - n : end]) for n, end in zip(runs, ends, strict=True)]
    drawn = [(t[kept], values[kept]) for t, values in parts for kept in [thin_line([values], most=most)]]
    broken = [part for t, values in drawn for part in ((t, values), (t[-1:], np.array([np.nan])))][:-1]
    x, values = (np.concatenate([part[k] for part in broken]) for k in (0, 1))
    return Trace(name="", role="corrected", x=x, y=values)


def _bins(x: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The bin of each sample, none of them empty, and how many samples each has."""
    edges = np.unique(np.quantile(x, np.linspace(0.0, 1.0, min(BINS, max(x.size // 20, 2)) + 1)))
    place = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, max(edges.size - 2, 0))
    _, place, counts = np.unique(place, return_inverse=True, return_counts=True)
    return place, counts


def over_its_state(law: Law, torque_unit: str) -> Plot:
    """What depends on one state and has no name: the wavelet network over the unknown torque of the recordings."""
    what = "force" if torque_unit == "N" else "torque"
    return Plot(
        slot="law", title=f"Unknown {what} over {law.coordinate}", x_label=law.coordinate, x_unit=law.unit,
        y_label=f"unknown {what}", y_unit=torque_unit, shown=worth_seeing(law.left, law.torque),
        traces=(
            Trace(name="of the recordings, means", role="before", x=law.state, y=law.left, points=True),
            Trace(name="wavelet network", role="reference", x=law.x, y=law.torque),
        ),
        note=f"The network explains {law.share:.0%} of the refitted nominal model's error on parts of the fitted "
        "recordings that its own fit left out; what helps on other recordings, the proof tells. "
        "Points and line are without what other values of the nominal parameters would explain.",
    )  # fmt: skip
