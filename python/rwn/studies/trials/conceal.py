"""How the nominal model came about: what its author believes of each value, and how it hides an effect."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rwn.studies.trials.plant import Values

Rng = np.random.Generator

SINGLE = ("plain", "masked", "offset")
# One-sigma ranges of data sheets; a few benches are declared with far less confidence.
CAREFUL = {
    "resistance": (0.03, 0.1),
    "inductance": (0.08, 0.2),
    "torque_constant": (0.02, 0.06),
    "inertia": (0.05, 0.12),
    "viscous_friction": (0.3, 0.8),
    "coulomb_friction": (0.15, 0.35),
}
VAGUE = {
    "resistance": (0.1, 0.2),
    "torque_constant": (0.05, 0.12),
    "inertia": (0.2, 0.4),
    "viscous_friction": (0.8, 1.0),
    "coulomb_friction": (0.4, 0.6),
}


@dataclass(frozen=True)
class Nominal:
    """The model file: values, and the relative standard deviation of those that are not exact."""

    values: Values
    uncertainty: Values


def draw_uncertainty(rng: Rng, true: Values) -> Values:
    """Declared relative standard deviations; half of the benches know their inductance exactly."""
    ranges = CAREFUL | (VAGUE if rng.random() < 0.2 else {})
    drawn = {name: float(rng.uniform(*bounds)) for name, bounds in ranges.items() if name in true}
    drawn["back_emf_constant"] = drawn["torque_constant"]
    if rng.random() < 0.5:
        del drawn["inductance"]
    return {name: drawn[name] for name in true if name in drawn}


def nominal_as(mode: str, rng: Rng, true: Values, uncertainty: Values, refitted: Values) -> Nominal:
    """plain: the true values; masked: those of the refit, declared with room for it; else off at random."""
    if mode == "plain":
        return Nominal(dict(true), dict(uncertainty))
    if mode == "masked":
        declared = {
            name: max(sigma, abs(float(np.log(refitted[name] / true[name]))) / float(rng.uniform(1.0, 2.0)))
            for name, sigma in uncertainty.items()
        }
        return Nominal(dict(refitted), declared)
    off = {name: float(np.clip(rng.standard_normal(), -2.0, 2.0)) for name in uncertainty}
    off["back_emf_constant"] = off["torque_constant"]  # one figure on the data sheet
    values = {
        name: value * float(np.exp(uncertainty.get(name, 0.0) * off.get(name, 0.0)))
        for name, value in true.items()
    }
    return Nominal(values, dict(uncertainty))
