"""Mains hum is found beside a motion, taken off, and told from what the motion does by itself."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from rwn.recording.inspection import inspected
from rwn.recording.inspection.hum import without_hum
from rwn.recording.recording import Recording

Array = NDArray[np.float64]
STEP, NOISE = 1e-3, 0.3


def driven(u: Array, *, friction: float = 0.0, step: float = STEP) -> Array:
    """The speed (n,) of a motor with a time constant of 50 ms and dry friction."""
    w = np.zeros(u.size)
    for k in range(1, u.size):
        push = u[k - 1] - friction * np.sign(w[k - 1])
        w[k] = w[k - 1] + step / 0.05 * (push - w[k - 1])
    return w


def recorded(u: Array, w: Array, *, step: float = STEP, seed: int = 0, noise: float = NOISE) -> Recording:
    time = step * np.arange(u.size)
    speed = w + noise * np.random.default_rng(seed).normal(size=u.size)
    return Recording(name="run", time=time, signals={"voltage": u, "speed": speed})


def with_hum(this: Recording, *, mains: float = 50.0, rms: float = 0.2) -> tuple[Recording, Array]:
    turns = 2.0 * np.pi * mains * this.time
    hum = rms * (np.sin(turns + 1.0) + 0.4 * np.sin(3.0 * turns)) * np.sqrt(2.0 / 1.16)
    return replace(this, signals={**this.signals, "speed": this.signals["speed"] + hum}), hum


def steps(seed: int, count: int = 4000) -> Array:
    levels: Array = np.random.default_rng(seed).normal(scale=50.0, size=20)
    return np.repeat(levels, count // 20)


@pytest.mark.parametrize("mains", [50.0, 60.05])
def test_it_is_found_beside_steps_of_a_motor_and_taken_off(mains: float) -> None:
    u = steps(0)
    clean = recorded(u, driven(u, friction=5.0))
    noisy, hum = with_hum(clean, mains=mains)
    (found,), findings = inspected([noisy])
    (said,) = findings
    assert (said.kind, said.signals, said.done) == ("hum", ("speed",), "taken off")
    seen = re.fullmatch(r"the speed has a mains hum of (\d+), (\d+) Hz, ([\d.]+) rad/s rms", said.words)
    assert seen is not None
    assert [float(x) for x in seen.groups()] == [round(mains), round(3 * mains), pytest.approx(0.2, rel=0.1)]
    left = np.std(found.signals["speed"] - clean.signals["speed"])
    assert left < 0.2 * np.std(hum), "the rest of a line, known as well as noise allows"
    np.testing.assert_array_equal(found.signals["voltage"], u)


def test_it_is_rarely_found_where_there_is_none() -> None:
    """The level is 1 of 1000 signals; 4 or more of 100 have a chance of 4e-6."""
    found = sum(bool(without_hum(recorded(u, driven(u, friction=5.0), seed=k))[1])
                for k, u in enumerate(map(steps, range(100))))  # fmt: skip
    assert found < 4


@pytest.mark.parametrize("frequency", [2.0, 10.0, 50.0])
@pytest.mark.parametrize("shape", [np.sin, lambda turns: np.sign(np.sin(turns))])
def test_the_answer_to_a_periodic_input_is_none(frequency: float, shape: np.ufunc) -> None:
    """Dry friction makes odd multiples of its frequency, of which 50 Hz is one of 2 and of 10 Hz."""
    turns = 2.0 * np.pi * frequency * STEP * np.arange(6000) + 0.3
    u = 50.0 * shape(turns)
    this = recorded(u, driven(u, friction=8.0), noise=0.01)
    assert without_hum(this) == (this, [])


def test_what_a_controller_lets_through_does_not_hide_it() -> None:
    u = steps(3)
    noisy, hum = with_hum(recorded(u, driven(u)), rms=0.3)
    fed_back = u - 0.5 * hum
    speed = noisy.signals["speed"] + driven(fed_back) - driven(u)
    noisy = replace(noisy, signals={"voltage": fed_back, "speed": speed})
    assert [f.kind for f in without_hum(noisy)[1]] == ["hum"]


def test_a_position_that_is_new_50_times_a_second_has_no_hum_of_its_updates() -> None:
    """Held between, it climbs by 50 stairs a second."""
    time = 0.005 * np.arange(2000)
    position = 30.0 * time + 0.01 * np.random.default_rng(0).normal(size=time.size)
    held = np.repeat(position[::4], 4)
    this = Recording(name="run", time=time, signals={"voltage": np.full(time.size, 3.0), "position": held})
    (found,), findings = inspected([this])
    assert [f.kind for f in findings] == ["held"]
    np.testing.assert_array_equal(found.signals["position"][::4], held[::4])


def test_a_clipped_sample_keeps_its_value_but_for_the_hum_beside_it() -> None:
    u = steps(7)
    noisy, hum = with_hum(recorded(u, driven(u)))
    clipped = np.zeros(u.size, dtype=bool)
    clipped[1500:1520] = True
    found, findings = without_hum(replace(noisy, missing={"speed": clipped}))
    assert findings
    off = found.signals["speed"] - noisy.signals["speed"]
    assert np.max(np.abs(off[clipped])) < 1.1 * np.max(np.abs(hum))
    assert np.std(off[~clipped] + hum[~clipped]) < 0.2 * np.std(hum)


def test_rows_may_be_lost() -> None:
    u = steps(1)
    noisy, hum = with_hum(recorded(u, driven(u)))
    kept = np.sort(np.random.default_rng(2).choice(u.size, size=3800, replace=False))
    lossy = replace(noisy, time=noisy.time[kept], signals={s: x[kept] for s, x in noisy.signals.items()})
    found, findings = without_hum(lossy)
    assert findings
    left = found.signals["speed"] - (noisy.signals["speed"] - hum)[kept]
    assert np.std(left) < 0.3 * np.std(hum)


def test_a_slow_logger_shows_it_at_another_frequency() -> None:
    """At 80 Hz a line of 50 Hz looks like one of 30 Hz, and that of 150 Hz like one of 10 Hz."""
    u = steps(4)
    noisy, hum = with_hum(recorded(u, driven(u, step=1.0 / 80.0), step=1.0 / 80.0), rms=0.4)
    found, findings = without_hum(noisy)
    assert "50, 150 Hz" in findings[0].words
    assert np.std(found.signals["speed"] - noisy.signals["speed"] + hum) < 0.2 * np.std(hum)


def test_a_mains_that_does_not_keep_its_phase_is_followed_through_a_long_recording() -> None:
    u = np.repeat(np.random.default_rng(5).normal(scale=50.0, size=60), 2000)
    this = recorded(u, np.zeros(u.size))
    phase = np.where(this.time < 60.0, 0.0, 2.0)
    hum = 0.2 * np.sin(2.0 * np.pi * 50.0 * this.time + phase)
    noisy = replace(this, signals={**this.signals, "speed": this.signals["speed"] + hum})
    found, findings = without_hum(noisy)
    assert len(findings) == 1
    assert np.std(found.signals["speed"] - this.signals["speed"]) < 0.2 * np.std(hum)


@pytest.mark.parametrize("rows", [0, 1, 5, 300])
def test_what_is_too_short_or_stands_still_has_none(rows: int) -> None:
    this = Recording(
        name="run", time=STEP * np.arange(rows), signals={"voltage": np.ones(rows), "speed": np.zeros(rows)}
    )
    assert without_hum(this) == (this, [])


@pytest.mark.parametrize(("dwell", "seed"), [(7, 3), (10, 1), (20, 3), (35, 2), (50, 4)])
def test_what_a_signal_answers_to_its_input_at_the_mains_is_no_hum(dwell: int, seed: int) -> None:
    """A current of half an ampere goes with a pseudo-random voltage of 1.4 s; the wires pick up 1 mA."""
    rng, step, count = np.random.default_rng(seed), 4e-4, 3500
    time, u = step * np.arange(count), 9.0 * np.sign(rng.normal(size=count // dwell + 1)).repeat(dwell)[:count]
    clean = np.roll(u, 1) / 18.0 + 0.002 * rng.normal(size=count)
    hum = 0.001 * np.sqrt(2.0) * np.sin(2.0 * np.pi * 50.0 * time + seed)
    noisy = Recording(name="run", time=time, signals={"voltage": u, "current": clean + hum})
    found, (said,) = without_hum(noisy)
    assert said.kind == "hum"
    assert np.std(found.signals["current"] - clean) < 0.2 * np.std(hum)


@pytest.mark.parametrize("step", [0.1, 0.05, 0.02, 0.01, 1.0, 0.04, 1 / 60, 1 / 30, 1 / 120, 0.25, 1 / 3])
def test_any_rate_of_a_logger_is_looked_at(step: float) -> None:
    """A rate that goes into those of both mains shows none of their lines."""
    u = steps(2, count=1500)
    clean = recorded(u, driven(u, step=min(step, 0.02)), step=step)
    made, found = without_hum(clean)
    assert not found
    np.testing.assert_array_equal(made.signals["speed"], clean.signals["speed"])
    assert len(inspected([clean]).recordings) == 1


@pytest.mark.parametrize("rate", [2.5, 5.0])
def test_beside_a_simulation_it_is_found_under_an_input_of_which_it_is_a_multiple(rate: float) -> None:
    """What the drive answers is in the simulation; beside the motion itself a line could be its answer."""
    u = 60.0 * np.sign(np.sin(2.0 * np.pi * rate * (STEP * np.arange(6000) + 1e-4)))
    w = driven(u)
    this, hum = with_hum(recorded(u, w, seed=3))
    assert not without_hum(this)[1]
    made, (found,) = without_hum(this, simulated={"speed": w})
    assert "50" in found.words
    assert np.std(this.signals["speed"] - made.signals["speed"] - hum) < 0.2 * np.std(hum)
    rubbing = recorded(u, driven(u, friction=10.0), seed=3)
    assert not without_hum(rubbing, simulated={"speed": w})[1], "what friction makes of such an input is no hum"
