"""The regions where the mismatch's energy sits: over speed, acceleration, current, angle, direction and time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.simulate.unknown_inputs import UnknownInputs

Array = NDArray[np.float64]


INSTANTS = "single instants"
FEW, MOST = 0.01, 0.5  # share of the samples, and of the energy in them, of a mismatch of single instants
NO_STEP = 1e-9  # of the largest value: two that lie as near are one, but for rounding


@dataclass(frozen=True, kw_only=True)
class Region:
    """The samples with `low <= coordinate < high`; their share of the residual energy and of the samples."""

    coordinate: str  # "speed", "angle", "current", "direction", "acceleration", "time"
    low: float
    high: float
    unit: str
    share: float
    samples_share: float
    name: str = ""  # "low speed", "reversals"


def regions(inputs: Sequence[UnknownInputs], *, linear: bool = False) -> tuple[Region, ...]:
    """For each coordinate the stretch that holds most of the mismatch's energy for its share of samples, best first."""
    joined = {
        name: np.concatenate([getattr(u, name) for u in inputs])
        for name in ("speed", "acceleration", "current", "angle", "time")
    }
    energy = np.concatenate([u.mismatch for u in inputs]) ** 2
    at_instants = _instants(joined["time"], energy)
    energy = np.minimum(energy, np.percentile(energy, 99.9))
    speed = joined["speed"]
    length = "m" if linear else "rad"
    peak = float(np.percentile(np.abs(speed), 99.5)) or 1.0
    found = [
        _stretch("speed", np.abs(speed), energy, f"{length}/s"),
        _stretch("acceleration", np.abs(joined["acceleration"]), energy, f"{length}/s^2"),
        _stretch("time", joined["time"], energy, "s"),
        _stretch("direction", np.sign(np.where(np.abs(speed) < 0.01 * peak, 0.0, speed)), energy, ""),
        _reversals(speed, energy, f"{length}/s"),
        at_instants,
    ]
    if np.any(joined["current"]):
        found.append(_stretch("current", np.abs(joined["current"]), energy, "A"))
    if np.ptp(joined["angle"]) > 2.0 * np.pi:
        found.append(_stretch("angle", np.mod(joined["angle"], 2.0 * np.pi), energy, "rad"))
    kept = [r for r in found if r is not None and r.samples_share > 0.0]
    return tuple(sorted(kept, key=lambda r: -(r.share - r.samples_share)))


def _instants(time: Array, energy: Array) -> Region | None:
    """The few samples that hold most of the energy, where there are such: of noise they hold a tenth."""
    count = max(1, int(FEW * energy.size))
    these = np.argpartition(energy, -count)[-count:]
    share = float(energy[these].sum() / (energy.sum() or 1.0))
    if share < MOST:
        return None
    return Region(
        coordinate="time", low=float(time[these].min()), high=float(time[these].max()), unit="s", name=INSTANTS,
        share=share, samples_share=count / energy.size,
    )  # fmt: skip


def _stretch(name: str, x: Array, energy: Array, unit: str, bins: int = 12) -> Region | None:
    """The run of quantile bins with the largest excess of energy share over sample share."""
    edges = np.unique(np.quantile(x, np.linspace(0.0, 1.0, bins + 1)))
    edges = edges[np.diff(edges, prepend=-np.inf) > NO_STEP * np.max(np.abs(edges))]
    if edges.size < 3:
        return None
    place = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, edges.size - 2)
    total = float(energy.sum()) or 1.0
    share = np.bincount(place, energy, edges.size - 1) / total
    samples = np.bincount(place, minlength=edges.size - 1) / x.size
    excess = np.concatenate([[0.0], np.cumsum(share - samples)])
    i, j = np.triu_indices(edges.size, 1)
    best = int(np.argmax(excess[j] - excess[i]))
    a, b = int(i[best]), int(j[best])
    word = (f"low {name}", f"high {name}") if name in ("speed", "current", "acceleration") else ("", "")
    label = word[0] if a == 0 else word[1] if b == edges.size - 1 else ""
    return Region(
        coordinate=name,
        low=float(edges[a]),
        high=float(edges[b]),
        unit=unit,
        share=float(share[a:b].sum()),
        samples_share=float(samples[a:b].sum()),
        name=label,
    )


def _reversals(speed: Array, energy: Array, unit: str) -> Region | None:
    """The samples around changes of direction."""
    turns = np.nonzero(np.diff(np.sign(speed)) != 0)[0]
    if not turns.size or turns.size > speed.size / 20:
        return None
    near = np.zeros(speed.size, dtype=bool)
    reach = max(2, int(0.1 * speed.size / turns.size / 2))
    for k in turns:
        near[max(0, k - reach) : k + reach] = True
    limit = float(np.percentile(np.abs(speed[near]), 95))
    return Region(
        coordinate="speed", low=-limit, high=limit, unit=unit, name="reversals",
        share=float(energy[near].sum() / (energy.sum() or 1.0)), samples_share=float(near.mean()),
    )  # fmt: skip
