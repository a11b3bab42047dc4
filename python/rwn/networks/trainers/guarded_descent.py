"""Gradient descent with adaptive rates that cannot diverge: every cycle is proved before it is kept."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from rwn.networks.arrays import Array, read_only
from rwn.networks.online_training import train_structured
from rwn.networks.rates import ImpulseResponse, Normalised, Thesis
from rwn.networks.structured_network import StructuredNetwork, as_signals

ADVICE = {
    "converged": "No fraction of the rates lowers the error any more: a minimum was reached to rounding.",
    "completed": "Every cycle was run while the error still fell: allow more cycles.",
}


@dataclass(frozen=True, eq=False, kw_only=True)
class GuardedTraining:
    """A finished guarded training.

    status: `converged` or `completed`; `advice` says what to try.
    mse: (cycles + 1,) with frozen parameters, before the first and after every cycle; never rises.
    linear: (cycles + 1, 5) v1..v5.  fraction: (cycles,) of the rates in each cycle.  kept: (cycles,) whether
        the cycle lowered the error and was kept.
    """

    network: StructuredNetwork
    status: str
    advice: str
    mse: Array
    linear: Array
    fraction: Array
    kept: tuple[bool, ...]


@dataclass(frozen=True, kw_only=True)
class GuardedDescent:
    """Per-sample training, one cycle at a time: the rates are made anew from the parameters as they stand; a
    cycle that does not lower the error with frozen parameters is undone and the fraction cut.

    What it guarantees, from any start with a stable plant and for any rule: the frozen error never rises, so
    it cannot diverge. That it reaches the minimum is measured, not proved: it does from every start of Tables
    17 and 18 and from 50 % off.

    rates: the rule whose `fraction` is steered; with ImpulseResponse(fraction=None) the first one is
        (1 - rho)/4.
    grow, cut: factor of the fraction after a cycle that was kept, and after one that was not.
    cycles: passes over the recording, kept or not.
    follow_state: as in `train_structured`.

    Raises ValueError for options outside their range.
    """

    name: ClassVar[str] = "guarded-descent"
    rates: ImpulseResponse | Normalised | Thesis = field(default_factory=ImpulseResponse)
    grow: float = 2.0
    cut: float = 0.25
    cycles: int = 50
    follow_state: bool = False

    def __post_init__(self) -> None:
        if not (self.grow >= 1 and 0 < self.cut < 1 and self.cycles >= 1):
            raise ValueError(
                f"expected grow >= 1, 0 < cut < 1 and cycles >= 1, got {self.grow}, {self.cut}, {self.cycles}"
            )

    def train(
        self,
        network: StructuredNetwork,
        voltage: ArrayLike,
        speed: ArrayLike,
        *,
        learn: Iterable[str],
        start: ArrayLike = (0.0, 0.0),
    ) -> GuardedTraining:
        """Trains the groups `learn` (of v1..v5, w, m, d, c) on voltage (n,) [V] and speed (n,) [rad/s].

        Raises ValueError for arrays that do not fit, an unknown group, or an unstable start.
        """
        u, y = as_signals(voltage, speed)
        groups, fraction, mse = tuple(learn), self._first(network), [network.mse(u, y, start=start)]
        linear = [network.v]
        fractions: list[float] = []
        kept: list[bool] = []
        while len(kept) < self.cycles and fraction > 1e-12:
            run = train_structured(
                network,
                u,
                y,
                learn=groups,
                rates=replace(self.rates, fraction=fraction),
                follow_state=self.follow_state,
                start=start,
            )
            better = run.status in ("completed", "stalled") and bool(run.mse_frozen[-1] < mse[-1])
            fractions.append(fraction)
            kept.append(better)
            network = run.network if better else network
            mse.append(float(run.mse_frozen[-1]) if better else mse[-1])
            linear.append(network.v)
            fraction *= self.grow if better else self.cut
        status = "completed" if fraction > 1e-12 else "converged"
        return GuardedTraining(
            network=network,
            status=status,
            advice=ADVICE[status],
            mse=read_only(np.array(mse)),
            linear=read_only(np.array(linear)),
            fraction=read_only(np.array(fractions)),
            kept=tuple(kept),
        )

    def _first(self, network: StructuredNetwork) -> float:
        radius = float(np.max(np.abs(np.linalg.eigvals(network.plant))))
        if radius >= 1:
            raise ValueError(
                f"network: its plant has spectral radius {radius:.6g} >= 1; start from a stable one"
            )
        given = self.rates.fraction
        return (1 - radius) / 4 if given is None else given
