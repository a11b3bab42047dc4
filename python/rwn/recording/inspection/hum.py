"""Mains hum on the wires of a sensor: lines at 50 or 60 Hz and their harmonics, in whatever else the signal does.

A nonlinear drive answers a periodic input with all multiples of its frequency: where the mains is one, none is sought.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rwn.recording.inspection.finding import Finding
from rwn.recording.recording import ENOUGH, Recording
from rwn.recording.signals import MEASURED, SIGNALS, si_unit
from rwn.recording.spectral_lines import FINER, TAPERS, Line, amplitude, line_chances, sum_of

Array = NDArray[np.float64]

MAINS = (50.0, 60.0)  # Hz
ORDERS = (1, 2, 3, 4, 5, 7)  # harmonics; a rectifier makes the even ones
LOWEST = (1, 2)  # harmonics of which hum has one at least
CLOCK = 0.002  # how far a line may lie off, relatively: the mains 0.1 Hz, and a logger's clock as much
LEVEL = 0.001  # chance of hum in a signal without it: 1 % of a diagnosis, of some ten signals
NOT_SIMULATED: Mapping[str, Array] = MappingProxyType({})
CYCLES = 25  # fewest of the mains in what is looked at: the band of a line is then a third of its frequency at most


def without_hum(
    recording: Recording, *, simulated: Mapping[str, Array] = NOT_SIMULATED
) -> tuple[Recording, list[Finding]]:  # fmt: skip
    """The recording without the hum of its sensors, and what was found.

    `simulated`: signals (n,) without hum, beside which it is looked for.
    """
    signals, findings = dict(recording.signals), []
    for signal in (s for s in MEASURED if s in signals):
        x, found = np.array(signals[signal]), list[Line]()
        # of samples that measure: values that are held between updates have a line at the rate of these
        known = np.flatnonzero(~recording.missing.get(signal, np.zeros(x.size, dtype=bool)))
        for part in (known[p] for p in _parts(known.size)):
            time = recording.time[part] - recording.time[part][:1]
            beside = simulated[signal][part] if signal in simulated else 0.0
            lines = _hum(time, x[part] - beside, [signals[s][part] for s in signals if s not in MEASURED])
            x[part] -= sum_of(lines, time)
            found += lines
        if found:
            hum = (signals[signal] - x)[known]
            findings.append(_finding(recording, signal, found, float(np.std(hum))))
            # what stands in for samples that measure nothing goes with those beside them
            signals[signal] = signals[signal] - np.interp(recording.time, recording.time[known], hum)
    return (replace(recording, signals=signals) if findings else recording), findings


def _finding(recording: Recording, signal: str, lines: Sequence[Line], rms: float) -> Finding:
    unit = si_unit(SIGNALS[signal], recording.linear)
    at = ", ".join(f"{f:g}" for f in sorted({round(line.frequency) for line in lines}))
    return Finding(
        kind="hum", recording=recording.name, signals=(signal,), count=len(recording),
        words=f"the {signal} has a mains hum of {at} Hz, {rms:.3g} {unit} rms", done="taken off",
    )  # fmt: skip


def _parts(rows: int) -> Iterator[slice]:
    """Of a long recording, through which the mains does not keep its phase."""
    count = max(1, rows // ENOUGH)
    edges = np.linspace(0, rows, count + 1).astype(int)
    yield from (slice(int(a), int(b)) for a, b in pairwise(edges))


def _hum(time: Array, x: Array, inputs: Sequence[Array]) -> list[Line]:
    """The lines of a signal (n,) at the mains and its harmonics."""
    length = float(time[-1]) if time.size else 0.0
    if length * min(MAINS) < CYCLES or time.size < CYCLES * TAPERS or np.ptp(x) == 0.0:
        return []
    step, band = float(np.median(np.diff(time))), (TAPERS + 1) / length
    asked = {(m, order): m * order for m in MAINS for order in ORDERS}
    seen = {which: f for which, f in asked.items() if band < _alias(f, step) < 0.5 / step - band}
    if not seen:  # rows at a rate that goes into that of the mains show it at rest, or at half their rate
        return []
    evenly, even = _evenly(time, x, step), [_evenly(time, u, step) for u in inputs]
    answers = _lines_of_its_own(evenly, step, list(seen.values()), band)
    given = [f for u in even for f in _lines_of_its_own(u, step, list(seen.values()), band)]
    own = [f for f in given if any(_is_multiple(line, [f], band) for line in answers)]
    frequencies, chances = line_chances(evenly, step, finer=FINER, inputs=even)
    found: dict[tuple[float, int], Line] = {}
    for which, f in seen.items():
        alias = _alias(f, step)
        near = np.flatnonzero(np.abs(frequencies - alias) < CLOCK * f + 1.0 / length)
        best = near[int(np.argmin(chances[near]))]
        line = f + float(frequencies[best] - alias) * (1.0 if _is_upright(f, step) else -1.0)
        if chances[best] * near.size / FINER * len(seen) < LEVEL and not _is_multiple(f, own, band):
            found[which] = Line(frequency=line, amplitude=amplitude(time, x, inputs, line, step))
    return max((_of(mains, found, step, band) for mains in MAINS), key=len)


def _of(mains: float, found: Mapping[tuple[float, int], Line], step: float, band: float) -> list[Line]:
    """The lines of one mains, of which one at least is no higher harmonic; of lines that samples show as one, one."""
    kept: list[Line] = []
    for line in (line for (m, _), line in found.items() if m == mains):
        if all(abs(_alias(line.frequency, step) - _alias(other.frequency, step)) > band for other in kept):
            kept.append(line)
    return kept if any((mains, order) in found for order in LOWEST) else []


def _evenly(time: Array, x: Array, step: float) -> Array:
    """The signal at even instants, also where rows are lost."""
    even: Array = np.interp(np.arange(0.0, time[-1] + 0.5 * step, step), time, x)
    return even


def _alias(frequency: float, step: float) -> float:
    """Where samples show a frequency [Hz]."""
    return abs(frequency - round(frequency * step) / step)


def _is_upright(frequency: float, step: float) -> bool:
    """Whether what samples show of a frequency rises with it."""
    return frequency * step % 1.0 < 0.5


def _lines_of_its_own(u: Array, step: float, mains: Sequence[float], band: float) -> list[float]:
    """Frequencies of the lines of a signal (n,) that is periodic; not of a mains, which a controller lets through."""
    if np.ptp(np.diff(u)) == 0.0:
        return []
    frequencies, chances = line_chances(u, step)
    of_mains = np.min(np.abs(frequencies[:, None] - [_alias(f, step) for f in mains]), axis=1) < band
    found = (chances * chances.size < LEVEL) & ~of_mains & (frequencies > 0.0)
    return [float(f) for f in frequencies[found]]


def _is_multiple(frequency: float, of: Sequence[float], band: float) -> bool:
    return any(abs(frequency - round(frequency / f) * f) < band for f in of if f > band)
