"""Rows that two recordings share are a copy where chance, standstill and periodic tests cannot make them so."""

from __future__ import annotations

from itertools import permutations
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.recording.copies import _changes, is_piece, rows_in_common
from rwn.recording.inspection.overlap import overlaps
from rwn.recording.recording import Recording, read_recording, write_csv

TIME = np.arange(4000) * 1e-3
DEMO = Path(rwn.__file__).parent / "demo"


def _run(seed: int, noise: float = 1.0) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(seed)
    turn = 9.0 * TIME + 2.0 * np.sin(0.7 * TIME)  # comes again nowhere
    return {
        "voltage": 12.0 * np.sign(np.sin(turn)),
        "current": np.cos(turn) + noise * 0.02 * rng.standard_normal(TIME.size),
        "speed": 150.0 * np.sin(turn + 0.3) + noise * 0.3 * rng.standard_normal(TIME.size),
    }


def _recording(signals: dict[str, np.ndarray]) -> Recording:
    return Recording(name="run", time=TIME[: signals["speed"].size], signals=signals)


def _spliced(first: dict[str, np.ndarray], second: dict[str, np.ndarray], rows: int) -> dict[str, np.ndarray]:
    """The last `rows` of one run, then the beginning of another."""
    return {name: np.concatenate([first[name][-rows:], second[name][: 2000 - rows]]) for name in first}


@pytest.mark.parametrize("rows", [2000, 1000, 250])
def test_rows_that_are_taken_from_another_recording_are_counted(rows: int) -> None:
    run, other = _run(1), _run(2)
    spliced = _spliced(run, other, rows)
    assert rows_in_common(_recording(spliced), _recording(run)) == rows
    assert rows_in_common(_recording(spliced), _recording(_run(3))) == 0


def test_so_are_those_with_fewer_digits_in_other_units(tmp_path: Path) -> None:
    """The file has 5 digits of rpm, by a factor of 5 digits: its steps are about those of 3 decimals of rad/s."""
    run = {name: np.round(x, 3) for name, x in _run(1).items()}
    write_csv(tmp_path / "a.csv", TIME, run)
    for name, rows in (("half.csv", _spliced(run, _run(2), 1000)), ("all.csv", run)):
        columns = [1e3 * TIME[: rows["speed"].size], rows["voltage"], 1e3 * rows["current"], 9.5493 * rows["speed"]]
        header = "time [ms],voltage [V],current [mA],speed [rpm]"
        np.savetxt(tmp_path / name, np.column_stack(columns), fmt="%.5g", delimiter=",", header=header, comments="")
    whole, half, every = (read_recording(tmp_path / name) for name in ("a.csv", "half.csv", "all.csv"))
    assert rows_in_common(half, whole) == 1000
    assert is_piece(every, whole)
    assert is_piece(whole, every)


@pytest.mark.parametrize("noise", [1.0, 0.1, 0.01])
def test_two_runs_of_a_profile_in_other_units_are_two_recordings(noise: float, tmp_path: Path) -> None:
    for name, seed, by, unit in (("a.csv", 1, 1.0, "rad/s"), ("b.csv", 2, 30.0 / np.pi, "rpm")):
        speed = by * _run(seed, noise)["speed"]
        columns = np.column_stack([TIME, _run(seed)["voltage"], speed])
        header = f"time [s],voltage [V],speed [{unit}]"
        np.savetxt(tmp_path / name, columns, fmt="%.5g", delimiter=",", header=header, comments="")
    a, b = (read_recording(tmp_path / name) for name in ("a.csv", "b.csv"))
    assert not is_piece(a, b)
    assert rows_in_common(a, b) == 0


def test_a_standstill_is_no_copy() -> None:
    first, second = _run(1), _run(2)
    for run in (first, second):
        for values in run.values():
            values[:2000] = 0.0
    assert rows_in_common(_recording(first), _recording(second)) == 0


def test_neither_are_a_steady_speed_that_is_counted_coarsely_and_a_periodic_test_of_a_simulator() -> None:
    """Both come again within one recording, so that they may in another."""
    steady = np.floor(3.4 * (np.arange(4000) + 1)) - np.floor(3.4 * np.arange(4000))
    turn = 2.0 * np.pi * (np.arange(4000) % 500) / 500  # eight periods, equal to the last digit
    for speed in (steady, 150.0 * np.sin(turn)):
        signals = {"voltage": np.full(4000, 3.0), "speed": speed}
        later = {name: values[700:] for name, values in signals.items()}
        assert np.count_nonzero(np.diff(speed)) > 2000
        assert rows_in_common(_recording(later), _recording(signals)) == 0


def test_chance_makes_no_rows_in_common() -> None:
    """The worst sensor: of each sample nothing but the last bit is noise, and it changes at half of the rows."""
    rng = np.random.default_rng(3)
    tossed = [_recording({"speed": rng.integers(0, 2, 4000).astype(float)}) for _ in range(8)]
    assert all(rows_in_common(a, b) == 0 for a, b in permutations(tossed, 2))
    assert rows_in_common(tossed[0], tossed[0]) == 4000


def test_what_measures_nothing_or_is_short_has_none_in_common() -> None:
    run = _run(1)
    alone = Recording(name="x", time=TIME, signals={"voltage": run["voltage"]})
    assert rows_in_common(alone, _recording(run)) == 0
    short = {name: x[:99] for name, x in run.items()}
    assert rows_in_common(_recording(short), _recording(run)) == 0


@pytest.mark.slow
def test_the_real_recordings_have_none_in_common(shared: Path) -> None:
    """Of one case each, all of one motor."""
    for folder in sorted((shared / "cases").iterdir())[::4]:
        runs = [read_recording(path) for path in sorted(folder.glob("*.csv")) if "clean" not in path.name]
        assert not [(a.name, b.name) for a, b in permutations(runs, 2) if rows_in_common(a, b)], folder.name


@pytest.mark.slow
def test_it_is_said_of_a_recording_that_is_kept_back() -> None:
    run = rwn.read_recording(DEMO / "train.csv")
    signals = {name: values[3000:].copy() for name, values in run.signals.items()}
    signals["speed"][1000:] += 0.01
    late = Recording(name="late.csv", time=run.time[:2000], signals=signals)
    (said,) = overlaps([run], [late])
    assert (said.kind, said.recording, said.count) == ("overlap", "late.csv", 1000)
    assert said.words == "1000 of 2000 rows stand in train.csv too, which is fitted"
    found = rwn.diagnose(run, DEMO / "model.toml", heldout=late, effort=0.1, jobs=1)
    assert said in found.findings


def test_the_changes_of_a_stretch_are_counted_in_it_alone() -> None:
    """Of the sensor that changes most; an input does not count."""
    run = {name: np.zeros(4000) for name in ("voltage", "current", "speed")}
    run["voltage"][:] = np.arange(4000.0)
    run["current"][1000:1040] = np.arange(1.0, 41.0)
    run["speed"][1000:1020] = np.arange(1.0, 21.0)
    made = _recording(run)
    counts = [_changes(made, list(run), begin) for begin in (0, 899, 900, 901, 999, 1000, 1010, 1040, 3900)]
    assert counts == [0, 0, 0, 1, 41, 40, 30, 0, 0]
