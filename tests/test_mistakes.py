"""Mistakes in the recordings are found before any physics."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn import mistakes
from rwn.prepare import prepare
from rwn.search import Search

DEMO = Path(rwn.__file__).parent / "demo"
MOTION = ("speed", "position")


@pytest.fixture(scope="module")
def model() -> rwn.Model:
    return rwn.read_model(DEMO / "model.toml")


@pytest.fixture(scope="module")
def right(model: rwn.Model) -> rwn.Recording:
    """A run of the model itself with noise: nothing is wrong and nothing is missing."""
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    rng = np.random.default_rng(1)
    out = rwn.simulate(model, recording)
    signals = {"voltage": recording.signals["voltage"]}
    for name in ("current", "speed"):
        clean = out.signals[name]
        signals[name] = clean + 0.01 * clean.std() * rng.standard_normal(clean.size)
    return replace(recording, signals=signals)


def altered(recording: rwn.Recording, names: tuple[str, ...], factor: float = 1.0, delay: int = 0) -> rwn.Recording:
    signals = {name: np.array(values) for name, values in recording.signals.items()}
    for name in names:
        if name in signals:
            rolled = np.roll(signals[name], delay)
            if delay > 0:
                rolled[:delay] = signals[name][0]
            elif delay < 0:
                rolled[delay:] = signals[name][-1]
            signals[name] = factor * rolled
    return replace(recording, signals=signals)


def without(recording: rwn.Recording, name: str) -> rwn.Recording:
    return replace(recording, signals={k: v for k, v in recording.signals.items() if k != name})


@pytest.mark.parametrize(
    ("names", "factor", "name"),
    [
        (MOTION, 60.0 / (2.0 * np.pi), "wrong-unit"),
        (MOTION, 180.0 / np.pi, "wrong-unit"),
        (MOTION, 1.0 / (2.0 * np.pi), "wrong-unit"),
        (MOTION, -60.0 / (2.0 * np.pi), "wrong-unit"),
        (("current",), 1e3, "wrong-unit"),
        (MOTION, -1.0, "wrong-sign"),
        (("current",), -1.0, "wrong-sign"),
        (("voltage",), -1.0, "wrong-sign"),
    ],
)
def test_units_and_signs(
    model: rwn.Model, right: rwn.Recording, names: tuple[str, ...], factor: float, name: str
) -> None:
    wrong = altered(right, names, factor)
    found = mistakes.gross([wrong], model)
    assert found is not None
    assert (found.name, found.factor) == (name, pytest.approx(factor))
    for signal, values in found.undo(wrong).signals.items():
        assert values == pytest.approx(right.signals[signal])


def test_nothing_is_doubted_where_nothing_is_wrong(model: rwn.Model, right: rwn.Recording) -> None:
    assert mistakes.gross([right], model) is None
    assert mistakes.gross([without(right, "current")], model) is None


def test_missing_physics_is_no_mistake(model: rwn.Model) -> None:
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    assert mistakes.gross([recording], model) is None
    assert rwn.diagnose([recording], model).verdict == "missing-physics"


def cost(recording: rwn.Recording, model: rwn.Model) -> tuple[dict[str, float], float]:
    setup = prepare([recording], model)
    noise = {name: 0.01 * float(np.std(recording.signals[name])) for name in setup.problem.targets[0].recorded}
    problem = replace(setup.problem, noise=noise)
    return noise, Search.of(setup, problem=problem).fit_nominal().cost


@pytest.mark.parametrize(
    ("names", "delay", "signal"), [(MOTION, 7, "speed"), (MOTION, -5, "speed"), (("current",), 4, "current")]
)
def test_channels_out_of_step(
    model: rwn.Model, right: rwn.Recording, names: tuple[str, ...], delay: int, signal: str
) -> None:
    wrong = altered(right, names, delay=delay)
    noise, rival = cost(wrong, model)
    found = mistakes.fine([wrong], model, noise=noise, rival=rival)
    assert found is not None
    assert (found.name, found.signals[0], found.delay) == ("time-shift", signal, delay)


def test_only_what_looks_like_a_mistake_is_suspected(model: rwn.Model, right: rwn.Recording) -> None:
    assert mistakes.suspected([right], model) is None
    found = mistakes.suspected([altered(right, ("current",), delay=6)], model)
    assert found is not None
    assert (found.name, found.delay) == ("time-shift", 6)
    friction = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    assert mistakes.suspected([friction], model) is None, "missing physics is none"


def test_gear_ratio(model: rwn.Model, right: rwn.Recording) -> None:
    wrong = altered(right, MOTION, 1.0 / 5.2)
    noise, rival = cost(wrong, model)
    found = mistakes.fine([wrong], model, noise=noise, rival=rival)
    assert found is not None
    assert found.name == "wrong-gear-ratio"
    assert found.factor == pytest.approx(1.0 / 5.2, rel=0.1)


def test_the_verdict_names_the_mistake_before_the_physics(model: rwn.Model) -> None:
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    found = rwn.diagnose([altered(recording, MOTION, 60.0 / (2.0 * np.pi))], model)
    assert found.verdict == "recording-mistake"
    assert found.equation == "recording"
    assert [e.name for e in found.effects] == ["wrong-unit", "coulomb-friction"]
    assert found.effects[0].parameters["factor"].value == pytest.approx(9.5493, rel=1e-4)


def test_a_drive_that_is_hardly_moved_says_nothing(model: rwn.Model, right: rwn.Recording) -> None:
    rng = np.random.default_rng(2)
    n = len(right)
    signals = {
        "voltage": np.zeros(n),
        "current": 1e-2 * rng.standard_normal(n),
        "speed": 0.5 * rng.standard_normal(n),
    }
    found = rwn.diagnose([replace(right, signals=signals)], model)
    assert found.verdict == "insufficient-excitation"
    assert "no motion" in found.next_experiment
