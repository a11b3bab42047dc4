"""Training of several structured networks at once, one per lane of the processor's vectors (4.19, 4.29)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import Array, read_only
from rwn.networks.rates import Fixed
from rwn.networks.structured_network import StructuredNetwork, as_signals, as_start


@dataclass(frozen=True, eq=False, kw_only=True)
class SideBySide:
    """Finished trainings of N networks on one recording, in the order they were given.

    networks: the trained ones; of a diverged run the one before the cycle that diverged.
    status: of each, as `train_structured` says it: `completed`, `stalled`, `unstable` or `diverged`; `advice`
        says what to try.
    mse_learning: (N,) mean squared error while learning, of the last cycle that did not diverge; infinite
        where the first did [rad2/s2].
    mse_frozen: (N,) mean squared error of `networks` with frozen parameters [rad2/s2].
    """

    networks: tuple[StructuredNetwork, ...]
    status: tuple[str, ...]
    advice: tuple[str, ...]
    mse_learning: Array
    mse_frozen: Array

    @property
    def best(self) -> StructuredNetwork:
        """The network with the least frozen error."""
        return self.networks[int(np.argmin(self.mse_frozen))]


def train_side_by_side(
    networks: Sequence[StructuredNetwork],
    voltage: ArrayLike,
    speed: ArrayLike,
    *,
    rates: Fixed | Sequence[Fixed],
    cycles: int = 1,
    start: ArrayLike = (0.0, 0.0),
) -> SideBySide:
    """Trains every network on voltage (n,) [V] and measured speed (n,) [rad/s], `cycles` times over, as
    `train_structured` would one by one, to rounding.

    networks: of one size and one wavelet; their starts (seeds) differ.
    rates: one rule for all, or one for each; a group without a rate does not learn.
    start: speed [rad/s] and current [A] at the first sample of each cycle, (2,).
    Raises ValueError for networks that are not alike, arrays that do not fit, cycles < 1.
    """
    u, y = as_signals(voltage, speed)
    theta = _stacked(networks)
    first = networks[0]
    trained = _core.train_side_by_side(
        theta, first.wavelet.core, _rates(rates, len(networks)), u, y, as_start(start), cycles=cycles
    )
    return SideBySide(
        networks=tuple(first.with_theta(row) for row in trained.theta),
        status=tuple(trained.status),
        advice=tuple(trained.advice),
        mse_learning=read_only(np.array(trained.mse_learning)),
        mse_frozen=read_only(np.array(trained.mse_frozen)),
    )


def _stacked(networks: Sequence[StructuredNetwork]) -> Array:
    """theta (N, 5 + 4 wavelets)."""
    if not networks:
        raise ValueError("networks: at least one is needed")
    first = networks[0]
    for number, network in enumerate(networks):
        if (network.wavelets, network.wavelet) != (first.wavelets, first.wavelet):
            raise ValueError(
                f"networks[{number}] has {network.wavelets} wavelets {network.wavelet.name}, the first "
                f"{first.wavelets} {first.wavelet.name}; train networks of one shape together"
            )
    return np.array([network.theta for network in networks])


def _rates(rates: Fixed | Sequence[Fixed], count: int) -> Array:
    """Rates (N, 9)."""
    rules = [rates] * count if isinstance(rates, Fixed) else list(rates)
    if len(rules) != count:
        raise ValueError(f"rates: expected one rule, or one for each of {count} networks, got {len(rules)}")
    return np.array([rule.values(StructuredNetwork.groups) for rule in rules])
