"""A speed and a position that agree: neither has a wrong sign by itself."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL
from rwn.faults import scale
from rwn.faults.scale import wrong_scale
from rwn.recording.kinematics import kinematics_of
from rwn.recording.signals import MOTION

MODEL = rwn.Model(kind="dc", parameters=SMALL)


def _turned() -> rwn.Recording:
    """A motor whose encoder counts against its voltage."""
    time = 1e-3 * np.arange(2000)
    voltage = np.repeat(3.0 * np.random.default_rng(4).uniform(-1.0, 1.0, 40), 50)
    signals = rwn.simulate(MODEL, rwn.Recording(name="run", time=time, signals={"voltage": voltage})).signals
    motion = {s: -np.asarray(signals[s]) for s in MOTION}
    return rwn.Recording(name="run", time=time, signals={"voltage": voltage, **motion})


def test_both_have_the_wrong_sign_together() -> None:
    turned = _turned()
    motion = kinematics_of(turned)
    assert motion is not None
    assert motion.agree
    found = wrong_scale([turned], MODEL)
    assert found is not None
    assert set(found.signals) == set(MOTION)


def test_neither_has_it_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever else goes against the model: the speed turned alone would be no rate of the position."""
    monkeypatch.setattr(scale, "_candidates", lambda *_: [scale._wrong_sign(("speed",))])
    turned = _turned()
    assert wrong_scale([turned], MODEL) is None
    others = {s: x for s, x in turned.signals.items() if s != "position"}
    assert wrong_scale([rwn.Recording(name="run", time=turned.time, signals=others)], MODEL) is not None
