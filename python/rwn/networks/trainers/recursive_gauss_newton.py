"""Recursive Gauss-Newton on the structured network: the online trainer to take."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import Array, read_only
from rwn.networks.online_training import OnlineTraining, as_mask
from rwn.networks.structured_network import StructuredNetwork, as_signals, as_start


@dataclass(frozen=True, eq=False, kw_only=True)
class RecursiveFit:
    """The training, and the standard deviation of every entry of theta (parameters,); 0 where it was held.

    The deviations are those of one pass over the recording with white noise of the stated size, and prior.
    """

    training: OnlineTraining[StructuredNetwork]
    deviation: Array

    @property
    def network(self) -> StructuredNetwork:
        """The trained network."""
        return self.training.network

_DEFAULTS = _core.structured_trainer_defaults()["recursive-gauss-newton"]


@dataclass(frozen=True, kw_only=True)
class RecursiveGaussNewton:
    """One Gauss-Newton correction per sample, covariance in square-root form (Potter), forgetting.

    noise: standard deviation of the measured speed [rad/s].
    forgetting: weight of the past per sample in the first cycle, in (0, 1]; 0.999 forgets over 1000 samples.
    forgetting_decay: 1 - forgetting is multiplied by this after every cycle, so that the estimates come to rest.
    underweighting: each correction of the first cycle takes out at most 1/(1 + underweighting) of its error, since the
        linearisation cannot be trusted far from the truth; shrinks with `forgetting_decay`.
    cycles: passes over the recording.
    follow_state: the state moves with its parameters, x += (dx/dtheta) dtheta; without it a correction acts
        only after 1/(1 - rho) samples.
    spread: prior standard deviation by group; None is half of each v_i, half the widths for m, d, c, and the
        motor torque's size over sqrt(wavelets) for w.
    frozen_every: cycles between evaluations with frozen parameters; 0: before the first and after the last.
    """

    name: ClassVar[str] = "recursive-gauss-newton"
    noise: float = _DEFAULTS["noise"]
    forgetting: float = _DEFAULTS["forgetting"]
    forgetting_decay: float = _DEFAULTS["forgetting_decay"]
    cycles: int = _DEFAULTS["cycles"]
    underweighting: float = _DEFAULTS["underweighting"]
    follow_state: bool = _DEFAULTS["follow_state"]
    spread: Mapping[str, float] | None = None
    frozen_every: int = _DEFAULTS["frozen_every"]

    def train(
        self,
        network: StructuredNetwork,
        voltage: ArrayLike,
        speed: ArrayLike,
        *,
        learn: Iterable[str],
        start: ArrayLike = (0.0, 0.0),
    ) -> RecursiveFit:
        """Trains the groups `learn` (of v1..v5, w, m, d, c) on voltage (n,) [V] and speed (n,) [rad/s].

        Raises ValueError for arrays that do not fit, an unknown group, or options out of range.
        """
        u, y = as_signals(voltage, speed)
        theta, history, deviation = _core.recursive_gauss_newton(
            network.core,
            u,
            y,
            as_start(start),
            spread=self._spread(network, as_mask(learn, network.groups), u),
            noise=self.noise,
            forgetting=self.forgetting,
            forgetting_decay=self.forgetting_decay,
            underweighting=self.underweighting,
            follow_state=self.follow_state,
            cycles=self.cycles,
            frozen_every=self.frozen_every,
        )
        return RecursiveFit(
            training=OnlineTraining.of(network, theta, history), deviation=read_only(deviation)
        )

    def _spread(self, network: StructuredNetwork, mask: list[bool], voltage: Array) -> Array:
        given = dict(self.spread or {})
        unknown = sorted(set(given) - set(network.groups))
        if unknown:
            raise ValueError(
                f"spread: unknown group {unknown[0]!r}; this network has {', '.join(network.groups)}"
            )
        resistance = network.motor(1.0).resistance
        stall = network.v[2] * np.max(np.abs(voltage)) / resistance  # torque at standstill, Kt V / R [N m]
        widths = np.abs(network.d)
        usual = {f"v{k + 1}": np.array([0.5 * abs(v)]) for k, v in enumerate(network.v)}
        usual["v1"] = np.maximum(usual["v1"], 0.5 * network.v[2] ** 2 / resistance)
        usual["v5"] = np.array([0.5 * abs(1 - network.v[4])])
        usual["w"] = np.full(network.wavelets, stall / np.sqrt(max(network.wavelets, 1)))
        usual |= {"m": 0.5 * widths, "d": 0.5 * widths, "c": 0.1 * widths}
        parts = []
        for group, learns in zip(network.groups, mask, strict=True):
            size = given.get(group)
            values = usual[group] if size is None else np.full_like(usual[group], size)
            parts.append(values if learns else np.zeros_like(values))
        return np.ascontiguousarray(np.concatenate(parts), dtype=np.float64)
