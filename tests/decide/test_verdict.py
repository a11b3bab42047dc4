"""The verdict, from what is stated, what is left, and what was learned."""

from __future__ import annotations

from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from made_up_motor import MOTOR
from rwn.decide.account import Account, ActingEffect, Remainder
from rwn.decide.evidence import Evidence
from rwn.decide.verdict import MATERIAL, verdict_of
from rwn.fit.fit import fit_nominal
from rwn.fit.preparation import prepare
from rwn.fit.residuals import statistics
from rwn.model.model import Model
from rwn.recording.recording import Recording
from rwn.simulate.simulation import simulate

CERTAIN = Evidence(share=0.999, unseen=0.99, part=0.999, odds=5000.0, curve=1.0)
MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1})
STRUCTURE = Remainder(share=1.0, error=4.0, signals=("speed",))


@cache
def _ranking(volts: float) -> Any:
    """The nominal model refitted to half a second of steps of `volts` under a noise of 0.05 rad/s."""
    time = 1e-3 * np.arange(500)
    voltage = volts * np.sign(np.sin(20.0 * time))
    given = Recording(name="x", time=time, signals={"voltage": voltage, "speed": np.zeros(500)})
    noise = 0.05 * np.random.default_rng(1).standard_normal(500)
    speed = simulate(MODEL, given).signals["speed"] + noise
    problem = prepare([Recording(name="x", time=time, signals={"voltage": voltage, "speed": speed})], MODEL)
    nominal = fit_nominal(problem)
    return SimpleNamespace(problem=problem, nominal_fit=nominal, before=statistics(problem, nominal))


def _verdict(together: float, left: Remainder, *, volts: float = 5.0) -> str:
    acting = ActingEffect(name="a", probability=together, together=together, share=0.5, evidence=CERTAIN)
    leading: Any = None  # is not looked at
    return verdict_of(_ranking(volts), Account(effects=(acting,), leading=leading), left)


def test_what_acts_is_missing_whatever_remains_and_whatever_was_learned() -> None:
    assert _verdict(0.9, STRUCTURE) == "missing-physics"
    assert _verdict(0.9, Remainder()) == "missing-physics"
    assert _verdict(0.9, Remainder(), volts=1e-3) == "missing-physics"


@pytest.mark.parametrize("volts", [5.0, 1e-3])
def test_structure_of_some_size_without_a_name_is_unexplained(volts: float) -> None:
    assert _verdict(0.2, STRUCTURE, volts=volts) == "unexplained"


@pytest.mark.parametrize(
    "left",
    [
        Remainder(),
        Remainder(share=1.0, error=4.0),  # loud, and white
        Remainder(share=1.0, error=1.0 + 0.99 * MATERIAL, signals=("speed",)),  # structure of no size
    ],
)
def test_without_either_it_depends_on_what_was_learned(left: Remainder) -> None:
    """Steps of a millivolt move the shaft by less than the noise."""
    assert _verdict(0.2, left) == "adequate"
    assert _verdict(0.2, left, volts=1e-3) == "insufficient-excitation"


def test_structure_counts_from_what_chance_makes_of_a_thousand_samples() -> None:
    """A mean square of n independent samples of unit variance deviates by sqrt(2 / n)."""
    draws = np.random.default_rng(0).standard_normal((4000, 1000))
    assert pytest.approx(np.std(np.mean(draws**2, axis=1)), rel=0.05) == MATERIAL  # 4000 means: known to 1 %
    loud = Remainder(share=1.0, error=1.0 + 1.01 * MATERIAL, signals=("speed",))
    assert _verdict(0.2, loud) == "unexplained"
