"""A motor with dry friction as one would write it by hand: what `hand_fit` fits with scipy, with nothing of rwn in it.

    dw/dt = gain (u - |u| w / coasting) - (damping + uneven sign w) w + offset - dry sign w
            + sum over m of (cos_m cos m q + sin_m sin m q)

`u` is the input late by `delay`; what is left out is zero. Between rows the linear part is solved exactly, and
friction takes away of the speed what it can: it stops the shaft, and never turns it back.
`coasting`: a bridge that conducts during its pulses only, so that the back-EMF brakes by the duty. Where it is left
out, the back-EMF is in the damping.
`lag`: the speed goes through a first-order filter before it is measured.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Parameters = Mapping[str, Array]  # (k,) each: k motors at once, as a Jacobian by differences asks for


@dataclass(frozen=True, kw_only=True)
class Drive:
    """An input held from row to row, and how the shaft stood at the first; arrays (n,)."""

    time: Array
    given: Array
    speed: float = 0.0
    angle: float = 0.0


def slide(p: Parameters, drive: Drive) -> dict[str, Array]:
    """Speed and position (n, k) of k motors under one input."""
    count, steps = next(iter(p.values())).size, np.diff(drive.time)[:, None]
    given = _reaching(p, drive, count)
    brake = p["damping"] + (p["gain"] * np.abs(given) / p["coasting"] if "coasting" in p else 0.0)
    kept = np.exp(-brake * steps)
    grown = -np.expm1(-brake * steps) / brake
    pushed = grown * (p["gain"] * given + p.get("offset", 0.0))
    stopped = grown * p.get("dry", np.zeros(count))
    uneven, waves = p.get("uneven"), _waves(p)
    speed, angle = np.full(count, drive.speed), np.full(count, drive.angle)
    speeds, angles = np.empty((drive.time.size, count)), np.empty((drive.time.size, count))
    speeds[0], angles[0] = speed, angle
    for k in range(steps.size):
        free = kept[k] * speed + pushed[k]
        if uneven is not None:
            free -= grown[k] * uneven * np.abs(speed)
        for order, cosine, sine in waves:
            free += grown[k] * (cosine * np.cos(order * angle) + sine * np.sin(order * angle))
        after = np.sign(free) * np.maximum(np.abs(free) - stopped[k], 0.0)
        angle = angle + 0.5 * steps[k] * (speed + after)
        speed = after
        speeds[k + 1], angles[k + 1] = speed, angle
    return {"speed": _lagging(p, speeds, steps), "position": angles}


def _reaching(p: Parameters, drive: Drive, count: int) -> Array:
    """The input (n - 1, k) that acts between rows, which are late by the delay: its mean there."""
    total = np.concatenate([[0.0], np.cumsum(drive.given[:-1] * np.diff(drive.time))])
    late = drive.time[:, None] - p.get("delay", np.zeros(count))
    before = np.minimum(late - drive.time[0], 0.0) * drive.given[0]
    mean = np.diff(np.interp(late, drive.time, total) + before, axis=0) / np.diff(drive.time)[:, None]
    out: Array = mean
    return out


def _waves(p: Parameters) -> list[tuple[int, Array, Array]]:
    orders = [int(name[3:]) for name in p if name.startswith("cos")]
    return [(m, p[f"cos{m}"], p[f"sin{m}"]) for m in orders]


def _lagging(p: Parameters, speeds: Array, steps: Array) -> Array:
    if "lag" not in p:
        return speeds
    shown, kept = speeds.copy(), np.exp(-steps / np.maximum(p["lag"], 1e-9))
    for k in range(steps.size):
        shown[k + 1] = kept[k] * shown[k] + (1.0 - kept[k]) * speeds[k + 1]
    return shown
