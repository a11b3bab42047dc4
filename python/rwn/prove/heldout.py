"""The proof: free-run error on recordings that were not used for fitting."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from rwn.fit.hypothesis import Hypothesis
from rwn.fit.intervals import HALF_WIDTH
from rwn.fit.problem import Problem
from rwn.fit.residual_noise import noise_of
from rwn.fit.residuals import correlation_time
from rwn.recording.signals import DRIVING_FORCE
from rwn.simulate.inverse_dynamics import force_error
from rwn.simulate.run import Run
from rwn.simulate.simulator import RAN_AWAY

Array = NDArray[np.float64]
FEWEST = 20  # samples that a row judges
DRAWS = 400  # of the bootstrap
WORTH = 0.9  # squared error with what stands in for an unknown law, above which it is not worth a file
NOISE_FLOOR = (
    "standard deviation of the signal's measurement noise, in unit: what second differences of the corrected (else the "
    "refitted) model's error over the whole recording leave, at most that error's rms, and so equal to it where "
    "nothing but noise is left; at least the step that the values are rounded to, and of encoder counts that step; "
    "null for a driving force, which is not measured"
)
GAIN = "1 - corrected / refitted; null: nothing was added, one of them ran away, or there was no error to remove"

SIMULATED = "error as rwn simulate has it, where the others have numbers that were fitted to this recording; else null"


@dataclass(frozen=True, kw_only=True)
class HeldoutRow:
    """Free-run rms error on a recording not used for fitting; `gain` = 1 - corrected / refitted."""

    recording: str
    region: str  # "all", or the name of a region
    signal: str
    unit: str
    samples: Annotated[int, Meta(description="that were judged: measured, of this region, not fitted")]
    nominal: Annotated[float, Meta(description="rms free-run error of the model as given, in unit; inf: it ran away")]
    refitted: Annotated[float, Meta(description="the same of the nominal model with its parameters refitted")]
    corrected: Annotated[float | None, Meta(description="the same of the corrected model; null: nothing was added")]
    noise_floor: Annotated[float | None, Meta(description=NOISE_FLOOR)]
    gain: Annotated[float | None, Meta(description=GAIN)] = None
    gain_interval: Annotated[tuple[float, float] | None, Meta(description="95 %, block bootstrap")] = None
    simulated: Annotated[float | None, Meta(description=SIMULATED)] = None

    @property
    def certain_gain(self) -> tuple[float, float]:
        """Bounds of the gain, also where no share can say it: next to an error of 0 or one that ran away."""
        if self.gain_interval is not None:
            return self.gain_interval
        if self.corrected is None or self.corrected == self.refitted:
            return 0.0, 0.0
        return (1.0, 1.0) if self.corrected < self.refitted else (-np.inf, -np.inf)

    @property
    def gain_and_an_error(self) -> float:
        """The gain and one standard error of it."""
        low, high = self.certain_gain
        return high if self.gain is None else self.gain + (high - low) / (2.0 * HALF_WIDTH)

    @property
    def left(self) -> float:
        """The error that stays."""
        return self.refitted if self.corrected is None else self.corrected


def heldout_rows(
    problem: Problem,
    runs: Sequence[Run],
    nominal: Hypothesis,
    refitted: Hypothesis,
    corrected: Hypothesis | None,
    *,
    units: Mapping[str, str],
    seed: int,
    first: int = 0,
) -> tuple[HeldoutRow, ...]:
    """Rms free-run error of each recorded signal, whole and at low speed; block-bootstrap interval on the gain.

    The hypotheses are simulated at their own values. Samples before `first` are simulated but not judged: they were
    fitted.
    """
    compared = [h for h in (nominal, refitted, corrected) if h is not None]
    rows = []
    for run in runs:
        # the model as given knows no levels of single recordings, as `rwn simulate` does not
        given = errors_alone(without_levels(problem), replace(run, levels=(), own_levels=()), nominal)
        errors = [given, *(errors_alone(problem, run, h) for h in compared[1:])]
        begin = max(first, run.judged_from)
        late = np.arange(run.time.size) >= begin
        slow = _slow(run) & late
        floor = _floor(problem, run, errors[-1])
        for signal in run.recorded:
            for region, chosen in (("all", late), ("low speed", slow)):
                judged = chosen & ~run.not_compared(signal)  # the error of what was not measured is no zero
                if judged.sum() < FEWEST:
                    continue
                parts = [error[signal][judged] for error in errors]
                rows.append(_row(run, region, signal, units, parts, floor[signal], corrected is not None, seed))
        if problem.drive.force and first == 0:
            rows += _force_row(problem, run, compared, seed)
    return tuple(rows)


def _floor(problem: Problem, run: Run, errors: Mapping[str, Array]) -> dict[str, float]:
    """The noise of each signal; of noise that lasts, or that an input leaves, all of it, not what is new in a row."""
    floor = {s: n.deviation for s, n in noise_of([run], [errors]).items()}
    lasting = {s for s, n in problem.noise.items() if s in problem.coloured or n.of_sensor is not None}
    return {s: max(x, problem.noise[s].deviation) if s in lasting else x for s, x in floor.items()}


def _force_row(problem: Problem, run: Run, compared: Sequence[Hypothesis], seed: int) -> list[HeldoutRow]:
    """Error of the inverse dynamics relative to the driving force, in percent of its norm."""
    parts = [force_error(problem.simulator, run, h.vector, h.active) for h in compared]
    errors, force = [np.clip(e, -RAN_AWAY, RAN_AWAY) for e, _ in parts], parts[0][1]
    if not force.size:
        return []
    percent = [100.0 * rms(e) / rms(force) for e in errors]
    found = len(percent) == 3
    return [
        HeldoutRow(
            recording=run.name, region="all", signal=DRIVING_FORCE, unit="%", samples=force.size,
            nominal=percent[0], refitted=percent[1], corrected=percent[2] if found else None, noise_floor=None,
            gain=_gain(percent[1], percent[2]) if found else None,
            gain_interval=gain_interval(errors[1], errors[2], seed=seed) if found else None,
        )
    ]  # fmt: skip


def without_levels(problem: Problem) -> Problem:
    """The problem of a model that knows no levels of single recordings."""
    of_runs = tuple(own for own in problem.prior.of_runs if not own.level)
    return replace(problem, prior=replace(problem.prior, of_runs=of_runs))


def errors_alone(problem: Problem, run: Run, this: Hypothesis) -> dict[str, Array]:
    """Free-run errors (n,) of each signal of a run."""
    alone = replace(problem, runs=(run.following_nothing(),))
    found = alone.residuals(this.vector, this.active)[0]
    return dict(found)


def _slow(run: Run) -> NDArray[np.bool_]:
    speed = np.abs(run.motion[0])
    result: NDArray[np.bool_] = speed < 0.1 * np.percentile(speed, 99.5)
    return result


def _row(
    run: Run,
    region: str,
    signal: str,
    units: Mapping[str, str],
    parts: list[Array],
    floor: float,
    found: bool,
    seed: int,
) -> HeldoutRow:
    errors = [rms(p) for p in parts]
    gain = _gain(errors[1], errors[2]) if found else None
    return HeldoutRow(
        recording=run.name,
        region=region,
        signal=signal,
        unit=units[signal],
        samples=parts[0].size,
        nominal=errors[0],
        refitted=errors[1],
        corrected=errors[2] if found else None,
        noise_floor=floor,
        gain=gain,
        gain_interval=gain_interval(parts[1], parts[2], seed=seed) if found else None,
    )


def _gain(before: float, after: float) -> float | None:
    """Share of an error that is removed; None where there is no such share."""
    if not (np.isfinite(before) and np.isfinite(after)):
        return None
    if before > 0.0:
        return 1.0 - after / before
    return 0.0 if after == 0.0 else None


def rms(x: Array) -> float:
    """Of errors (n,); inf where a simulation ran away."""
    return float(np.sqrt(np.nanmean(x**2))) if np.nanmax(np.abs(x)) < 0.5 * RAN_AWAY else float("inf")


def heldout_error(rows: Sequence[HeldoutRow]) -> float:
    """Squared error of the corrected against the refitted model, mean of signals; inf where it ran away.

    Where an axis shows its position alone, the driving force counts as a signal too.
    """
    shares = [
        (r.corrected / r.refitted) ** 2
        for r in _free_run(rows)
        if r.region == "all" and r.corrected is not None and r.refitted > 0.0
    ]
    return float(np.mean(shares)) if shares and np.isfinite(shares).all() else np.inf


def log_change(rows: Sequence[HeldoutRow]) -> float:
    """Mean logarithm of the errors of the corrected model over those of the refitted one; -inf where none is judged.

    Where an axis shows its position alone, the driving force counts as a signal too.
    """
    logs = [
        float(np.log(max(r.corrected, 1e-300) / r.refitted))
        for r in _free_run(rows)
        if r.region == "all" and r.corrected is not None and r.refitted > 0.0
    ]
    return float(np.mean(logs)) if logs else -np.inf


def helps(rows: Sequence[HeldoutRow]) -> bool:
    """Whether some signal is certainly better on what was not fitted, none certainly worse, and their mean by WORTH.

    Nor may any be certainly worse at low speed, which a better mean hides. What is certain of one recording need not be
    so of the next.
    """
    return _any_certainly_better(rows) and not _any_certainly_worse(rows) and heldout_error(rows) < WORTH


def hurts(rows: Sequence[HeldoutRow]) -> bool:
    """Whether what was not fitted is worse on the mean of all signals, and of some by more than a standard error.

    Or a simulation runs away. That error tells one model that is kept from another (Breiman et al. 1984, one standard
    error), not what is so.
    """
    whole = [r for r in _free_run(rows) if r.region == "all"]
    runs_away = any(r.corrected is not None and not np.isfinite(r.corrected) for r in whole)
    return runs_away or (any(r.gain_and_an_error < 0.0 for r in whole) and log_change(rows) > 0.0)


def disagreeing(rows: Sequence[HeldoutRow]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The recordings of which some signal is certainly better and none worse, and those of which the contrary is so.

    Empty where only one of the two is found: then they do not disagree.
    """
    of: dict[str, list[HeldoutRow]] = {}
    for row in _free_run(rows):
        of.setdefault(row.recording, []).append(row)
    better = tuple(n for n, own in of.items() if _any_certainly_better(own) and not _any_certainly_worse(own))
    worse = tuple(n for n, own in of.items() if _any_certainly_worse(own) and not _any_certainly_better(own))
    return (better, worse) if better and worse else ((), ())


def _free_run(rows: Sequence[HeldoutRow]) -> list[HeldoutRow]:
    """Without the driving force where an axis shows more than its position, which drifts for small reasons.

    The force that a law with a memory asks for along a noisy speed may be many times the one that acted.
    """
    drifts = not any(r.signal == "speed" for r in rows)
    return [r for r in rows if drifts or r.signal != DRIVING_FORCE]


def _any_certainly_better(rows: Sequence[HeldoutRow]) -> bool:
    return any(r.certain_gain[0] > 0.0 for r in rows if r.region == "all")


def _any_certainly_worse(rows: Sequence[HeldoutRow]) -> bool:
    return any(r.certain_gain[1] < 0.0 for r in rows)


def gain_interval(before: Array, after: Array, *, seed: int, draws: int = DRAWS) -> tuple[float, float] | None:
    """95 % interval of 1 - rms(after)/rms(before), of errors (n,), by circular block bootstrap; None where it has none.

    Blocks of twice the correlation time of the longer-lived squared error (after Politis, White 2004).
    """
    n = before.size
    whole = _gain(rms(before), rms(after))
    if whole is None or not before.any():
        return None if whole is None else (whole, whole)
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
