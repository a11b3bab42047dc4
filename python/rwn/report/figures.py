"""The pictures of a report, as data."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.correct.network import NetworkCorrection
from rwn.fit.fit import Fit
from rwn.mismatch_map.dependence import CLEAR, Law
from rwn.mismatch_map.regions import regions
from rwn.name.initial_guesses import spectra
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.report.law_figures import laws_of_effects, over_its_state
from rwn.report.plot import Mark, Plot, Trace
from rwn.report.thinning import MOST_POINTS, thin_cloud, worth_seeing
from rwn.report.time_figures import over_time
from rwn.simulate.run import Run
from rwn.simulate.unknown_inputs import UnknownInputs
from rwn.unnamed_law.places import range_of, states_of, unit_of_state, unit_of_weights

Array = NDArray[np.float64]

WORTH_SEEING = 0.05  # of the residual, that the highest line explains


def plots(
    ranking: Ranking, chosen: RankedFit, corrected: Fit, heldout: Sequence[Run], inputs: Sequence[UnknownInputs],
    laws: Sequence[Law], network: NetworkCorrection | None, *, linear: bool,
) -> tuple[Plot, ...]:  # fmt: skip
    """Each recording over time, what is unknown over speed, the laws of effects or of what is unnamed, the spectrum."""
    made = over_time(ranking, corrected, heldout, linear=linear)
    if ranking.problem.drive.coefficients:
        return made
    names = [run.name for run in ranking.problem.whole]
    named = bool(chosen.added) and network is None
    drawn = laws_of_effects(ranking, chosen, linear=linear) if named else ()
    if not drawn:
        drawn = tuple(over_its_state(law, "N" if linear else "N m") for law in laws[:1] if law.share > CLEAR)
    if network is not None:
        drawn = (*drawn, network_over_its_state(network))
    spectrum = _spectrum(ranking, linear)
    where = unknown_over_speed(names, inputs, linear=linear)
    return (*made, where, *([spectrum] if spectrum else []), *drawn)


def unknown_over_speed(names: Sequence[str], inputs: Sequence[UnknownInputs], *, linear: bool) -> Plot:
    """What the equations of the refitted nominal model leave over, of recordings called `names`, over their speed."""
    what, unit = ("force", "N") if linear else ("torque", "N m")
    if inputs[0].lacking == "voltage":
        what, unit = "voltage", "V"
    mismatch = np.concatenate([u.mismatch for u in inputs])
    mean = _mean_curve(np.concatenate([u.speed for u in inputs]), mismatch)
    clouds = []
    for name, u in zip(names, inputs, strict=True):
        kept = thin_cloud(u.mismatch, most=MOST_POINTS // len(inputs))
        clouds.append(
            Trace(
                name=name,
                role="before",
                x=u.speed[kept],
                y=u.mismatch[kept],
                at=u.time[kept],
                recording=name,
                points=True,
            )
        )
    return Plot(
        slot="residual-speed", title=f"Unknown {what} of the refitted nominal model over speed", x_label="speed",
        x_unit="m/s" if linear else "rad/s", y_label=f"unknown {what}", y_unit=unit, traces=(*clouds, mean),
        marks=tuple(_speed_regions(inputs)), shown=worth_seeing(mismatch, mean.y),
        note="What the refitted nominal equations leave over along the recorded motion, smoothed.",
    )  # fmt: skip


def _speed_regions(inputs: Sequence[UnknownInputs]) -> list[Mark]:
    found = [r for r in regions(inputs) if r.coordinate == "speed" and r.share - r.samples_share > 0.1]
    if not found:
        return []
    r = found[0]
    if r.low < 0.0:
        return [Mark(low=r.low, high=r.high, label=r.name)]
    return [Mark(low=r.low, high=r.high, label=r.name or "located"), Mark(low=-r.high, high=-r.low, label="")]


def _mean_curve(x: Array, y: Array) -> Trace:
    edges = np.unique(np.quantile(x, np.linspace(0.0, 1.0, 41)))
    edges = edges if edges.size > 1 else np.array([edges[0], edges[0]])  # one speed, as of a run that told none
    place = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, edges.size - 2)
    n = np.maximum(np.bincount(place, minlength=edges.size - 1), 1)
    means = np.bincount(place, y, edges.size - 1) / n
    middles = np.bincount(place, x, edges.size - 1) / n
    return Trace(name="mean", role="reference", x=middles, y=means)


def _spectrum(ranking: Ranking, linear: bool) -> Plot | None:
    """Share of the residual that a torque periodic in angle would explain, where it matters."""
    problem, nominal = ranking.problem, ranking.nominal_fit
    if not all(r.angle.size and r.speed.size for r in problem.runs):
        return None
    grid = spectra.order_grid(problem)
    residuals = problem.residuals(nominal.vector, nominal.active)
    share = spectra.angle_spectrum(problem, nominal.vector, residuals, grid)
    highest = int(np.argmax(share))
    if share[highest] < max(WORTH_SEEING, spectra.highest_by_chance(share)):
        return None
    unit = "1/m" if linear else "per rev"
    return Plot(
        slot="spectrum", title="Residual explained by a torque periodic in angle", x_label="order",
        x_unit=unit, y_label="share of the residual", y_unit="1",
        traces=(Trace(name="refitted nominal", role="measured", x=grid, y=share),),
        note=f"Highest at {grid[highest]:.4g} {unit}: {share[highest]:.0%}.",
    )  # fmt: skip


def network_over_its_state(made: NetworkCorrection) -> Plot:
    """The network that stands in for what has no name, as corrected.toml gives it."""
    effect, place = made.model.own_effects[-1], made.place
    low, high = range_of(states_of(made.ranking.problem, place))
    x = np.linspace(0.0, 2.0 * np.pi / place.periods, 400) if place.periods else np.linspace(low, high, 400)
    values = {p.name: p.start for p in effect.parameters} | made.values
    values |= {place.factor: 1.0} if place.factor else {}
    shape, name = {**values, place.state: x}, place.drawn_by.removeprefix("a ")
    return Plot(
        slot="law", title=f"What corrected.toml holds for it: {place.words}",
        x_label=place.state, x_unit=unit_of_state(made.ranking.problem, place),
        y_label=place.drawn.kind, y_unit=unit_of_weights(made.ranking.problem, place.drawn),
        traces=(Trace(name=name, role="corrected", x=x, y=effect.formula.evaluate(shape)),),
        note="Fitted in free run together with the nominal parameters.",
    )  # fmt: skip
