"""A recording that is another with fewer digits is a double; two runs of one profile are two recordings."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.recording.copies import _allowed, _decimal_places, _steps, is_piece, rows_in_common
from rwn.recording.recording import read_recording, write_csv

TIME = np.arange(2000) * 1e-3
VOLTAGE = 12.0 * np.sign(np.sin(9.0 * TIME))
SPEED = 150.0 * np.sin(9.0 * TIME + 0.3)
CURRENT = 0.8 * np.cos(9.0 * TIME) + 0.01


def _run(seed: int, noise: float = 1.0) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(seed)
    noisy = {"current": (CURRENT, 0.02), "speed": (SPEED, 0.3)}
    return {"voltage": VOLTAGE} | {
        name: x + noise * level * rng.standard_normal(TIME.size) for name, (x, level) in noisy.items()
    }


def _recording(signals: dict[str, np.ndarray], **kept: object) -> rwn.Recording:
    return rwn.Recording(name="run", time=TIME[: len(signals["speed"])], signals=signals, **kept)  # type: ignore[arg-type]


def _significant(x: np.ndarray, digits: int) -> np.ndarray:
    return np.array([float(f"{v:.{digits}g}") for v in x])


ROUNDINGS: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "to three decimals": lambda x: np.round(x, 3),
    "to one decimal, coarser than its noise": lambda x: np.round(x, 1),
    "to four digits": lambda x: _significant(x, 4),
    "down": lambda x: np.floor(x * 100.0) / 100.0,
    "towards zero": lambda x: np.trunc(x * 100.0) / 100.0,
    "to single precision": lambda x: x.astype(np.float32).astype(np.float64),
}


@pytest.mark.parametrize("how", ROUNDINGS)
def test_a_rounded_copy_is_a_double(how: str) -> None:
    run = _run(1)
    rounded = {name: ROUNDINGS[how](x) for name, x in run.items()}
    assert is_piece(_recording(rounded), _recording(run))
    assert is_piece(_recording(run), _recording(rounded))


def test_so_are_the_same_numbers_under_another_unit(tmp_path: Path) -> None:
    run = _run(1)
    for name, unit in (("rpm", "rpm"), ("slip", "rad/s")):
        write_csv(tmp_path / f"{name}.csv", TIME, {**run, "speed": run["speed"] * 0.10471975}, units={"speed": "rpm"})
        text = (tmp_path / f"{name}.csv").read_text().replace("speed [rpm]", f"speed [{unit}]")
        (tmp_path / f"{name}.csv").write_text(text)
    right, slip = (read_recording(tmp_path / f"{name}.csv") for name in ("rpm", "slip"))
    assert np.max(slip.signals["speed"]) > 5.0 * np.max(right.signals["speed"])
    assert is_piece(slip, right)
    write_csv(tmp_path / "slip.csv", TIME, _run(2))
    assert not is_piece(read_recording(tmp_path / "slip.csv"), right)


def test_so_is_a_rounded_piece_without_a_column() -> None:
    run = _run(1)
    piece = {name: np.round(run[name][300:900], 2) for name in ("voltage", "speed")}
    assert is_piece(_recording(piece), _recording(run))


@pytest.mark.parametrize(("first", "every"), [(0, 2), (1, 2), (4, 5)])
def test_so_is_every_second_row(first: int, every: int) -> None:
    run, rows = _run(1), slice(first, None, every)
    thinned = rwn.Recording(name="thin", time=TIME[rows], signals={n: np.round(x[rows], 4) for n, x in run.items()})
    assert is_piece(thinned, _recording(run))
    assert not is_piece(thinned, _recording(_run(2)))
    assert rows_in_common(thinned, _recording(run)) == len(thinned)
    other, end = _run(3), 600 // every
    again = {name: np.concatenate([x[rows][:end], other[name][rows][end:]]) for name, x in run.items()}
    half = rwn.Recording(name="half", time=TIME[rows], signals=again)
    assert not is_piece(half, _recording(run))
    assert rows_in_common(half, _recording(run)) == end


def test_so_is_a_copy_in_another_unit_with_fewer_digits(tmp_path: Path) -> None:
    run = _run(1)
    write_csv(tmp_path / "a.csv", TIME, run)
    in_rpm = np.column_stack([1e3 * TIME, VOLTAGE, np.round(1e3 * run["current"]), run["speed"] * 30.0 / np.pi])
    header = "time [ms],voltage [V],current [mA],speed [rpm]"
    np.savetxt(tmp_path / "b.csv", in_rpm, fmt="%.5g", delimiter=",", header=header, comments="")
    a, b = (read_recording(tmp_path / name) for name in ("a.csv", "b.csv"))
    assert is_piece(a, b)
    assert is_piece(b, a)


@pytest.mark.parametrize("digits", [0, 1, 2, 3, 8])
@pytest.mark.parametrize("noise", [1.0, 0.1, 0.01])
def test_two_runs_of_one_profile_are_two_recordings(digits: int, noise: float) -> None:
    first, second = _run(1, noise), _run(2, noise)
    rounded = {name: np.round(x, digits) for name, x in second.items()}
    assert not is_piece(_recording(first), _recording(rounded))
    assert not is_piece(_recording({n: np.round(x, digits) for n, x in first.items()}), _recording(rounded))


def test_so_are_two_runs_that_an_encoder_counts_coarsely() -> None:
    step = 2.0 * np.pi / 4096
    counts = [np.round((40.0 * TIME + 3e-4 * np.random.default_rng(k).standard_normal(2000)) / step) for k in (1, 2)]
    first, second = (rwn.Recording(name="a", time=TIME, signals={"position": step * x}) for x in counts)
    assert np.max(np.abs(counts[0] - counts[1])) == 1.0
    assert not is_piece(first, second)


def test_a_rounded_copy_is_refused_as_a_heldout_recording() -> None:
    run = _run(1)
    model = rwn.Model(
        kind="dc", uncertainty={"inertia": 0.1},
        parameters={
            "resistance": 0.8, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 6e-5,
            "viscous_friction": 1e-5,
        },
    )  # fmt: skip
    rounded = {name: np.round(x, 2) for name, x in run.items()}
    with pytest.raises(rwn.InputError, match="given twice"):
        rwn.diagnose(_recording(run), model, heldout=_recording(rounded))


def test_the_decimal_places_that_a_number_needs() -> None:
    values = np.array([1.5, 1.25, 7.0, 1200.0, 0.001, 0.1 + 0.2, 1.0 / 3.0])
    places = _decimal_places(values, np.floor(np.log10(values)))
    assert places.tolist() == [1.0, 2.0, 0.0, -2.0, 3.0, 1.0, 13.0]


def test_a_sample_is_rounded_to_the_last_place_of_its_decade() -> None:
    """Four digits: 12.34 to 0.01, 1.234 to 0.001; a 0 to the finest of all."""
    values = np.array([12.34, 56.78, 90.0, 1.234, 0.0, -1.2])
    made = rwn.Recording(name="x", time=np.arange(6.0), signals={"speed": values})
    np.testing.assert_allclose(_steps(made, "speed"), [0.01, 0.01, 0.01, 0.001, 0.001, 0.001])
    si = {"speed": values * np.pi / 30.0}
    in_rpm = rwn.Recording(name="x", time=np.arange(6.0), signals=si, units={"speed": "rpm"})
    np.testing.assert_allclose(_steps(in_rpm, "speed"), np.array([0.01] * 3 + [0.001] * 3) * np.pi / 30.0)
    nothing = rwn.Recording(name="x", time=np.arange(6.0), signals={"speed": np.zeros(6)})
    assert _steps(nothing, "speed").tolist() == [0.0] * 6


def test_single_precision_is_a_step_too() -> None:
    values = np.array([0.1, 1.7, 300.3]).astype(np.float32)
    made = rwn.Recording(name="x", time=np.arange(3.0), signals={"speed": values.astype(float)})
    np.testing.assert_allclose(_steps(made, "speed"), np.spacing(values))


@pytest.mark.parametrize(
    ("one", "other", "allowed"),
    [(0.1, 0.01, 0.1), (0.01, 0.1, 0.1), (0.1, 0.1, 0.0), (0.14, 0.1, 0.0), (0.16, 0.1, 0.16)],
)
def test_rounded_samples_differ_by_the_coarser_step(one: float, other: float, allowed: float) -> None:
    assert _allowed(np.array([one]), np.array([other])).tolist() == [allowed]


def test_a_piece_is_found_wherever_it_begins_and_not_where_a_sample_differs() -> None:
    run = _run(1)
    whole = _recording(run)
    for begin in (0, 1, 777, len(whole) - 50):
        part = {name: x[begin : begin + 50].copy() for name, x in run.items()}
        assert is_piece(_recording(part), whole)
        part["speed"][23] += 1e-3
        assert not is_piece(_recording(part), whole), "one sample is another"


def test_nothing_is_a_piece_of_what_is_shorter_or_measures_nothing_of_it() -> None:
    run = _run(1)
    shorter = {name: x[:-1] for name, x in run.items()}
    assert not is_piece(_recording(run), _recording(shorter))
    assert is_piece(_recording(run), _recording(run))
    alone = rwn.Recording(name="x", time=TIME, signals={"voltage": VOLTAGE})
    assert not is_piece(alone, _recording(run)), "runs of one profile have their input in common"
    current = rwn.Recording(name="x", time=TIME, signals={"voltage": VOLTAGE, "current": run["current"]})
    speed = rwn.Recording(name="x", time=TIME, signals={"voltage": VOLTAGE, "speed": run["speed"]})
    assert not is_piece(current, speed)


@pytest.mark.parametrize("lost", [1, 2, 3])
def test_a_piece_is_found_at_either_end_of_a_recording_a_little_longer(lost: int) -> None:
    run = _run(1)
    for rows in (slice(lost, None), slice(None, -lost)):
        assert is_piece(_recording({name: x[rows] for name, x in run.items()}), _recording(run))


def test_what_lies_half_way_may_be_rounded_either_way() -> None:
    """As programs do: away from zero, to even digits, or as the number in binary happens to lie."""
    fine, rounded = np.full(60, 0.5), np.full(60, 0.5)
    fine[:4], rounded[:4] = [0.25, 0.35, 1.25, 1.35], [0.3, 0.3, 1.3, 1.3]
    assert is_piece(_recording({"speed": rounded}), _recording({"speed": fine}))
    rounded[0] = 0.2 - 1e-3  # more than a half off
    assert not is_piece(_recording({"speed": rounded}), _recording({"speed": fine}))


def test_numbers_far_below_1_are_not_taken_for_single_precision() -> None:
    values = 1e-9 * np.array([1.0 / 3.0, 2.0 / 3.0, 4.0 / 7.0])
    made = rwn.Recording(name="x", time=np.arange(3.0), signals={"current": values})
    assert np.all(_steps(made, "current") < 1e-20)
    single = values.astype(np.float32)
    coarse = rwn.Recording(name="x", time=np.arange(3.0), signals={"current": single.astype(float)})
    np.testing.assert_allclose(_steps(coarse, "current"), np.spacing(single))


def test_an_empty_recording_is_no_piece() -> None:
    nothing = rwn.Recording(name="x", time=[], signals={"speed": []})
    assert not is_piece(nothing, _recording(_run(1)))
