"""What acted for a while in the one recording that was fitted is of that run: a model for any other is without it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR

EVENT = {"load-disturbance": {"torque": 0.02, "t_start": 0.6, "t_end": 0.9}}
MODEL = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.05, "viscous_friction": 0.1})


def _run(seed: int, *, loaded: bool) -> rwn.Recording:
    rng, time = np.random.default_rng(seed), 1e-3 * np.arange(1500)
    voltage = np.repeat(rng.uniform(-3.0, 3.0, 15), 100)
    bare = rwn.Recording(name=f"run{seed}", time=time, signals={"voltage": voltage})
    out = rwn.simulate(replace(MODEL, effects=EVENT if loaded else {}), bare).signals
    noisy = {s: out[s] + level * rng.standard_normal(1500) for s, level in (("speed", 0.2), ("current", 0.01))}
    return replace(bare, signals={"voltage": voltage, **noisy})


@pytest.mark.parametrize(
    ("fitted", "heldout", "kept"),
    [([True], [], False), ([True], [False], False), ([True], [True], True), ([True, True], [], True)],
    ids=["one run", "not in what was kept back", "in what was kept back", "in two runs"],
)
def test_an_event_is_in_the_corrected_model_where_it_is_seen_to_come_again(
    fitted: list[bool], heldout: list[bool], kept: bool
) -> None:
    runs = [_run(k, loaded=loaded) for k, loaded in enumerate([*fitted, *heldout])]
    found = rwn.diagnose(runs[: len(fitted)], MODEL, heldout=runs[len(fitted) :], jobs=1, effort=0.3)
    assert [e.name for e in found.effects] == ["load-disturbance"]
    assert ("load-disturbance" in found.corrected.effects) is kept
    assert any("nothing shows that it comes again" in text for text in found.warnings) is not kept
    assert found.corrected.parameters["inertia"] == pytest.approx(MOTOR["inertia"], rel=0.01)
    if heldout:  # what is drawn is what corrected.toml simulates
        last = runs[-1]
        (picture,) = (p for p in found.curves if p.slot == "response" and p.title.endswith(last.name))
        (drawn,) = (t for t in picture.traces if t.role == "corrected")
        assert np.max(np.abs(drawn.y - np.interp(drawn.x, last.time, last.signals["speed"]))) < 2.0
