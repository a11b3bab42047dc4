"""Rows that lie between the samples of a clock."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from rwn.fit.nominal import nominal_of
from rwn.measurement.likeliest_law import likeliest
from rwn.model.model import Model
from rwn.model.recordings import recordings_to_fit
from rwn.recording.interpolated import between_ticks
from rwn.recording.intersample import HELD
from rwn.recording.layout import Layout

PERIOD = 2e-3
MOTOR = {"resistance": 1.0, "inductance": 2e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 2e-5,
         "viscous_friction": 2e-5}  # fmt: skip


def beside(rows: int, *, reach: float, lost: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Ticks, some of them without a row, and the rows' times about them; the first is a tick."""
    rng = np.random.default_rng(rows)
    ticks = np.sort(np.append(0, 1 + rng.permutation(rows - 1)[lost:]))
    off = rng.uniform(-reach, reach, ticks.size)
    off[[0, -1]] = 0.0
    return ticks, PERIOD * (ticks + off)


def motor(law: str, initial: str = "rest") -> Model:
    return Model(
        kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1}, recording=Layout(initial=initial, intersample=law)
    )


def recorded(*, interpolated: bool) -> rwn.Recording:
    """Of the motor, its input changing at every fifth tick, by rows beside these, with noise of samples or of rows."""
    ticks, _ = beside(3000, reach=0.3)
    rng = np.random.default_rng(7)
    voltage = np.repeat(rng.uniform(-3.0, 3.0, 600), 5)
    off = rng.uniform(-0.3, 0.1, ticks.size)
    off[::5], off[4::5] = rng.uniform(0.0, 0.3, (2, 600))  # what it changes from and to is seen
    off[[0, -1]] = 0.0
    when = PERIOD * (ticks + off)
    parts = 40  # of a period
    fine = PERIOD / parts * np.arange((ticks.size - 1) * parts + 1)
    applied = np.append(np.repeat(voltage[:-1], parts), voltage[-1])
    truth = rwn.simulate(motor(HELD), rwn.Recording(name="fine", time=fine, signals={"voltage": applied})).signals
    signals = {}
    for name, noise in (("speed", 0.02), ("current", 0.01)):
        samples = truth[name][::parts] + noise * rng.standard_normal(ticks.size)
        own = np.interp(when, fine, truth[name]) + noise * rng.standard_normal(ticks.size)
        signals[name] = np.interp(when, PERIOD * ticks, samples) if interpolated else own
    last = np.floor(when / PERIOD + 1e-9).astype(int)
    return rwn.Recording(name="run", time=when, signals={"voltage": voltage[last], **signals})


def test_samples_are_told_from_rows_between_them() -> None:
    ticks, when = beside(2000, reach=0.3, lost=20)
    samples = np.random.default_rng(1).standard_normal(2000)
    values = np.interp(when, PERIOD * np.arange(2000), samples)
    rows = between_ticks(when)
    assert rows is not None
    assert rows.ticks == pytest.approx(PERIOD * ticks, abs=0.02 * PERIOD)  # 3 deviations of a line through the times
    found, lost = rows.samples(values)
    assert np.std((found - samples[ticks])[~lost]) < 0.02
    assert 0 < lost.sum() <= 40, "lines that end at a lost sample, and no more"
    assert rows.shown(found)[~lost] == pytest.approx(values[~lost], abs=1e-9)


def test_what_was_not_measured_is_kept_out_of_the_lines_that_end_there() -> None:
    ticks, when = beside(500, reach=0.3)
    rows = between_ticks(when)
    assert rows is not None
    samples = np.sin(0.05 * ticks)
    values, missing = np.interp(when, PERIOD * ticks, samples), np.zeros(500, dtype=bool)
    values[100], missing[100] = 1e6, True
    found, lost = rows.samples(values, missing)
    assert lost[100]
    assert np.max(np.abs((found - samples)[~lost])) < 0.01


@pytest.mark.parametrize("off", [0.0, 1e-4])
def test_rows_at_the_ticks_are_the_samples(off: float) -> None:
    assert between_ticks(PERIOD * (np.arange(300) + off * np.sin(np.arange(300.0)))) is None


@pytest.mark.parametrize(("interpolated", "law"), [(True, "interpolated"), (False, "ticks")])
def test_rows_between_samples_are_told_from_samples_beside_the_clock(interpolated: bool, law: str) -> None:
    (run,) = recordings_to_fit([recorded(interpolated=interpolated)], motor(HELD))
    assert likeliest(*nominal_of([run], motor(HELD))) == law


def test_a_simulation_shows_rows_between_its_samples() -> None:
    """What is simulated under the law is what was recorded, at the rows' own times."""
    recording = recorded(interpolated=True)
    errors = {}
    for law in ("interpolated", "ticks"):
        found = rwn.simulate(motor(law), recording)
        assert np.array_equal(found.time, recording.time)
        errors[law] = np.sqrt(np.mean((found.signals["current"] - recording.signals["current"]) ** 2))
    assert errors["interpolated"] < 0.5 * errors["ticks"]


def test_a_law_taken_back_leaves_the_rows_as_they_were() -> None:
    (run,) = nominal_of([recorded(interpolated=True)], motor("interpolated"))[0].runs
    back = run.with_intersample("ticks")
    known = ~back.not_compared("current")
    assert back.time == pytest.approx(recorded(interpolated=True).time, abs=1e-12)
    assert back.current[known] == pytest.approx(recorded(interpolated=True).signals["current"][known], abs=1e-9)


@pytest.mark.parametrize(("reach", "off"), [(0.2, 0.03), (0.3, 0.07)])
def test_noise_of_rows_is_amplified_by_the_lines(reach: float, off: float) -> None:
    """Against the rows of the inverse of the equations."""
    _, when = beside(400, reach=reach)
    rows = between_ticks(when)
    assert rows is not None
    inverse = np.array([rows.samples(unit)[0] for unit in np.eye(400)]).T
    exact = np.sum(inverse**2, axis=1)
    assert rows.amplification / exact == pytest.approx(1.0, abs=5.0 * off)
    assert np.std(rows.amplification / exact) < off
    assert exact.max() > 1.5
