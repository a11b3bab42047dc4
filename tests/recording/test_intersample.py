"""How the input acted between the rows."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.errors import InputError
from rwn.model.model import Model
from rwn.recording.intersample import INTERSAMPLE
from rwn.recording.layout import Layout

TIME = 1e-3 * np.arange(401)


def _speed(time: np.ndarray, voltage: np.ndarray, law: str = "held") -> np.ndarray:
    model = Model(kind="dc", parameters=MOTOR, recording=Layout(initial="rest", intersample=law))
    return rwn.simulate(model, rwn.Recording(name="run", time=time, signals={"voltage": voltage})).signals["speed"]


def test_a_layout_states_a_law() -> None:
    assert [Layout(intersample=law).intersample for law in INTERSAMPLE] == list(INTERSAMPLE)
    with pytest.raises(InputError, match=r"unknown law between rows 'linear'.*did you mean 'line'"):
        Layout(intersample="linear")


@pytest.mark.parametrize(("law", "every"), [("halves", 2), ("thirds", 3), ("line", 8)])
def test_kept_rows_of_a_ramp_give_the_motion_of_all_rows(law: str, every: int) -> None:
    time = 1e-3 * np.arange(24 * 20 + 1)
    voltage = 0.01 * np.arange(time.size)
    whole = _speed(time, voltage)[::every]
    kept = time[::every], voltage[::every]
    assert _speed(*kept, law) == pytest.approx(whole, abs=1e-9)
    assert np.max(np.abs(_speed(*kept) - whole)) > 0.05


def test_lost_rows_of_a_ramp_are_bridged() -> None:
    voltage = 0.01 * np.arange(TIME.size)
    kept = np.delete(np.arange(TIME.size), [50, 51, 200])
    assert _speed(TIME[kept], voltage[kept], "bridged") == pytest.approx(_speed(TIME, voltage)[kept], abs=1e-9)


def test_rows_beside_the_ticks_of_a_clock_show_the_voltage_of_the_last_tick() -> None:
    rng = np.random.default_rng(1)
    time = 1e-3 * np.arange(1601)
    voltage = np.repeat(rng.uniform(-3.0, 3.0, 161), 10)[: time.size]  # changes at every tenth tick
    off = rng.uniform(-0.3, 0.3, time.size)
    off[4::10], off[5::10], off[9::10], off[10::10] = -0.1, -0.1, 0.1, 0.1  # both ticks about a change are seen
    off[[0, -1]] = 0.0
    when = time + 1e-3 * off
    shown = voltage[np.floor(np.arange(time.size) + off).astype(int)]
    fine = np.linspace(0.0, time[-1], 20 * (time.size - 1) + 1)
    truth = np.interp(when, fine, _speed(fine, np.append(np.repeat(voltage[:-1], 20), voltage[-1])))
    right, held = (np.max(np.abs(_speed(when, shown, law) - truth)) for law in ("ticks", "held"))
    assert right < 0.2 * held


def test_rows_taken_some_time_after_each_tick_show_the_voltage_of_their_own() -> None:
    rng = np.random.default_rng(4)
    ticks = np.delete(np.arange(2000), [700])
    voltage = rng.uniform(-1.0, 1.0, 2000)
    late = rng.uniform(0.0, 0.25, ticks.size)
    acting = INTERSAMPLE["latency"].applied(1e-3 * (ticks + late - late[0]), voltage[ticks])
    assert acting is not None
    assert np.flatnonzero(acting.spread).tolist() == [700]
    known = np.delete(np.arange(2000), [700])
    assert acting.values[known].tolist() == voltage[known].tolist()
    assert acting.instants[1:] == pytest.approx(1e-3 * (np.arange(1, 2000) - late[0]), abs=2e-5)
    assert INTERSAMPLE["latency"].applied(1e-3 * ticks, voltage[ticks]) is None


def test_without_gaps_or_jitter_a_clock_says_what_rows_say() -> None:
    voltage = np.sin(20.0 * TIME)
    for law in ("bridged", "ticks"):
        assert INTERSAMPLE[law].applied(TIME, voltage) is None


@pytest.mark.parametrize("seed", range(20))
def test_a_row_too_near_a_tick_to_say_which_it_shows_says_nothing_for_certain(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ticks = np.arange(6000)
    voltage = rng.uniform(-3.0, 3.0, ticks.size)
    off = rng.uniform(-0.25, 0.25, ticks.size)
    off[0] = 0.0
    acted = INTERSAMPLE["ticks"].applied(1e-3 * (ticks + off), voltage[np.floor(ticks + off).astype(int)])
    assert acted is not None
    truth = voltage[np.rint(1e3 * acted.instants).astype(int)]
    known = acted.spread == 0.0
    assert known.sum() > 0.7 * ticks.size
    assert np.array_equal(acted.values[known], truth[known])


def test_between_rows_of_a_smooth_voltage_it_is_smooth_and_known_well() -> None:
    voltage = 5.0 * np.sin(300.0 * TIME)
    acted = INTERSAMPLE["halves"].applied(TIME[::2], voltage[::2])
    assert acted is not None
    truth = 5.0 * np.sin(300.0 * acted.instants)
    line = np.interp(acted.instants, TIME[::2], voltage[::2])
    assert np.std(acted.values - truth) < 0.15 * np.std(line - truth)
    assert np.max(acted.spread) < 0.7 * np.max(np.abs(np.diff(voltage[::2]))) / np.sqrt(12.0)


def test_a_step_between_two_rows_is_anywhere_between_them_and_nothing_beside_it() -> None:
    acted = INTERSAMPLE["halves"].applied(TIME[:8], np.repeat([1.0, 3.0], 4))
    assert acted is not None
    assert np.flatnonzero(acted.spread > 1e-12).tolist() == [7]
    assert acted.values == pytest.approx([1.0] * 7 + [2.0] + [3.0] * 7)
    assert acted.spread[7] == pytest.approx(2.0 / np.sqrt(12.0))


def test_a_sample_that_may_be_either_neighbours_is_an_unknown_by_itself() -> None:
    """Rows beside a clock, a tenth of them lost, under a voltage that is turned now and then."""
    rng = np.random.default_rng(0)
    ticks = np.flatnonzero(rng.random(400) < 0.9)
    time = 1e-3 * (ticks + 0.02 * rng.standard_normal(ticks.size))
    voltage = np.where(rng.random(400) < 0.5, 1.0, -1.0)
    found = INTERSAMPLE["ticks"].applied(time - time[0], voltage[ticks])
    assert found is not None
    assert found.gaps is not None
    unknown = found.spread > 0.0
    mixed = unknown & (found.gaps < 0)
    together = unknown[1:] & unknown[:-1] & (np.diff(found.gaps) == 0)
    assert mixed.any()
    assert together.any()
    assert not np.any(together & (mixed[1:] | mixed[:-1]))
