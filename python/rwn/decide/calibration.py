"""From the evidence for an effect to the probability that it or a rival acts: logistic, fitted on development trials.

`rwn trials calibrate` fits it and writes calibration.json beside this file, with what it was fitted on.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import cache
from importlib.resources import files

import msgspec
import numpy as np
from numpy.typing import NDArray

from rwn.decide.evidence import Evidence

Array = NDArray[np.float64]

ACTS = 0.5  # probability from which an effect is stated: it is more likely there than not
FEATURES = ("share", "unseen", "part", "odds", "curve")


@dataclass(frozen=True, kw_only=True)
class Calibration:
    """P(acts) = 1 / (1 + exp(-(intercept + weights (f - mean) / deviation)))."""

    intercept: float
    weights: tuple[float, ...]
    means: tuple[float, ...]
    deviations: tuple[float, ...]
    fitted_on: str = ""  # the sets with their seeds, how many names of how many trials, and the commit

    def probability(self, found: Evidence) -> float:
        """That the effect acts, or a rival in its place."""
        return self.probability_of(features(found))

    def probability_of(self, found: Array) -> float:
        """Probability that the effect, or a rival in its place, acts, from its features (5,).

        At most even where an explanation without the effect is the likelier one: nothing is stated against the ranking.
        """
        z = (found - np.array(self.means)) / np.array(self.deviations)
        learned = float(1.0 / (1.0 + np.exp(-(self.intercept + float(np.array(self.weights) @ z)))))
        return min(learned, ACTS) if found[FEATURES.index("odds")] < 0.0 else learned

    def probability_by(self, **known: float) -> float:
        """Probability that it acts where some features alone are known, by name; the others count as usual."""
        z = sum(
            weight * (_SCALES[name](known[name]) - mean) / deviation
            for name, weight, mean, deviation in zip(FEATURES, self.weights, self.means, self.deviations, strict=True)
            if name in known
        )
        return float(1.0 / (1.0 + np.exp(-(self.intercept + z))))


def features(found: Evidence) -> Array:
    """The evidence on the scales on which it is added up, (5,)."""
    known = asdict(found)
    return np.array([_SCALES[name](known[name]) for name in FEATURES])


def _log_odds(share: float) -> float:
    """Of a share, as known to half a per cent."""
    share = float(np.clip(share, 0.005, 0.995))
    return float(np.log(share / (1.0 - share)))


_SCALES: dict[str, Callable[[float], float]] = {
    "share": _log_odds,
    "unseen": _log_odds,
    "part": _log_odds,
    "odds": lambda x: float(np.arcsinh(np.clip(x, -100.0, 1e4))),
    "curve": float,
}


@cache
def calibration() -> Calibration:
    """The one that comes with rwn."""
    text = files("rwn.decide").joinpath("calibration.json").read_bytes()
    return msgspec.json.decode(text, type=Calibration)
