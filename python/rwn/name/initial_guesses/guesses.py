"""Where the fits of an effect begin: at what its table scans, and at what the residual tells of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product

from rwn.fit.fit import Fitted
from rwn.fit.hypothesis import Nominal, candidate, first_unit
from rwn.fit.problem import OutputError
from rwn.model.vocabulary import Effect, motor_index
from rwn.name.initial_guesses import spectra as hints
from rwn.name.initial_guesses.resonance import resonances
from rwn.name.starts import Racer

Start = Mapping[str, float]


@dataclass(frozen=True, kw_only=True)
class Starts:
    """What the starts of one problem have in common."""

    problem: OutputError
    nominal: Nominal
    scales: Mapping[str, float]

    def of(self, base: Fitted, name: str, *, orders: int) -> list[Racer]:
        """The starts of `base` with the effect `name` added; `orders`: how many of a periodic effect."""
        effect = self.nominal.table[name]
        periodic = next((p.name for p in effect.parameters if p.order), "")
        known = {other: base.values_of(other) for other in base.added}
        return [
            Racer(
                name,
                start.get(periodic, 0.0),
                min(k, 1) if effect.at_an_end else 0,
                candidate(self.nominal, (*base.added, name), self.scales, {**known, name: start}, begin),
            )
            for start in self._second_masses(base, effect) or self._guesses(base, effect, orders)
            for k, begin in enumerate((base.motor, *(({},) if _bent(base) else ()), *self.nominal.starts))
        ]

    def _guesses(self, base: Fitted, effect: Effect, orders: int) -> list[Start]:
        """Starting values (SI) of one effect: what its table scans, and hints from the residual of `base`."""
        axes: list[list[Start]] = []
        motor = {**self.nominal.motor, **base.motor}
        for p in effect.parameters:
            if p.order:
                axes.append([{p.name: order} for order in self._orders(base, effect, p.lower, orders)])
            elif p.window:
                continue
            elif p.scan:
                axes.append([{p.name: s * first_unit(effect, p, motor, self.scales)} for s in p.scan])
        if any(p.window for p in effect.parameters):
            first, last = (p.name for p in effect.parameters if p.window)
            axes.append([{first: a, last: b} for a, b in self._windows(base)])
        return [{k: v for part in combination for k, v in part.items()} for combination in product(*axes)]

    def _second_masses(self, base: Fitted, effect: Effect) -> list[Start]:
        """What the resonances of the residual of `base` say of a second mass, if it has any."""
        names = [p.name for p in effect.parameters if p.resonance]
        if not names:
            return []
        residuals = self.problem.residuals(base.vector, base.candidate.active)
        inertia = float(base.vector[motor_index("inertia")])
        found = resonances(self.problem, base.vector, residuals)
        return [dict(zip(names, resonance.of(inertia), strict=True)) for resonance in found]

    def _orders(self, base: Fitted, effect: Effect, lowest: float, count: int) -> list[float]:
        if not any(t.angle.size for t in self.problem.targets):
            return []
        problem = hints.along_the_shaft(self.problem, base.vector, base.candidate.active)
        grid = hints.order_grid(problem)
        grid = grid[grid >= lowest]  # once per revolution is an unbalance
        if not any(t.speed.size for t in problem.targets):
            spectrum = hints.torque_spectrum(problem, base.vector, base.candidate.active, grid)
            return hints.orders_of(spectrum, grid, count)
        residuals = problem.residuals(base.vector, base.candidate.active)
        found: list[float] = []
        wanted: tuple[tuple[bool, int], ...] = ((False, count),)  # with the current or without, and how many orders
        if effect.site == "flux" and all(t.current.size for t in problem.targets):
            found = hints.orders_of(hints.flux_spectrum(problem, base.vector, grid), grid, count)
            wanted = ((True, 1),)
        elif effect.site == "flux":  # a current that was not recorded is known badly
            wanted = ((True, count), (False, count))
        for with_current, most in wanted:
            spectrum = hints.angle_spectrum(problem, base.vector, residuals, grid, with_current=with_current)
            found += hints.orders_of(spectrum, grid, most)
        return list(dict.fromkeys(found))

    def _windows(self, base: Fitted) -> list[tuple[float, float]]:
        residuals = self.problem.residuals(base.vector, base.candidate.active)
        return hints.windows(self.problem, base.vector, residuals)


def _bent(base: Fitted) -> bool:
    """Whether a fit has moved the motor so far that what is missing may have bent it: then its start is worth a try."""
    return any(
        u.prior is not None and u.prior > 0.0 and abs(v - u.prior) > 0.5 * u.prior_std * u.prior
        for u, v in zip(base.candidate.unknowns, base.minimum.values, strict=True)
    )
