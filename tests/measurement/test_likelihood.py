"""When one choice is decisively likelier than another."""

from __future__ import annotations

import numpy as np
import pytest

from rwn.fit.residuals import MISSPECIFIED, MOST_SAMPLES, statistics_of
from rwn.measurement.likelihood import is_decisive


@pytest.mark.parametrize(("slow", "most"), [(0.0, MOST_SAMPLES), (10.0, MISSPECIFIED)])
def test_a_gain_counts_in_as_many_samples_as_what_is_left_is_worth(slow: float, most: float) -> None:
    """Of 20 000 samples: errors that are more than noise say little, however many there are."""
    noise = np.random.default_rng(1).standard_normal(20_000)
    left = statistics_of({"speed": noise + slow * np.sin(np.arange(noise.size) / 300.0)})
    enough = np.log(1000.0) * noise.size / most
    assert is_decisive(1.01 * enough, left)
    assert not is_decisive(0.99 * enough, left)
