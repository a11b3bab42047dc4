"""The proof: free-run error on recordings that were not used for fitting."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.preparation import motion, noise_levels
from rwn.fit.problem import OutputError, Target
from rwn.fit.residuals import correlation_time
from rwn.report.diagnosis import HeldoutRow
from rwn.simulate.inverse_dynamics import force_error

Array = NDArray[np.float64]
RAN_AWAY = 1e100  # error of a simulation that diverged


@dataclass(frozen=True, kw_only=True)
class Contender:
    """A parameter vector with the effects that are switched on."""

    vector: Array
    active: tuple[int, ...]


def heldout_rows(
    problem: OutputError,
    targets: Sequence[Target],
    nominal: Contender,
    refitted: Contender,
    corrected: Contender | None,
    *,
    units: dict[str, str],
    seed: int,
    first: int = 0,
) -> tuple[HeldoutRow, ...]:
    """Rms free-run error of each recorded signal, whole and at low speed; block-bootstrap interval on the gain.

    Samples before `first` are simulated but not judged: they were fitted.
    """
    rows = []
    for target in targets:
        runs = [_errors(problem, target, c) for c in (nominal, refitted, corrected) if c is not None]
        begin = max(first, target.judged_from)
        late = np.arange(target.time.size) >= begin
        slow = _slow(target) & late
        best = runs[-1]
        floor = noise_levels([target], [best])
        for signal in target.recorded:
            for region, chosen in (("all", late), ("low speed", slow)):
                if chosen.sum() < 20:
                    continue
                parts = [run[signal][chosen] for run in runs]
                rows.append(
                    _row(target, region, signal, units, parts, floor[signal], corrected is not None, seed)
                )
        if problem.kind == "axis" and first == 0:
            rows += _force_row(
                problem, target, [c for c in (nominal, refitted, corrected) if c is not None], seed
            )
    return tuple(rows)


def _force_row(
    problem: OutputError, target: Target, contenders: list[Contender], seed: int
) -> list[HeldoutRow]:
    """Error of the inverse dynamics relative to the driving force, in percent of its norm."""
    parts = [force_error(problem, target, c.vector, list(c.active)) for c in contenders]
    errors, force = [e for e, _ in parts], parts[0][1]
    if not force.size:
        return []
    percent = [100.0 * float(np.linalg.norm(e) / np.linalg.norm(force)) for e in errors]
    found = len(percent) == 3
    return [
        HeldoutRow(
            recording=target.name, region="all", signal="driving force", unit="%", samples=force.size,
            nominal=percent[0], refitted=percent[1], corrected=percent[2] if found else None, noise_floor=None,
            gain=1.0 - percent[2] / percent[1] if found else None,
            gain_interval=gain_interval(errors[1], errors[2], seed=seed) if found else None,
        )
    ]  # fmt: skip


def _errors(problem: OutputError, target: Target, contender: Contender) -> dict[str, Array]:
    alone = replace(problem, targets=(replace(target, angle=np.empty(0)),))
    found = alone.residuals(contender.vector, contender.active)[0]
    # a run that left for infinity is cut at a finite number, so that it can be squared
    return {signal: np.clip(error, -RAN_AWAY, RAN_AWAY) for signal, error in found.items()}


def _slow(target: Target) -> NDArray[np.bool_]:
    speed = np.abs(motion(target)[0])
    result: NDArray[np.bool_] = speed < 0.1 * np.percentile(speed, 99.5)
    return result


def _row(
    target: Target,
    region: str,
    signal: str,
    units: dict[str, str],
    parts: list[Array],
    floor: float,
    found: bool,
    seed: int,
) -> HeldoutRow:
    rms = [_rms(p) for p in parts]
    gain = 1.0 - rms[2] / rms[1] if found else None
    return HeldoutRow(
        recording=target.name,
        region=region,
        signal=signal,
        unit=units[signal],
        samples=parts[0].size,
        nominal=rms[0],
        refitted=rms[1],
        corrected=rms[2] if found else None,
        noise_floor=floor,
        gain=gain,
        gain_interval=gain_interval(parts[1], parts[2], seed=seed) if found else None,
    )


def _rms(x: Array) -> float:
    return float(np.sqrt(np.nanmean(x**2))) if np.nanmax(np.abs(x)) < RAN_AWAY else float("inf")


def gain_interval(before: Array, after: Array, *, seed: int, draws: int = 400) -> tuple[float, float]:
    """95 % interval of 1 - rms(after)/rms(before) by circular block bootstrap.

    Blocks of twice the correlation time of the longer-lived squared error (after Politis, White 2004).
    """
    n = before.size
    if max(np.nanmax(np.abs(before)), np.nanmax(np.abs(after))) >= RAN_AWAY:
        return -np.inf, -np.inf
    length = int(np.clip(2.0 * max(correlation_time(before), correlation_time(after)), 1, max(1, n // 4)))
    rng = np.random.default_rng(seed)
    sums = np.stack([_block_sums(before**2, length), _block_sums(after**2, length)])
    picks = rng.integers(0, n, size=(draws, max(1, n // length)))
    totals = sums[:, picks].sum(axis=2)
    gains = 1.0 - np.sqrt(totals[1] / np.maximum(totals[0], 1e-300))
    low, high = np.percentile(gains, [2.5, 97.5])
    return float(low), float(high)


def _block_sums(x: Array, length: int) -> Array:
    """Sum over the circular block that begins at each sample."""
    sums = np.concatenate([[0.0], np.cumsum(np.concatenate([x, x[:length]]))])
    found: Array = sums[length : length + x.size] - sums[: x.size]
    return found
