"""An axis whose motion a stiff loop holds is judged by the force that this took."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from rwn.fit.driving_force import BalancedRun, DrivingForceProblem, balanced
from rwn.fit.fit import fit_nominal
from rwn.fit.preparation import prepare
from rwn.fit.residuals import statistics
from rwn.recording.intersample import INTERSAMPLE
from rwn.recording.smoothing import LENGTHS
from rwn.simulate.run import Run

INERTIA, VISCOUS, COULOMB, COGGING, ORDER = 0.003, 0.05, 0.2, 0.3, 12
STEP = 1e-3
SHEET = rwn.Model(
    kind="axis",
    parameters={"inertia": 0.0033, "viscous_friction": 0.06, "coulomb_friction": 0.17},
    uncertainty={"inertia": 0.2, "viscous_friction": 0.5, "coulomb_friction": 0.3},
)


def held(seed: int, *, cogging: float = COGGING) -> rwn.Recording:
    """A slow turn there and back under a position loop, in motion when the recording begins: torque and position."""
    rng = np.random.default_rng(seed)
    rows = int(6.0 / STEP)
    angle, speed, kept = 0.0, 0.0, []
    for k in range(-500, rows):
        wanted = 1.5 * np.cos(0.9 * k * STEP + seed)
        target = 1.5 / 0.9 * np.sin(0.9 * k * STEP + seed)
        torque = 60.0 * (target - angle) + 1.2 * (wanted - speed) if k > -500 else 0.0
        if k == -500:
            angle, speed = target, wanted
        kept.append((k * STEP, torque, angle))
        lost = VISCOUS * speed + COULOMB * np.tanh(speed / 1e-3) + cogging * np.sin(ORDER * angle + 0.4)
        speed += STEP * (torque - lost) / INERTIA
        angle += STEP * speed
    time, torque, angle_ = np.array(kept[500:]).T
    counted = 2.0 * np.pi / 65536 * np.round(angle_ * 65536 / (2.0 * np.pi))
    noisy = torque + 0.01 * rng.standard_normal(torque.size)
    return rwn.Recording(name=f"run {seed}", time=time, signals={"torque": noisy, "position": counted})


def test_derivatives_are_those_of_the_squared_error() -> None:
    problem = prepare([held(1)], SHEET)
    assert isinstance(problem, DrivingForceProblem)
    this = problem.as_given()
    found = problem.normal(this.vector, this.active, this.by)
    known = [k for k, place in enumerate(this.by) if this.vector[place]]  # the others are starts, which do not count
    assert len(known) == len(SHEET.uncertainty)
    for k in known:
        place = this.by[k]
        step = 1e-3 * this.vector[place]
        ends = []
        for sign in (1.0, -1.0):
            there = this.vector.copy()
            there[place] += sign * step
            ends.append(problem.error(there, this.active))
        assert -2.0 * found.gradient[k] == pytest.approx((ends[0] - ends[1]) / (2.0 * step), rel=1e-4)


def test_what_a_sound_axis_leaves_is_noise() -> None:
    problem = prepare([held(1, cogging=0.0)], SHEET)
    left = statistics(problem, fit_nominal(problem))
    assert left.at_the_floor
    assert left.count == sum(isinstance(r, BalancedRun) and r.time.size for r in problem.runs)


@pytest.mark.slow
def test_a_position_that_is_updated_less_often_is_bridged_and_lost_ones_are_not_compared() -> None:
    whole, recorded = prepare([held(1)], SHEET), held(1)
    lacking = np.arange(recorded.time.size) % 2 == 1
    lacking[1000:1300] = True
    last = np.maximum.accumulate(np.where(lacking, 0, np.arange(lacking.size)))
    signals = {**recorded.signals, "position": recorded.signals["position"][last]}
    given = rwn.Recording(name="held", time=recorded.time, signals=signals, missing={"position": lacking})
    problem = prepare([given], SHEET)
    (run,) = problem.runs
    assert isinstance(run, BalancedRun)
    compared = ~run.missing["driving force"]
    assert 0.9 < np.mean(compared) < 0.97
    assert np.isfinite(run.acceleration[compared]).all()
    assert problem.noise["driving force"].level < 1.3 * whole.noise["driving force"].level


def test_cogging_is_named_by_the_force_of_a_position_loop() -> None:
    found = rwn.diagnose([held(1)], SHEET, heldout=[held(2)])
    assert [e.name for e in found.effects] == ["cogging-torque"]
    values = found.effects[0].parameters
    assert values["periods_per_rev"].value == pytest.approx(ORDER, rel=0.01)
    assert values["amplitude"].value == pytest.approx(COGGING, rel=0.1)
    force = next(r for r in found.heldout if r.signal == "driving force" and r.region == "all")
    assert force.corrected is not None
    assert force.corrected < 0.25 * force.refitted


@pytest.mark.parametrize(("rate", "noise", "length"), [(500.0, 1e-9, LENGTHS[-1]), (20.0, 1e-4, LENGTHS[0])])
def test_what_is_smoothed_away_of_the_force_and_the_noise_of_the_acceleration_are_weighed(
    rate: float, noise: float, length: int
) -> None:
    """An exact force that changes within some rows or many, and the noise of a position."""
    time = STEP * np.arange(4000)
    position = np.sin(30.0 * time) + noise * np.random.default_rng(5).standard_normal(time.size)
    run = Run(name="run", time=time, input=np.sin(rate * time), position=position)
    assert np.median(np.diff(balanced(run, 1e-3).time)) == pytest.approx(length * STEP)


def test_a_balance_stays_as_it_is_whatever_the_law_between_rows() -> None:
    """Also where its thinned rows lie beside the ticks of a clock."""
    time = STEP * (np.arange(2000) + 0.2 * np.abs(np.random.default_rng(8).standard_normal(2000)))
    run = Run(name="run", time=time, input=np.sin(9.0 * time), position=np.sin(2.0 * time), angle=np.sin(2.0 * time))
    of = balanced(run, 1e-3)
    assert all(of.with_intersample(law) is of for law in INTERSAMPLE)
