"""Learning-rate rules of the per-sample trainers; a new one is a file here and one entry in the registry."""

from __future__ import annotations

from rwn.networks.rates.fixed import Fixed
from rwn.networks.rates.impulse_response import ImpulseResponse
from rwn.networks.rates.normalised import Normalised
from rwn.networks.rates.rule import GUARANTEES, RateReport, RateRule
from rwn.networks.rates.thesis import Thesis
from rwn.networks.rates.tightened import Tightened

RATES: dict[str, type[RateRule]] = {rule.name: rule for rule in (Fixed, Thesis, Tightened, ImpulseResponse, Normalised)}

__all__ = [
    "GUARANTEES",
    "RATES",
    "Fixed",
    "ImpulseResponse",
    "Normalised",
    "RateReport",
    "RateRule",
    "Thesis",
    "Tightened",
]
