"""What an effect is to the blind trials: how to draw, scale and build it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from rwn.studies.trials.motors import Motor
from rwn.studies.trials.plant import Values

Draw = Callable[[np.random.Generator, "Situation"], Values]
Scale = Callable[[Values, float], Values]
Build = Callable[[Values, Values], Values]


@dataclass(frozen=True)
class Situation:
    """The motor as it runs on this bench without the effect: the scales for drawing one."""

    motor: Motor
    nominal: Values  # the true values of the nominal structure
    rate: float  # Hz
    duration: float  # of the shortest recording [s]
    voltage: float  # largest command [V]
    speed: float  # rms [rad/s]
    current: float  # rms [A]
    current_peak: float
    signals: tuple[str, ...]
    encoder: bool

    @property
    def torque(self) -> float:
        """Rms motor torque [N m]."""
        return self.motor.torque_constant * self.current

    @property
    def dry(self) -> bool:
        return "coulomb_friction" in self.nominal

    @property
    def coulomb(self) -> float:
        """Dry friction of the nominal structure, or what is usual at this torque where it has none [N m]."""
        return self.nominal.get("coulomb_friction", 0.15 * self.torque)


def always(_: Situation) -> bool:
    return True


@dataclass(frozen=True)
class Effect:
    """`build(values, nominal)` gives the plant parameters to override.

    `scale(values, f)` gives an effect f times as strong, and is None for one without strength. `linear` names
    parameters that may change sign in a fit, `fixed` those that a fit leaves alone. `replaces_coulomb`: holds
    the nominal Coulomb friction in its own parameters. `known_as`: the name that the vocabulary has for what these
    trials conceal as physics without one.
    """

    name: str
    equation: str
    units: Mapping[str, str]
    draw: Draw
    build: Build
    scale: Scale | None
    rivals: tuple[str, ...] = ()
    suits: Callable[[Situation], bool] = always
    limits: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    linear: frozenset[str] = frozenset()
    fixed: frozenset[str] = frozenset()
    replaces_coulomb: bool = False
    slow: bool = False  # shows best at low speed: the bench uses a small voltage
    two_mass: bool = False
    named: bool = True
    known_as: str = ""

    def believable(self, values: Values) -> bool:
        return all(low <= values[name] <= high for name, (low, high) in self.limits.items())


def times(*names: str, power: float = 1.0) -> Scale:
    """A scale that multiplies these parameters by factor ** power."""

    def scale(values: Values, factor: float) -> Values:
        return values | {name: values[name] * factor**power for name in names}

    return scale


def renamed(**targets: str) -> Build:
    """A build that copies parameter to plant parameter: renamed(amplitude="cogging_amplitude")."""

    def build(values: Values, _: Values) -> Values:
        return {plant: values[name] for name, plant in targets.items()}

    return build


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def phase(rng: np.random.Generator) -> float:
    return float(rng.uniform(-np.pi, np.pi))
