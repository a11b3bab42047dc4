"""A candidate and where its fit ended."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.fit.hypothesis import Candidate
from rwn.fit.levenberg_marquardt import Minimum, Unknown

Array = NDArray[np.float64]

IDLE = 1e-9  # strength, relative to its upper limit, that is none
LIMIT = 1e-3  # relative distance from a limit of a parameter that counts as lying on it


@dataclass(frozen=True, kw_only=True)
class Fitted:
    """A candidate and where its fit ended."""

    added: tuple[str, ...]  # effects beside those of the nominal model
    candidate: Candidate
    minimum: Minimum

    @property
    def cost(self) -> float:
        """Weighted squared error and priors."""
        return self.minimum.cost

    @property
    def vector(self) -> Array:
        """The whole parameter vector at the minimum."""
        return self.candidate.with_values(self.minimum.values)

    @property
    def limits_met(self) -> tuple[str, ...]:
        """Shapes of the added effects that ran into a limit: there a law bends towards one that it is not.

        How strong an effect is says nothing of its law; its limits are those of belief.
        """
        shapes = {
            f"{name}.{p.name}"
            for name in self.added
            for p in self.candidate.table[name].parameters
            if not (p.strength or p.replaces or p.cyclic or p.window or p.idealised)
        }
        pairs = zip(self.candidate.unknowns, self.minimum.values, strict=True)
        return tuple(u.name for u, v in pairs if u.name in shapes and _meets(u, v))

    @property
    def idle(self) -> tuple[str, ...]:
        """Added effects that ended without strength: they say nothing beyond what they take over."""
        pairs = zip(self.candidate.unknowns, self.minimum.values, strict=True)
        reached = {u.name: u.lower > 0.0 or abs(v) > IDLE * u.upper for u, v in pairs}
        strengths = {
            name: [reached[f"{name}.{p.name}"] for p in self.candidate.table[name].parameters if p.strength]
            for name in self.added
        }
        return tuple(name for name, strong in strengths.items() if strong and not any(strong))

    @property
    def windows(self) -> list[tuple[float, float]]:
        """Begin and end of every time window of the added effects, in units of the longest recording."""
        longest = {u.name: u.upper for u in self.candidate.unknowns}
        windows = [[f"{n}.{p.name}" for p in self.candidate.table[n].parameters if p.window] for n in self.added]
        ends = [[self.value(name) / longest[name] for name in names] for names in windows]
        return [(pair[0], pair[1]) for pair in ends if pair]

    @property
    def motor(self) -> dict[str, float]:
        """Nominal parameters as fitted."""
        pairs = zip(self.candidate.unknowns, self.minimum.values, strict=True)
        return {u.name: float(v) for u, v in pairs if "." not in u.name}

    def values_of(self, name: str) -> dict[str, float]:
        """Parameters of one effect as fitted."""
        effect = self.candidate.table[name]
        return {p.name: float(self.vector[effect.at(p.name)]) for p in effect.parameters}

    def value(self, name: str) -> float:
        """A fitted unknown by name ("inertia", "coulomb-friction.coulomb_torque")."""
        names = [u.name for u in self.candidate.unknowns]
        return float(self.minimum.values[names.index(name)])


def _meets(unknown: Unknown, value: float) -> bool:
    """Whether a value lies on a limit; at 0 a law merely loses a part (its damping, its strength)."""
    return any(limit != 0.0 and abs(value - limit) < LIMIT * abs(limit) for limit in (unknown.lower, unknown.upper))
