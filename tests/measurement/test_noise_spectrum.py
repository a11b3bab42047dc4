"""The colour of a sensor's noise beside what a model leaves out."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import lfilter

from rwn.measurement.filter_colour import CERTAINLY
from rwn.measurement.noise_spectrum import WINDOWS, NoiseColour, noise_colour

SEEDS = range(12)


def _noise(share: float, seed: int, samples: int = 4000) -> NDArray[np.float64]:
    """Noise of deviation 1 before a filter that keeps `share`."""
    filtered: NDArray[np.float64] = lfilter(
        [1.0 - share], [1.0, -share], np.random.default_rng(seed).standard_normal(samples)
    )
    return filtered


def _motion(seed: int, samples: int = 4000) -> NDArray[np.float64]:
    """An error a hundred times the noise that bends at random, as a wrong inertia leaves one."""
    bends = np.zeros(samples)
    bends[::50] = np.random.default_rng(100 + seed).standard_normal(bends[::50].size)
    made: NDArray[np.float64] = lfilter([1.0], [1.0, -1.9, 0.9025], bends)
    return 100.0 * made / float(np.std(made))


@pytest.mark.parametrize("share", [0.25, 0.5, 0.75])
@pytest.mark.parametrize("beside", [0.0, 1.0])
def test_the_share_is_told_as_well_as_it_is_said_to_be(share: float, beside: float) -> None:
    found = [noise_colour([_noise(share, seed) + beside * _motion(seed)]) for seed in SEEDS]
    off = np.array([(f.share - share) / f.deviation for f in found])
    assert np.all(np.abs(off) < 3.5)
    assert np.sqrt(np.mean(off**2)) < 1.6
    assert np.median([f.filtered for f in found]) > 0.85


@pytest.mark.parametrize(("beside", "typical"), [(0.0, 0.1), (1.0, 0.5)])
def test_white_noise_has_passed_no_filter(beside: float, typical: float) -> None:
    """Beside a large motion less of it is seen, so that less can be excluded."""
    found = [noise_colour([_noise(0.0, seed) + beside * _motion(seed)]) for seed in SEEDS]
    assert max(f.filtered for f in found) < CERTAINLY
    assert np.median([f.filtered for f in found]) < typical
    assert max(f.evidence for f in found) < 3.0


@pytest.mark.parametrize("amplitude", [0.7, 5.0])
@pytest.mark.parametrize("frequency", [0.11, 0.2376, 0.4])
def test_a_line_tells_nothing_of_a_filter(frequency: float, amplitude: float) -> None:
    """As the ripple of a bridge: it was taken for the colour of the noise."""
    line = amplitude * np.cos(2.0 * np.pi * frequency * np.arange(4000))
    white = [noise_colour([_noise(0.0, seed) + line]) for seed in SEEDS]
    assert max(f.filtered for f in white) < CERTAINLY
    filtered = [noise_colour([_noise(0.6, seed) + line]) for seed in SEEDS]
    off = np.array([(f.share - 0.6) / f.deviation for f in filtered])
    assert np.all(np.abs(off) < 3.5)
    assert np.median([f.filtered for f in filtered]) > 0.85


def test_more_samples_tell_more() -> None:
    few, many = (noise_colour([_noise(0.5, 1, samples)]) for samples in (500, 20_000))
    assert many.deviation < 0.5 * few.deviation
    assert many.evidence > few.evidence


def test_the_unit_of_a_signal_does_not_matter() -> None:
    x = _noise(0.5, 2) + _motion(2)
    one, other = noise_colour([x]), noise_colour([1e6 * x + 7.0])
    assert other.share == pytest.approx(one.share, abs=1e-6)


def test_samples_that_are_left_out_are_not_needed() -> None:
    x = _noise(0.6, 3)
    x[::400] = np.nan
    found = noise_colour([x[:2000], x[2000:]])
    assert found.share == pytest.approx(0.6, abs=3.0 * found.deviation)
    assert found.filtered > 0.95


@pytest.mark.parametrize(
    "x", [np.zeros(1000), np.ones(min(WINDOWS) - 1), np.full(1000, np.nan)], ids=["0", "short", "lost"]
)
def test_what_holds_no_noise_tells_nothing(x: NDArray[np.float64]) -> None:
    assert noise_colour([x]) == NoiseColour()
