"""Start of the structured network by selection: orthogonal least squares over a wavelet library, seen through
the motor (after Oussar & Dreyfus 2000)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from rwn.networks.arrays import Array
from rwn.networks.online_training import as_mask
from rwn.networks.structured_network import StructuredNetwork, as_signals
from rwn.networks.wavelets import Wavelet


@dataclass(frozen=True, kw_only=True)
class StructuredSelection:
    """Takes one wavelet after the other, each time the one whose effect on the simulated speed explains most
    of what the linear parameters and the wavelets already taken cannot.

    levels: scales of the library; level l has 2^(l+1) + 1 wavelets over the range of the speed, of dilation
        zeta (high - low) / 2^l.
    noise: standard deviation of the measured speed [rad/s]; no wavelet is taken that lowers the squared error by
        less than log(n) noise^2 (Schwarz 1978). 0 takes as many as were asked for.
    Deterministic. Nothing but the recording and the (wrong) motor is used.
    """

    name: ClassVar[str] = "structured-selection"
    levels: int = 6
    zeta: float = 0.5
    noise: float = 0.0

    def start(
        self,
        motor: StructuredNetwork,
        voltage: ArrayLike,
        speed: ArrayLike,
        *,
        wavelets: int,
        linear: tuple[str, ...] = (),
        network_speed: ArrayLike | None = None,
        wavelet: Wavelet | None = None,
    ) -> StructuredNetwork:
        """The `motor` (its v1..v5) with `wavelets` wavelets (at most, if there is noise), w = 0 and c = 0, for
        voltage (n,) [V] and measured speed (n,) [rad/s]. `linear` names those of v1..v5 that will learn too;
        `network_speed` (n,) feeds the network, None is the measured one.

        Raises ValueError for arrays that do not fit, or a library with too few independent wavelets.
        """
        u, y = as_signals(voltage, speed)
        fed = y if network_speed is None else as_signals(voltage, network_speed)[1]
        kind = wavelet or Wavelet()
        m, d = self.library(float(fed.min()), float(fed.max()))
        all_of_them = StructuredNetwork(v=motor.v, w=0 * m, m=m, d=d, c=0 * m, wavelet=kind)
        simulated, jacobian = all_of_them.sensitivities(u, fed)
        learning = as_mask(linear, StructuredNetwork.groups[:5]) if linear else [False] * 5
        known = jacobian[:, :5][:, learning]
        chosen = select(jacobian[:, 5 : 5 + len(m)], y - simulated, known, wavelets, self.noise)
        if len(chosen) < wavelets and self.noise == 0:
            raise ValueError(
                f"only {len(chosen)} of {wavelets} wavelets are independent on this recording: "
                "take fewer wavelets or more levels"
            )
        kept = np.array(chosen, dtype=np.intp)
        return StructuredNetwork(
            v=motor.v, w=0 * m[kept], m=m[kept], d=d[kept], c=0 * m[kept], wavelet=kind
        )

    def library(self, low: float, high: float) -> tuple[Array, Array]:
        """Translations and dilations (wavelets,) of all wavelets over the speeds from `low` to `high`."""
        counts = [2 ** (level + 1) + 1 for level in range(self.levels)]
        m = np.concatenate([np.linspace(low, high, count) for count in counts])
        d = np.repeat([self.zeta * (high - low) / 2**level for level in range(self.levels)], counts)
        return m, d


def select(columns: Array, wanted: Array, known: Array, count: int, noise: float = 0.0) -> list[int]:
    """Indices of up to `count` columns (n, k) that explain most of `wanted` (n,) beside `known` (n, p), by
    modified Gram-Schmidt; columns that lie in the span of those taken are left out, and those that explain no
    more than `noise` would."""
    basis = np.linalg.qr(known)[0]
    left = wanted - basis @ (basis.T @ wanted)
    rest = columns - basis @ (basis.T @ columns)
    least = 1e-9 * np.einsum("ij,ij->j", columns, columns)
    chosen: list[int] = []
    while len(chosen) < count:
        norms = np.einsum("ij,ij->j", rest, rest)
        usable = norms > least
        usable[chosen] = False
        if not usable.any():
            break
        gains = np.where(usable, (rest.T @ left) ** 2 / np.where(usable, norms, 1.0), -1.0)
        best = int(np.argmax(gains))
        if gains[best] <= np.log(len(wanted)) * noise**2:
            break
        chosen.append(best)
        direction = rest[:, best] / np.sqrt(norms[best])
        left = left - direction * (direction @ left)
        rest = rest - np.outer(direction, direction @ rest)
    return chosen
