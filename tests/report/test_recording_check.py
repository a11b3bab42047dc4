"""What a check of recordings says."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

import rwn
from ranked import ranked_from
from rwn.report.recording_check import checked
from rwn.search.search import SearchResult

DEMO = Path(rwn.__file__).parent / "demo"
MODEL = rwn.read_model(DEMO / "model.toml")


def test_a_clean_recording_from_rest_is_said_to_be_one() -> None:
    recording = rwn.read_recording(DEMO / "train.csv", layout=MODEL.recording)
    lines = list(checked([recording], MODEL))
    assert lines[0].startswith("train.csv: 5000 samples of voltage, current, speed")
    speed = recording.signals["speed"]
    assert f"speed {min(speed):.3g} to {max(speed):.3g} rad/s" in lines[1], "a wrong scale shows"
    assert "  starts at rest" in lines
    assert not any("missing" in line or "spike" in line or "each is off" in line for line in lines)


def test_a_start_in_motion_lost_rows_and_spikes_are_said() -> None:
    recording = rwn.read_recording(DEMO / "train.csv", layout=MODEL.recording)
    kept = np.ones(len(recording), dtype=bool)
    kept[:1500] = kept[2000:2003] = False
    signals = {s: np.array(x[kept]) for s, x in recording.signals.items()}
    signals["speed"][[400, 900]] = 1e3
    lines = list(checked([replace(recording, time=recording.time[kept], signals=signals)], MODEL))
    assert any("starts in motion" in line for line in lines)
    assert any("3 rows are missing" in line for line in lines)
    assert any("2 single samples of the speed" in line and "left out" in line for line in lines)


def test_a_late_enable_is_said_of_its_recording() -> None:
    time, rng = 1e-3 * np.arange(2000), np.random.default_rng(2)
    voltage = 5.0 * np.repeat(rng.choice([-1.0, 1.0], 20), 100)
    runs = []
    for name, off in (("soon", 0), ("late", 400)):
        acting = np.where(np.arange(time.size) < off, 0.0, voltage)
        out = rwn.simulate(MODEL, rwn.Recording(name=name, time=time, signals={"voltage": acting})).signals
        moved = {s: out[s] + 1e-2 * rng.standard_normal(time.size) for s in ("current", "speed")}
        runs.append(rwn.Recording(name=name, time=time, signals={"voltage": voltage, **moved}))
    lines = list(checked(runs, MODEL))
    (said,) = (k for k, line in enumerate(lines) if "as before an enable: the voltage is taken as 0 until then" in line)
    assert said > next(k for k, line in enumerate(lines) if line.startswith("late: "))
    assert "for the first 0.4 s" in lines[said]


def test_a_speed_that_is_a_difference_of_positions_is_said_to_be_one() -> None:
    clean = rwn.read_recording(DEMO / "train.csv", layout=MODEL.recording)
    position = np.cumsum(clean.signals["speed"]) * 1e-3
    for window, of in ((1, ""), (8, " of 8 samples: a mean over 8 ms")):
        counted = np.round(position * 4000 / (2 * np.pi)) * 2 * np.pi / 4000
        late = np.concatenate([np.zeros(window), counted[:-window]])
        recording = replace(clean, signals={**clean.signals, "speed": (counted - late) / (window * 1e-3)})
        said = f"the speed is a difference of positions{of}: it is compared as such"
        assert any(said in line for line in checked([recording], MODEL))
        found = SearchResult(model=MODEL, late=(), faults=(), ranking=ranked_from([recording], MODEL, ["unbalance"]))
        (told,) = [f for f in found.findings if f.kind == "speed-difference"]
        assert f"{told.words}: it is {told.done}" == said


def test_a_wrong_unit_is_said_after_the_recordings() -> None:
    recording = rwn.read_recording(DEMO / "train.csv", layout=MODEL.recording)
    signals = {**recording.signals, "voltage": 1e3 * recording.signals["voltage"]}
    *_, said = checked([replace(recording, signals=signals)], MODEL)
    assert said.startswith("voltage in thousandths of the unit (milli) taken for the unit: rwn diagnose undoes it")
    assert not any("undoes" in line for line in checked([recording], MODEL))


def test_uneven_times_are_said_as_what_they_are() -> None:
    """About even times, or by a period that varies."""
    recording = rwn.read_recording(DEMO / "train.csv", layout=MODEL.recording)
    draw = np.random.default_rng(5)
    about = recording.time + 1e-4 * draw.uniform(-1.0, 1.0, len(recording))
    wandering = np.cumsum(1e-3 * draw.uniform(0.75, 1.25, len(recording)))
    runs = [replace(recording, time=time) for time in (about, wandering)]
    said = [next(line for line in checked([run], MODEL) if "every" in line) for run in runs]
    assert said[0] == "  a sample every 0.001 s; rows come early or late by 5.8% of that, rms"
    assert "on average, which varies from row to row by 14.4%, rms" in said[1]


def test_a_load_that_is_held_is_no_motion_and_a_shaft_that_is_held_is_said() -> None:
    recording = rwn.read_recording(DEMO / "train.csv", layout=MODEL.recording)
    draw, n = np.random.default_rng(6), len(recording)
    held = {
        "voltage": 1.2 * np.ones(n), "current": 1.0 + 0.01 * draw.standard_normal(n),
        "speed": 0.3 * draw.standard_normal(n),
    }  # fmt: skip
    said = list(checked([replace(recording, signals=held)], MODEL))
    assert any("starts at standstill, held by its drive" in line for line in said)
    assert any("nothing moves in it, under up to 0.03" in line for line in said)
