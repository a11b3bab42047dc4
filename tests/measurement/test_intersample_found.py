"""The law by which the input acted between the rows, read off recordings."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.fit.fit import fit, refit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.nominal import nominal_of
from rwn.fit.refitting import under_own_noise
from rwn.fit.residuals import loss_gained, statistics
from rwn.measurement import likeliest_law
from rwn.measurement.beside_filters import losses_beside
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered
from rwn.measurement.likeliest_law import likeliest, likeliest_with_filters, stating, with_intersample, without_unknown
from rwn.measurement.likelihood import DECISIVE, log_likelihood
from rwn.measurement.unrecorded_input import with_unrecorded_input
from rwn.model.model import Model
from rwn.recording.layout import Layout

MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "viscous_friction": 0.1})


def _run(*, friction: float = 0.0) -> rwn.Recording:
    """Noisy speed under a voltage that moves from row to row."""
    rng, time = np.random.default_rng(5), 1e-3 * np.arange(3000)
    voltage = 3.0 * np.sin(2 * np.pi * (2.0 * time + 4.0 * time**2))
    truth = rwn.Model(kind="dc", parameters=MOTOR, effects={"coulomb-friction": {"coulomb_torque": friction}})
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(truth, bare).signals["speed"] + 0.05 * rng.standard_normal(time.size)
    return rwn.Recording(name="run", time=time, signals={"voltage": voltage, "speed": speed})


def _kept(run: rwn.Recording, rows: np.ndarray | slice) -> rwn.Recording:
    return rwn.Recording(name="run", time=run.time[rows], signals={n: x[rows] for n, x in run.signals.items()})


def test_a_voltage_that_was_noted_a_row_late_is_told_from_one_that_moved_on_lines() -> None:
    """All that was measured is then a row early; half a row of it a line between the rows makes up for."""
    run = _run()
    late = np.append(run.signals["voltage"][0], run.signals["voltage"][:-1])
    found = with_intersample([replace(run, signals={**run.signals, "voltage": late})], MODEL)
    assert found.recording.intersample == "noted-late"


@pytest.mark.parametrize(("every", "law"), [(1, "held"), (2, "halves"), (3, "thirds")])
def test_thinned_rows_are_told_from_whole_ones(every: int, law: str) -> None:
    found = with_intersample([_kept(_run(), slice(None, None, every))], MODEL)
    assert found.recording.intersample == law


@pytest.mark.parametrize(
    ("every", "at_first", "law"), [(1, "held", "held"), (2, "thirds", "halves"), (3, "thirds", "thirds")]
)
def test_thinned_rows_are_told_from_whole_ones_also_beneath_missing_physics(
    every: int, at_first: str, law: str
) -> None:
    """How thin they are, once that is known: a diagnosis asks again under its best explanation."""
    run = _kept(_run(friction=5e-3), slice(None, None, every))
    found = with_intersample([run], MODEL)
    assert found.recording.intersample == at_first
    problem, _ = nominal_of([run], found)
    start = {"coulomb-friction": {"coulomb_torque": 4e-3}}
    explained = fit(problem, hypothesis(problem.prior, tuple(start), problem.scales, start))
    bare, _ = nominal_of([run], stating(MODEL, "held"))
    assert likeliest_with_filters(bare, explained, at_first)[0] == law


def test_a_filter_is_told_from_thinned_rows_beside_what_was_found_under_these() -> None:
    """Both make the speed follow the voltage of other rows: the law by itself was chosen before there were filters."""
    run = _run(friction=5e-3)
    filtered = lfilter([0.45], [1.0, -0.55], run.signals["speed"])
    run = replace(run, signals={**run.signals, "speed": filtered})
    bare, _ = nominal_of([run], stating(MODEL, "held"))
    start = {"coulomb-friction": {"coulomb_torque": 4e-3}}
    explained = fit(bare, hypothesis(bare.prior, tuple(start), bare.scales, start))
    assert likeliest_with_filters(bare, explained, "thirds")[0] == "held"


def test_a_latency_is_found_beneath_a_filter_that_hides_it() -> None:
    """Of the filtered speed another law is likelier; once the filter is undone, it no longer is."""
    rng, fine, kept = np.random.default_rng(3), 8, 0.8
    time = 1e-3 / fine * np.arange(3000 * fine)
    voltage = np.repeat(np.repeat(rng.uniform(-3.0, 3.0, 60), 50), fine)
    every = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    taken = fine * np.arange(3000) + np.append(0, rng.integers(0, 3, 2999))
    made = {s: x[taken] for s, x in rwn.simulate(MODEL, every).signals.items() if s in ("speed", "current")}
    noisy = {s: x + 0.01 * np.std(x) * rng.standard_normal(x.size) for s, x in made.items()}
    noisy["speed"] = lfilter([1.0 - kept], [1.0, -kept], noisy["speed"])
    run = rwn.Recording(name="run", time=time[taken], signals={"voltage": voltage[taken], **noisy})
    bare, nominal = nominal_of([run], stating(MODEL, "held"))
    assert likeliest(bare, nominal) != "latency"
    filtered = SensorFilter(signal="speed", share=kept, time_constant=-1e-3 / np.log(kept), digital=True)
    for known in ((), (filtered,)):
        found, filters = likeliest_with_filters(bare, nominal, "held", known)
        assert found == "latency"
        (of_speed,) = (f for f in filters if f.signal == "speed")
        assert of_speed.time_constant == pytest.approx(filtered.time_constant, rel=0.05)


def test_a_law_that_the_free_run_refuses_is_not_taken() -> None:
    """The steps of the voltage reach the speed's cable: what is new in a row goes with the voltage of that row."""
    rng, time = np.random.default_rng(5), 1e-3 * np.arange(3000)
    voltage = 3.0 * np.sign(np.sin(2 * np.pi * (2.0 * time + 4.0 * time**2))) + 0.05 * rng.standard_normal(time.size)
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    truth = rwn.Model(kind="dc", parameters=MOTOR, effects={"coulomb-friction": {"coulomb_torque": 4e-3}})
    picked_up = 1.5 * np.diff(voltage, prepend=0.0) + 0.05 * rng.standard_normal(time.size)
    speed = rwn.simulate(truth, bare).signals["speed"] + picked_up
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage, "speed": speed})
    problem, held = nominal_of([run], stating(MODEL, "held"))
    halves = replace(problem, runs=tuple(r.with_intersample("halves") for r in problem.runs))
    other = refit(held, halves)
    assert log_likelihood(halves, other) > log_likelihood(problem, held) + DECISIVE
    assert likeliest(problem, held) == "held"


