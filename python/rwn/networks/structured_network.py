"""The motor's difference equation with a wavelet network for its friction torque (thesis chapter 4)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import Array, as_float_array, read_only
from rwn.networks.wavelets import Wavelet


@dataclass(frozen=True, kw_only=True)
class MotorParameters:
    """`resistance` [ohm], `inductance` [H], `torque_constant` = back-EMF constant [N m/A], `inertia` [kg m2],
    `viscous_friction` [N m s/rad]."""

    resistance: float
    inductance: float
    torque_constant: float
    inertia: float
    viscous_friction: float


@dataclass(frozen=True, eq=False, kw_only=True)
class StructuredNetwork:
    """x(n) = A x(n-1) + [0; v4] u(n-1) - [v2; 0] tau(n-1), x = [speed, current] (4.6), with the friction
    torque tau = sum_j w_j phi(z_j), z_j = (speed + c_j phi_j(n-1) - m_j) / d_j (4.10) fed with the measured
    speed.

    `v` (5,) is [B, T/J, Kt, T/L, 1 - R T/L]; `w`, `m`, `d`, `c` (wavelets,) each; read-only. `wavelet`: phi. The
    parameters used at sample n are those that hold at sample n.
    Raises ValueError if shapes disagree or a dilation is 0.
    """

    groups: ClassVar[tuple[str, ...]] = ("v1", "v2", "v3", "v4", "v5", "w", "m", "d", "c")
    v: Array
    w: Array
    m: Array
    d: Array
    c: Array
    wavelet: Wavelet = field(default_factory=Wavelet)

    def __post_init__(self) -> None:
        for name in ("v", "w", "m", "d", "c"):
            array = as_float_array(name, getattr(self, name), 1).copy()
            object.__setattr__(self, name, read_only(array))
            expected = 5 if name == "v" else len(self.w)
            if len(array) != expected:
                raise ValueError(
                    f"{name} must have {expected} entries (v: 5; m, d, c as many as w), got {len(array)}"
                )
        if (self.d == 0).any():
            raise ValueError(f"dilation d[{int(np.argmin(np.abs(self.d)))}] is 0; give every wavelet a width")

    @classmethod
    def from_motor(
        cls,
        motor: MotorParameters,
        *,
        sample_time: float,
        w: ArrayLike = (),
        m: ArrayLike = (),
        d: ArrayLike = (),
        c: ArrayLike = (),
        wavelet: Wavelet | None = None,
    ) -> StructuredNetwork:
        """The Euler-forward network (4.5) of a motor at `sample_time` [s]; without w, m, d, c no friction.

        Raises ValueError where a value is not positive.
        """
        t = float(sample_time)
        for name, value in (("sample_time", t), ("inertia", motor.inertia), ("inductance", motor.inductance)):
            if not value > 0:
                raise ValueError(f"{name} must be positive, got {value}")
        v = [
            motor.viscous_friction,
            t / motor.inertia,
            motor.torque_constant,
            t / motor.inductance,
            1 - motor.resistance * t / motor.inductance,
        ]
        shapes = {
            name: np.asarray(a, dtype=np.float64) for name, a in (("w", w), ("m", m), ("d", d), ("c", c))
        }
        return cls(v=np.array(v), wavelet=wavelet or Wavelet(), **shapes)

    def motor(self, sample_time: float) -> MotorParameters:
        """The motor that these v1..v5 stand for at `sample_time` [s]."""
        b, v2, kt, v4, v5 = (float(x) for x in self.v)
        return MotorParameters(
            resistance=(1 - v5) / v4,
            inductance=sample_time / v4,
            torque_constant=kt,
            inertia=sample_time / v2,
            viscous_friction=b,
        )

    @property
    def wavelets(self) -> int:
        """Number of wavelets."""
        return len(self.w)

    @property
    def theta(self) -> Array:
        """All parameters (5 + 4 wavelets,): [v, w, m, d, c]."""
        return np.concatenate([self.v, self.w, self.m, self.d, self.c])

    def with_theta(self, theta: ArrayLike) -> StructuredNetwork:
        """The same network with other parameters theta (5 + 4 wavelets,): [v, w, m, d, c].

        Raises ValueError for a wrong number.
        """
        values = as_float_array("theta", theta, 1)
        if len(values) != 5 + 4 * self.wavelets:
            raise ValueError(
                f"theta must have {5 + 4 * self.wavelets} entries [v, w, m, d, c], got {len(values)}"
            )
        w, m, d, c = values[5:].reshape(4, self.wavelets)
        return replace(self, v=values[:5], w=w, m=m, d=d, c=c)

    @property
    def core(self) -> _core.StructuredNetwork:
        """The same network in the C++ core."""
        return _core.StructuredNetwork(self.theta, self.wavelet.core)

    @property
    def plant(self) -> Array:
        """State matrix A (2, 2) of (4.6)."""
        return self.core.plant

    def simulate(self, voltage: ArrayLike, speed: ArrayLike, *, start: ArrayLike = (0.0, 0.0)) -> Array:
        """Speed (n,) [rad/s] for the voltage (n,) [V], the network fed with the measured `speed` (n,).

        `start` is speed and current at the first sample. Raises ValueError for arrays that do not fit.
        """
        return self.core.simulate(*as_signals(voltage, speed), as_start(start))

    def sensitivities(
        self, voltage: ArrayLike, speed: ArrayLike, *, start: ArrayLike = (0.0, 0.0)
    ) -> tuple[Array, Array]:
        """Speed (n,) [rad/s] as `simulate` has it, with `start`, and its derivative by `theta` (n, 5 + 4 wavelets)
        (4.13-4.28, E), for the voltage (n,) [V] and the measured speed.
        Raises InputError for arrays of other shapes."""
        return self.core.sensitivities(*as_signals(voltage, speed), as_start(start))

    def torque(self, speed: ArrayLike) -> Array:
        """Friction torque (n,) [N m] of the network along a measured speed (n,) [rad/s] (4.10).

        Raises InputError for arrays of other shapes.
        """
        u = as_float_array("speed", speed, 1)
        if (self.c == 0).all():
            return self.wavelet.value((u[:, None] - self.m) / self.d) @ self.w
        phi, out = np.zeros(self.wavelets), np.empty(len(u))
        for n, x in enumerate(u):
            phi = self.wavelet.value((x + self.c * phi - self.m) / self.d)
            out[n] = phi @ self.w
        return out

    def mse(self, voltage: ArrayLike, speed: ArrayLike, *, start: ArrayLike = (0.0, 0.0)) -> float:
        """Mean squared error [rad2/s2] of `simulate` for voltage (n,) [V], speed (n,) [rad/s] and start.

        Raises InputError for arrays of other shapes.
        """
        u, y = as_signals(voltage, speed)
        return float(np.mean((y - self.simulate(u, y, start=start)) ** 2))


def as_signals(voltage: ArrayLike, speed: ArrayLike) -> tuple[Array, Array]:
    """Voltage (n,) [V] and speed (n,) [rad/s] of one recording. Raises ValueError unless n is one and at least 2."""
    u, y = as_float_array("voltage", voltage, 1), as_float_array("speed", speed, 1)
    if len(u) != len(y) or len(y) < 2:
        raise ValueError(
            f"voltage and speed must be of one length, at least 2 samples; got {len(u)} and {len(y)}"
        )
    return u, y


def as_start(start: ArrayLike) -> Array:
    """State (2,) at the first sample: speed [rad/s], current [A]. Raises ValueError for another shape."""
    state = as_float_array("start", start, 1)
    if len(state) != 2:
        raise ValueError(f"start must be [speed, current], got {len(state)} entries")
    return state
