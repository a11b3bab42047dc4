"""Per-sample training of the recurrent and the structured network (3.19, 4.19, 4.29)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import Array, as_float_array, read_only
from rwn.networks.rates import RateReport, RateRule, Tightened
from rwn.networks.recurrent_network import RecurrentNetwork
from rwn.networks.structured_network import StructuredNetwork, as_signals, as_start

Network = TypeVar("Network", RecurrentNetwork, StructuredNetwork)


@dataclass(frozen=True, eq=False, kw_only=True)
class OnlineTraining(Generic[Network]):
    """A finished per-sample training.

    status: `completed`, `stalled`, `unstable` (rho(A) >= 1) or `diverged`; `advice` says what to try. Of a
        diverged run `network` is the one before the cycle that diverged.
    mse_learning: (cycles,) mean squared error while learning, a tracking error that may be a million times
        smaller than that of the network.
    mse_frozen: mean squared error with frozen parameters, after `frozen_after` cycles each; the last is
        that of `network`.
    linear: (cycles, 5) v1..v5 at the end of each cycle (structured network; else empty).
    rates: (cycles, groups) at the end of each cycle; bounds: of ||dy/dtheta_g|| behind them, 0 for none.
    report: what was wrong with the bounds on the way.
    """

    network: Network
    status: str
    advice: str
    mse_learning: Array
    mse_frozen: Array
    frozen_after: Array
    linear: Array
    rates: Array
    bounds: Array
    report: RateReport

    @classmethod
    def of(cls, network: Network, theta: Array, history: _core.OnlineHistory) -> OnlineTraining[Network]:
        """From the core's history, for a network of the shape of `network` with parameters theta (n_parameters,)."""
        arrays = {
            name: read_only(np.array(getattr(history, key), dtype=np.float64))
            for name, key in (
                ("mse_learning", "mse_learning"),
                ("mse_frozen", "mse_frozen"),
                ("frozen_after", "frozen_after"),
                ("linear", "parameters"),
                ("rates", "rates"),
                ("bounds", "bounds"),
            )
        }
        return cls(
            network=network.with_theta(theta),
            status=history.status,
            advice=history.advice,
            report=RateReport.of(history.report),
            **arrays,
        )


def train_structured(
    network: StructuredNetwork,
    voltage: ArrayLike,
    speed: ArrayLike,
    *,
    learn: Iterable[str],
    rates: RateRule | None = None,
    cycles: int = 1,
    frozen_every: int = 0,
    follow_state: bool = False,
    start: ArrayLike = (0.0, 0.0),
) -> OnlineTraining[StructuredNetwork]:
    """Trains `network` on voltage (n,) [V] and measured speed (n,) [rad/s], `cycles` times over; each cycle begins at
    the state `start` with sensitivities zero.

    learn: names of the groups that learn, of v1..v5, w, m, d, c.
    rates: the learning-rate rule; None is `rwn.networks.rates.Tightened()`.
    cycles: one that leaves the parameters and the rule as they were, bit for bit, would be repeated by all that
        follow: the histories have those too, but they are not run.
    frozen_every: cycles between evaluations with frozen parameters; 0: before the first and after the last.
    follow_state: after each correction the state moves with its parameters, x += (dx/dtheta) dtheta, so that
        a change acts at once instead of after 1/(1 - rho) samples.
    Raises ValueError for arrays that do not fit, an unknown group, cycles < 1.
    """
    u, y = as_signals(voltage, speed)
    theta, history = _core.train_structured(
        network.core,
        u,
        y,
        as_start(start),
        rates=(rates or Tightened()).core_for(network.groups),
        learn=as_mask(learn, network.groups),
        cycles=cycles,
        frozen_every=frozen_every,
        follow_state=follow_state,
    )
    return OnlineTraining.of(network, theta, history)


def train_recurrent(
    network: RecurrentNetwork,
    x: ArrayLike,
    y: ArrayLike,
    *,
    learn: Iterable[str] = RecurrentNetwork.groups,
    rates: RateRule | None = None,
    cycles: int = 1,
    frozen_every: int = 0,
) -> OnlineTraining[RecurrentNetwork]:
    """Trains `network` on inputs x (n, inputs) and wanted output y (n,), `cycles` times over; each cycle begins with
    phi and V1-V3 zero. `learn` (of b, a, w, m, d, c), `rates` and `frozen_every` as in `train_structured`.
    Raises InputError for arrays of other shapes."""
    theta, history = _core.train_recurrent(
        network.core,
        network.as_inputs(x),
        as_float_array("y", y, 1),
        rates=(rates or Tightened()).core_for(network.groups),
        learn=as_mask(learn, network.groups),
        cycles=cycles,
        frozen_every=frozen_every,
    )
    return OnlineTraining.of(network, theta, history)


def as_mask(learn: Iterable[str], groups: tuple[str, ...]) -> list[bool]:
    """Which of `groups` learn; raises ValueError for a name that is not among them, or none."""
    names = {learn} if isinstance(learn, str) else set(learn)
    unknown = sorted(names - set(groups))
    if unknown or not names:
        raise ValueError(
            f"learn: expected names of {', '.join(groups)}, got {unknown[0] if unknown else 'none'!r}"
        )
    return [group in names for group in groups]