def test_a_loss_gained_is_none_between_the_same_and_changes_sign_with_the_order() -> None:
    time = 1e-3 * np.arange(3000)
    voltage = np.random.default_rng(7).uniform(-3.0, 3.0, time.size)
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(MODEL, bare).signals["speed"]
    whole = rwn.Recording(name="run", time=time, signals={"voltage": voltage, "speed": speed})
    problem, held = nominal_of([_kept(whole, slice(None, None, 2))], stating(MODEL, "held"))
    halves = replace(problem, runs=tuple(r.with_intersample("halves") for r in problem.runs))
    other = refit(held, halves)
    as_held, as_halves = losses_beside(problem, held, ()), losses_beside(halves, other, ())
    assert loss_gained(as_held, as_held) == 0.0
    assert loss_gained(as_held, as_halves) < -3.0  # every second row was kept
    assert loss_gained(as_halves, as_held) == -loss_gained(as_held, as_halves)


def test_lost_rows_are_bridged_where_the_voltage_went_on_moving() -> None:
    lost = np.random.default_rng(2).random(3000) < 0.05
    lost[0] = False
    assert with_intersample([_kept(_run(), np.flatnonzero(~lost))], MODEL).recording.intersample == "bridged"


def test_what_a_layout_states_stands() -> None:
    stated = Model(kind="dc", parameters=MOTOR, recording=Layout(intersample="line"))
    assert with_intersample([_run()], stated) is stated


def test_currents_beside_a_step_between_the_rows_are_not_compared() -> None:
    rng, time = np.random.default_rng(6), 1e-3 * np.arange(4000)
    voltage = np.repeat(rng.uniform(-3.0, 3.0, 80), 50)
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    clean = rwn.simulate(MODEL, bare).signals
    noisy = {s: clean[s] + 0.01 * rng.standard_normal(time.size) for s in ("speed", "current")}
    kept = _kept(rwn.Recording(name="run", time=time, signals={"voltage": voltage, **noisy}), slice(1, None, 2))
    (found,) = without_unknown([kept], stating(MODEL, "halves"))
    steps = np.flatnonzero(np.abs(np.diff(kept.signals["voltage"], prepend=kept.signals["voltage"][0])) > 0.5)
    assert set(steps) <= set(np.flatnonzero(found.missing["current"]))
    assert found.missing["current"].mean() < 0.05
    assert without_unknown([kept], stating(MODEL, "held")) == [kept]


@pytest.mark.parametrize(("period", "law"), [(1.6e-3, "rounded"), (2.5e-3, "rounded"), (2e-3, "held")])
def test_times_that_are_written_in_milliseconds_are_told_from_the_ticks_behind_them(period: float, law: str) -> None:
    time = period * np.arange(3000)
    voltage = 3.0 * np.sin(2 * np.pi * (0.5 * time + time**2))
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(MODEL, bare).signals["speed"] + 0.05 * np.random.default_rng(0).standard_normal(time.size)
    run = rwn.Recording(name="run", time=np.round(time, 3), signals={"voltage": voltage, "speed": speed})
    found = with_intersample([run], MODEL)
    assert found.recording.intersample == law
    assert np.std(rwn.simulate(found, run).signals["speed"] - speed) < 0.06


