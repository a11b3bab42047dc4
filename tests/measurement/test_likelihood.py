"""When one choice is decisively likelier than another."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

import rwn
from rwn.fit.fit import fit_nominal
from rwn.fit.preparation import prepare
from rwn.fit.residuals import MISSPECIFIED, MOST_SAMPLES, correlation_time, join, statistics_of, structured_of
from rwn.measurement.likelihood import is_decisive, under_own_colour


@pytest.mark.parametrize(
    ("slow", "most"),
    [(0.0, MOST_SAMPLES), (1.0, 1.0 / (2 / 3 / MOST_SAMPLES + 1 / 3 / MISSPECIFIED)), (1e4, MISSPECIFIED)],
)
def test_a_gain_counts_in_as_many_samples_as_what_is_left_is_worth(slow: float, most: float) -> None:
    """Of 20 000 samples: errors that are more than noise say the less the more of them is misfit."""
    noise = np.random.default_rng(1).standard_normal(20_000)
    joined = {"speed": noise + slow * np.sin(np.arange(noise.size) / 300.0)}
    left = statistics_of(joined, structured=structured_of(joined))
    enough = np.log(1000.0) * noise.size / most
    assert is_decisive(1.05 * enough, left)
    assert not is_decisive(0.95 * enough, left)


def test_errors_under_their_own_colour_are_white() -> None:
    slow = lfilter([0.05], [1.0, -0.95], np.random.default_rng(5).standard_normal(2000))
    run = rwn.Recording(
        name="run", time=1e-3 * np.arange(2000), signals={"voltage": np.ones(2000), "speed": 100.0 + slow}
    )
    problem = prepare([run], rwn.read_model(Path(rwn.__file__).parent / "demo" / "model.toml"))
    nominal = fit_nominal(problem)
    own = under_own_colour(problem, nominal)
    before, after = (join(p, p.residuals(nominal.vector, nominal.active))["speed"] for p in (problem, own))
    assert correlation_time(before) > 10.0
    assert correlation_time(after) < 1.5
    assert np.mean(after**2) == pytest.approx(1.0, rel=0.05)
