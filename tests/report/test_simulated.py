"""What is said of a simulation."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.recording.units import factor
from rwn.report.simulated import simulated

DEMO = Path(rwn.__file__).parent / "demo"
MODEL = rwn.read_model(DEMO / "model.toml")


@pytest.fixture
def recording() -> rwn.Recording:
    return rwn.read_recording(DEMO / "train.csv", layout=MODEL.recording)


def test_the_error_against_the_recording_is_said_in_its_units(recording: rwn.Recording) -> None:
    run = rwn.simulate(MODEL, recording)
    for unit in ("rad/s", "rpm"):
        first, second = simulated(run, replace(recording, units={"speed": unit}), Path("sim.csv"))
        assert first == f"{len(recording)} samples of {', '.join(run.signals)} in sim.csv"
        rms = float(np.sqrt(np.mean((recording.signals["speed"] - run.signals["speed"]) ** 2)))
        rms /= factor(unit, "rad/s", where="test")
        said = next(part for part in second.split(": ")[1].split(", ") if part.endswith(" of the speed"))
        assert said.split(" ")[1] == unit
        assert float(said.split(" ")[0]) == pytest.approx(rms, rel=0.01)


def test_spikes_do_not_count_in_it(recording: rwn.Recording) -> None:
    run = rwn.simulate(MODEL, recording)
    speed = recording.signals["speed"].copy()
    speed[[400, 900]] = 1e4
    _, clean = simulated(run, recording, Path("sim.csv"))
    _, spiked = simulated(run, replace(recording, signals={**recording.signals, "speed": speed}), Path("sim.csv"))
    assert spiked == f"{clean} (2 samples that measure nothing left out)"


def test_without_a_measured_signal_nothing_is_compared(recording: rwn.Recording) -> None:
    alone = replace(recording, signals={"voltage": recording.signals["voltage"]})
    assert len(list(simulated(rwn.simulate(MODEL, alone), alone, Path("sim.csv")))) == 1