@pytest.mark.parametrize("law", ["stamped", "held"])
def test_times_that_were_noted_unevenly_are_told_from_rows_that_were_taken_so(law: str) -> None:
    rng = np.random.default_rng(3)
    even = 1e-3 * np.arange(3000)
    noted = even + 3e-5 * rng.standard_normal(even.size)
    voltage = np.repeat(rng.uniform(-3.0, 3.0, 300), 10)
    taken = even if law == "stamped" else noted - noted[0]
    bare = rwn.Recording(name="run", time=taken, signals={"voltage": voltage})
    speed = rwn.simulate(MODEL, bare).signals["speed"] + 0.02 * rng.standard_normal(even.size)
    run = rwn.Recording(name="run", time=noted - noted[0], signals={"voltage": voltage, "speed": speed})
    found = with_intersample([run], MODEL)
    assert found.recording.intersample == law
    assert np.std(rwn.simulate(found, run).signals["speed"] - speed) < 0.022


def test_a_simulation_that_ran_away_is_certainly_worse_than_one_that_did_not() -> None:
    stayed = np.ones(100)
    ran_away = np.where(np.arange(100) < 50, 1.0, 1e200)  # its square is no number
    assert loss_gained(stayed, ran_away) == np.inf
    assert loss_gained(ran_away, stayed) == -np.inf
    assert loss_gained(ran_away, ran_away) == 0.0


def _swept_and_stepped(filter_share: float = 0.0) -> list[rwn.Recording]:
    """Every second row of a drive whose voltage is swept in one recording, and in the other steps at any of its ticks.

    `filter_share`: of a filter of the speed, from tick to tick.
    """
    rng, time = np.random.default_rng(8), 5e-4 * np.arange(6000)
    ends = np.cumsum(rng.integers(60, 300, 100))
    swept = 3.0 * np.sin(2 * np.pi * (0.2 + 5.0 * time) * time)
    stepped = rng.uniform(-4.0, 4.0, 100)[np.searchsorted(ends, np.arange(time.size), side="right")]
    kept = []
    for name, voltage in (("swept", swept), ("stepped", stepped)):
        bare = rwn.Recording(name=name, time=time, signals={"voltage": voltage})
        moved = rwn.simulate(MODEL, bare).signals
        shown = {"current": moved["current"] + 0.02 * rng.standard_normal(time.size)}
        speed = moved["speed"] + 0.3 * rng.standard_normal(time.size)
        shown["speed"] = lfilter([1.0 - filter_share], [1.0, -filter_share], speed)
        kept.append(_kept(replace(bare, signals={"voltage": voltage, **shown}), slice(None, None, 2)))
    return kept


def test_steps_at_any_tick_beside_a_sweep_are_told_by_when_the_motion_has_them() -> None:
    """With each step in the middle of what its rows show, that it moved three times from row to row is likelier."""
    assert with_intersample(_swept_and_stepped(), MODEL).recording.intersample == "halves"


def test_a_filter_beside_thinned_rows_is_that_of_the_drives_own_ticks() -> None:
    """One of the rows lags by half a tick less than one of twice as many: a delay makes up for the rest."""
    share = 0.85
    runs = _swept_and_stepped(share)
    bare, nominal = nominal_of(runs, stating(MODEL, "held"))
    law, (of_speed,) = likeliest_with_filters(bare, nominal, "held")
    assert (law, of_speed.signal, of_speed.digital) == ("halves", "speed", True)
    assert of_speed.time_constant == pytest.approx(-5e-4 / np.log(share), rel=0.03)
    stated = stating(MODEL, law)
    on, _ = nominal_of(with_unrecorded_input(runs, stated, nominal, filters=[of_speed]), stated)
    problem, this = under_own_noise(nominal, filtered(on, [of_speed]))
    assert statistics(problem, this).at_the_floor


def test_filters_under_a_law_that_leaves_no_input_unknown_are_looked_for_once(monkeypatch: pytest.MonkeyPatch) -> None:
    looked_for = []

    def found(*_: object) -> tuple[tuple[SensorFilter, ...], float]:
        looked_for.append(1)
        return (SensorFilter(signal="speed", share=0.5, time_constant=1e-3, digital=True),), 0.0

    monkeypatch.setattr(likeliest_law, "filters_and_likelihood", found)
    bare, nominal = nominal_of([_run()], stating(MODEL, "held"))
    halves = replace(bare, runs=tuple(r.with_intersample("halves") for r in bare.runs))
    for problem, times in ((bare, 1), (halves, 2)):
        looked_for.clear()
        likeliest_law._with_filters(problem, nominal, ())
        assert len(looked_for) == times
