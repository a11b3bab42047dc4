"""The phase of a user's own effect: searched all round, whatever its start and its bounds are."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from ranked import ranked_from
from rwn.errors import InputError
from rwn.model.files import read_model, write_model
from rwn.model.own_effects import OwnEffect, OwnParameter

PEAK = OwnParameter(name="peak", unit="N m", lower=0, upper=0.05, start=0.002, strength=True)
PHASE = OwnParameter(name="phase", unit="rad", lower=-3.1416, upper=3.1416, start=0, phase=True)
RIPPLE = OwnEffect(
    name="ripple", term="torque", equation="peak * sin(3 * position + phase)", parameters=(PEAK, PHASE)
)
PUMP = OwnEffect(
    name="pump", term="torque", equation="peak * sin(rate * time + phase)",
    parameters=(PEAK, PHASE, OwnParameter(name="rate", unit="rad/s", lower=40, upper=40, start=40)),
)  # fmt: skip
MODEL = rwn.Model(
    kind="dc",
    parameters={
        "resistance": 1.1, "inductance": 4.5e-4, "torque_constant": 0.037, "back_emf_constant": 0.037,
        "inertia": 2.9e-5, "viscous_friction": 6e-6,
    },
    uncertainty={"resistance": 0.05, "inertia": 0.05},
)  # fmt: skip


def _recording(model: rwn.Model) -> rwn.Recording:
    time, rng = 1e-3 * np.arange(1500), np.random.default_rng(2)
    bare = rwn.Recording(name="run", time=time, signals={"voltage": 3.0 * np.sin(5.0 * time)})
    shown = rwn.simulate(model, bare).signals
    noisy = {s: shown[s] + level * rng.standard_normal(time.size) for s, level in (("current", 0.02), ("speed", 0.3))}
    return replace(bare, signals={**bare.signals, **noisy})


@pytest.mark.parametrize("effect", [RIPPLE, PUMP], ids=lambda effect: effect.name)
@pytest.mark.parametrize("phase", [3.0, -3.0, 1.5])
def test_a_phase_is_found_all_round(effect: OwnEffect, phase: float) -> None:
    known = replace(MODEL, own_effects=(effect,))
    values = {p.name: p.start for p in effect.parameters} | {"peak": 0.004, "phase": phase}
    recording = _recording(replace(known, effects={effect.name: values}))
    best = ranked_from([recording], known, [effect.name]).fits[0].fit
    found = best.values_of(effect.name)
    assert best.added == (effect.name,)
    assert found["peak"] == pytest.approx(0.004, rel=0.05)
    assert np.angle(np.exp(1j * (found["phase"] - phase))) == pytest.approx(0.0, abs=0.05)


def test_a_model_file_keeps_it(tmp_path: Path) -> None:
    known = replace(MODEL, own_effects=(RIPPLE,))
    write_model(known, tmp_path / "motor.toml")
    assert read_model(tmp_path / "motor.toml").own_effects == known.own_effects


@pytest.mark.parametrize(
    ("changes", "said"),
    [({"unit": "N m"}, "its unit is N m"), ({"strength": True}, "a strength too"), ({"upper": 1.0}, "no turn")],
)
def test_what_is_no_phase_is_refused(changes: dict[str, object], said: str) -> None:
    wrong = replace(PHASE, **changes)  # type: ignore[arg-type]
    with pytest.raises(InputError, match=said):
        replace(RIPPLE, parameters=(PEAK, wrong))
