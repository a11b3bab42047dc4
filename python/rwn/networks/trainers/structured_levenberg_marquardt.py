"""Batch Levenberg-Marquardt on the structured network, its wavelets orthogonal to the linear physics."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import Array, as_float_array, read_only
from rwn.networks.online_training import as_mask
from rwn.networks.structured_network import StructuredNetwork, as_signals, as_start


@dataclass(frozen=True, eq=False, kw_only=True)
class StructuredFit:
    """A fitted structured network.

    network: the parameters; with the gauge its friction is `friction`, not `network.torque` alone.
    slope: viscous slope of the network's torque [N m s/rad] that the gauge takes out; 0 without it.
    status: `converged`, `iteration-limit` or `stuck`; `advice` says what to try.
    mse: (iterations + 1,) [rad2/s2].
    deviation: standard deviation of every entry of theta for white residuals; 0 where it was held.
    condition: of the column-scaled Jacobian; large means that parameters are not determined.
    """

    network: StructuredNetwork
    slope: float
    status: str
    advice: str
    mse: Array
    deviation: Array
    condition: float

    def friction(self, speed: ArrayLike) -> Array:
        """Whole friction torque (n,) [N m], viscous part included, along a speed (n,) [rad/s].

        Raises InputError for arrays of other shapes.
        """
        u = as_float_array("speed", speed, 1)
        slope = float(self.network.v[0]) - self.slope
        return np.asarray(self.network.torque(u) + slope * u, dtype=np.float64)

    def free_run(self, voltage: ArrayLike, *, start: ArrayLike = (0.0, 0.0)) -> Array:
        """Speed (n,) for the voltage (n,), the network fed with the speed that it simulates (c must be 0).

        Raises InputError for arrays of other shapes.
        """
        u = as_float_array("voltage", voltage, 1)
        return _core.simulate_fed_back(self.network.core, self.slope, u, as_start(start))

    def simulate(self, voltage: ArrayLike, speed: ArrayLike, *, start: ArrayLike = (0.0, 0.0)) -> Array:
        """Speed (n,) for the voltage (n,), the network fed with the measured `speed` (n,).

        Raises InputError for arrays of other shapes.
        """
        u, y = as_signals(voltage, speed)
        torque = self.network.torque(y) - self.slope * y
        return _core.simulate_plant(self.network.core, u, torque, as_start(start))

_DEFAULTS = _core.structured_trainer_defaults()["structured-levenberg-marquardt"]


@dataclass(frozen=True, kw_only=True)
class StructuredLevenbergMarquardt:
    """Levenberg-Marquardt with unit columns; each accepted step lowers the whole squared error.

    iterations: most accepted steps.
    damping: first damping, relative to the scaled J^T J.
    tolerance: relative fall of the squared error below which it has converged.
    gauge: tau_perp = tau - <tau, speed>/<speed, speed> speed replaces the network's torque, so that v1 is the
        whole viscous slope. Without it v1 and the network share the slope: v1 - B is an observer gain.
    weights_first: finds w by least squares before the first step (the output is linear in w).
    ridge: noise deviation of the speed [rad/s] over the size expected of every w [N m]: a prior around zero, which
        keeps wavelets narrower than the noise from swinging; 0 for none.
    """

    name: ClassVar[str] = "structured-levenberg-marquardt"
    iterations: int = _DEFAULTS["iterations"]
    damping: float = _DEFAULTS["damping"]
    tolerance: float = _DEFAULTS["tolerance"]
    gauge: bool = _DEFAULTS["gauge"]
    weights_first: bool = _DEFAULTS["weights_first"]
    ridge: float = _DEFAULTS["ridge"]

    def fit(
        self,
        network: StructuredNetwork,
        voltage: ArrayLike,
        speed: ArrayLike,
        *,
        learn: Iterable[str],
        start: ArrayLike = (0.0, 0.0),
        network_speed: ArrayLike | None = None,
        feed: Literal["measured", "simulated"] = "measured",
        current: ArrayLike | None = None,
        current_weight: float = 1.0,
    ) -> StructuredFit:
        """Fits the groups `learn` (of v1..v5, w, m, d, c) to voltage (n,) [V] and speed (n,) [rad/s].

        network_speed: (n,) speed that feeds the network; None is the measured one, whose noise biases.
        feed: `simulated` feeds the network with the speed that the model itself simulates (output error), which
            takes that bias away; `network_speed` is then only what the gauge weighs speeds by. Needs c = 0.
        current: (n,) measured current [A], fitted too; `current_weight` is the deviation of the speed's noise
            over that of the current's.
        Raises ValueError for arrays that do not fit, an unknown group, or an unstable start.
        """
        u, y = as_signals(voltage, speed)
        sizes = [1] * 5 + [network.wavelets] * 4
        fit = _core.structured_levenberg_marquardt(
            network.core,
            u,
            y,
            as_start(start),
            network_speed=y if network_speed is None else as_float_array("network_speed", network_speed, 1),
            feed=feed,
            current=np.empty(0) if current is None else as_float_array("current", current, 1),
            current_weight=current_weight,
            learn=np.repeat(as_mask(learn, network.groups), sizes).tolist(),
            iterations=self.iterations,
            damping=self.damping,
            tolerance=self.tolerance,
            gauge=self.gauge,
            weights_first=self.weights_first,
            ridge=self.ridge,
        )
        return StructuredFit(
            network=network.with_theta(fit.theta),
            slope=fit.slope,
            status=fit.status,
            advice=fit.advice,
            mse=read_only(np.array(fit.mse)),
            deviation=read_only(fit.deviation),
            condition=fit.condition,
        )
