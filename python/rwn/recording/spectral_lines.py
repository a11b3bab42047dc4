"""Lines of a spectrum: sines that last through a signal, told from what is smooth about them.

By Thomson's harmonic F-test (Thomson 1982, Proc. IEEE 70:1055), with the sine tapers of Riedel and Sidorenko (1995,
IEEE Trans. SP 43:188).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

TAPERS = 7  # of which the odd ones see a line; each line takes a band of (TAPERS + 1) / length
FINER = 4  # frequencies looked at per 1 / length
LEVEL = 0.001  # chance that noise without lines loses one
MOST_LINES = 8  # that are taken off noise


@dataclass(frozen=True, kw_only=True)
class Line:
    """Re(amplitude exp(2 pi i frequency t)), t from the first row."""

    frequency: float  # Hz
    amplitude: complex


def sum_of(lines: Sequence[Line], time: Array) -> Array:
    """Their values (n,) at times [s] after the first row."""
    total = np.zeros(time.size)
    for line in lines:
        total += np.real(line.amplitude * np.exp(2j * np.pi * line.frequency * time))
    return total


def without_lines(x: Array) -> Array:
    """A signal (n,) without the lines that are in it; samples that are left out are NaN, and stay so.

    The clearest is taken off first, as it hides those beside it.
    """
    known = np.isfinite(x)
    if known.sum() < 2 * TAPERS or np.ptp(x[known]) == 0.0:
        return x
    time = np.arange(x.size, dtype=float)
    even = np.interp(time, time[known], x[known])
    taken = np.zeros(x.size)
    for _ in range(MOST_LINES):
        frequencies, chances = line_chances(even - taken, 1.0, finer=FINER)
        inside = np.flatnonzero((frequencies * x.size > TAPERS + 1) & (frequencies < 0.5 - (TAPERS + 1) / x.size))
        best = inside[np.argmin(chances[inside])] if inside.size else 0
        if not inside.size or chances[best] * inside.size / FINER > LEVEL:
            break
        taken += sum_of([_refined(time, even - taken, float(frequencies[best]))], time)
    left: Array = x - taken
    return left


def _refined(time: Array, x: Array, near: float) -> Line:
    """The line of a signal (n,) of one sample a second, about a frequency that is one of those looked at."""
    from scipy.optimize import minimize_scalar  # late: the command line starts without it

    def line(frequency: float) -> Line:
        return Line(frequency=frequency, amplitude=amplitude(time, x, (), frequency, 1.0))

    half = 0.5 / (FINER * x.size)
    best = minimize_scalar(
        lambda f: float(np.sum((x - sum_of([line(float(f))], time)) ** 2)), bounds=(near - half, near + half),
        method="bounded", options={"xatol": 0.02 * half},
    )  # fmt: skip
    return line(float(best.x))


def line_chances(x: Array, step: float, *, finer: int = 1, inputs: Sequence[Array] = ()) -> tuple[Array, Array]:
    """Frequencies (m,), and the chance (m,) of so much at each in a smooth spectrum.

    Of differences, since the spectrum of a motion falls steeply. `finer`: how many per 1 / length. `inputs`: what x
    (n,) may answer to, by a gain that is smooth too.
    """
    from scipy.fft import next_fast_len, rfft, rfftfreq  # late: the command line starts without it

    tapers = _tapers(x.size - 1)
    size = next_fast_len(finer * (x.size - 1), real=True)
    seen, *answered = (rfft(tapers * np.diff(one), size).T for one in (x, *inputs))
    return rfftfreq(size, step), _f_test(seen, tapers.sum(axis=1), answered)


def amplitude(time: Array, x: Array, inputs: Sequence[Array], frequency: float, step: float) -> complex:
    """Of a line of a signal (n,), beside what that answers to the inputs."""
    tapers = _tapers(x.size - 1)
    turning = np.exp(-2j * np.pi * frequency * time[:-1])
    seen, *answered = (((tapers * np.diff(one)) @ turning)[None, :] for one in (x, *inputs))
    seen, line = _beside(seen, tapers.sum(axis=1), answered)
    found = np.sum(np.conj(line) * seen) / np.sum(np.abs(line) ** 2)
    return complex(2.0 * found / (np.exp(2j * np.pi * frequency * step) - 1.0))


def _f_test(seen: Complex, weights: Array, answered: Sequence[Complex]) -> Array:
    """The chance (m,) of tapered spectra (m, TAPERS) without a line, and with an answer to others.

    `weights`: what each taper shows of a line.
    """
    seen, line = _beside(seen, weights, answered)
    energy = np.sum(np.abs(line) ** 2, axis=1)
    explained = np.abs(np.sum(np.conj(line) * seen, axis=1)) ** 2 / np.maximum(energy, 1e-12 * float(weights @ weights))
    left = np.maximum(np.sum(np.abs(seen) ** 2, axis=1) - explained, 1e-300)
    free = TAPERS - 1 - len(answered)
    chances: Array = (1.0 + explained / left) ** -float(free)  # of F with 2 and 2 free degrees of freedom
    return chances


def _beside(seen: Complex, weights: Array, answered: Sequence[Complex]) -> tuple[Complex, Complex]:
    """Tapered spectra (m, TAPERS), and those of a line of 1, without what they have in common with others."""
    line: Complex = np.broadcast_to(weights.astype(complex), seen.shape)
    for u in answered:
        seen, line = _without(seen, u), _without(line, u)
    return seen, line


def _without(x: Complex, u: Complex) -> Complex:
    """What of x (m, TAPERS) is orthogonal to u, at each frequency."""
    gain = np.sum(np.conj(u) * x, axis=1) / np.maximum(np.sum(np.abs(u) ** 2, axis=1), 1e-300)
    found: Complex = x - gain[:, None] * u
    return found


def _tapers(count: int) -> Array:
    """(TAPERS, count)."""
    n = np.arange(1, count + 1) / (count + 1)
    found: Array = np.sqrt(2.0 / (count + 1)) * np.sin(np.pi * np.outer(np.arange(1, TAPERS + 1), n))
    return found
