"""A correction of what a controller holds: found by the driving force, fitted to the free run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from rwn.correct.free_run import fitted_to_motion
from rwn.fit.driving_force import BalancedRun, DrivingForceProblem
from rwn.fit.fit import fit, fit_nominal
from rwn.fit.hypothesis import hypothesis
from rwn.fit.preparation import prepare
from rwn.prove.proof import FITTED_PART, _folds
from rwn.recording.intersample import PiecewiseInput
from rwn.simulate.recorded_run import run_of

SHEET = rwn.Model(
    kind="axis", parameters={"inertia": 0.0033, "viscous_friction": 0.06},
    uncertainty={"inertia": 0.2, "viscous_friction": 0.5},
)  # fmt: skip
TRUTH = rwn.Model(
    kind="axis", parameters={"inertia": 0.003, "viscous_friction": 0.05},
    effects={"coulomb-friction": {"coulomb_torque": 0.2}}, recording=replace(SHEET.recording, initial="estimate"),
)  # fmt: skip


def _turned() -> rwn.Recording:
    """To and fro under a torque, in motion when the recording begins; torque and position without noise."""
    time = 1e-3 * np.arange(5000)
    torque = 0.5 * np.sign(np.sin(2.0 * np.pi * 1.3 * time + 0.5)) + 0.2 * np.sin(2.0 * np.pi * 3.1 * time)
    bare = rwn.Recording(name="run", time=time, signals={"torque": torque})
    position = rwn.simulate(replace(TRUTH, recording=SHEET.recording), bare).signals["position"]
    return rwn.Recording(
        name="run", time=time[1000:] - time[1000], signals={"torque": torque[1000:], "position": position[1000:]}
    )


def test_a_run_goes_on_from_the_recorded_motion() -> None:
    run = run_of(_turned(), SHEET)
    later = run.since(1500)
    assert later.time[0] == 0.0
    assert later.time.size == run.time.size - 1500
    np.testing.assert_array_equal(later.position, run.position[1500:])
    assert later.start[1] == pytest.approx(run.motion[0][1500])
    assert later.start[2] == run.position[1500]
    assert later.input_before == run.input[1499]
    problem = prepare([_turned()], TRUTH).in_free_run()
    truth = problem.as_given()
    left = problem.on([later]).residuals(truth.vector, truth.active)[0]["position"]
    assert np.max(np.abs(left)) < 0.02 * np.ptp(later.position)  # the speed there is read off the position


def test_an_input_that_acted_otherwise_goes_on_from_the_value_it_had() -> None:
    applied = PiecewiseInput(instants=np.array([0.0, 0.4, 1.1]), values=np.array([1.0, 2.0, 3.0]), spread=np.zeros(3))
    later = applied.since(0.5)
    np.testing.assert_allclose(later.instants, [0.0, 0.6])
    np.testing.assert_array_equal(later.values, [2.0, 3.0])


def test_a_fit_to_the_motion_ends_at_the_truth_from_values_that_are_off() -> None:
    problem = prepare([_turned()], SHEET)
    assert isinstance(problem, DrivingForceProblem)
    free = problem.in_free_run()
    name = "coulomb-friction"
    begun = fit(problem, hypothesis(problem.prior, (name,), problem.scales, {name: {"coulomb_torque": 0.1}}))
    off = replace(begun, minimum=replace(begun.minimum, values=1.1 * begun.minimum.values))
    found = fitted_to_motion(free, problem.whole, off, name)
    assert found.value("inertia") == pytest.approx(0.003, rel=0.01)
    assert found.value(f"{name}.coulomb_torque") == pytest.approx(0.2, rel=0.01)


def test_the_last_part_of_a_lone_recording_is_left_out_of_the_balance_of_its_forces_too() -> None:
    problem = prepare([_turned()], SHEET)
    ((fitted, _, first),) = _folds(problem)
    (run,) = fitted.runs
    assert isinstance(run, BalancedRun)
    assert run.time[-1] <= problem.whole[0].time[first]
    assert run.time.size == int(FITTED_PART * problem.runs[0].time.size)
    assert fit_nominal(fitted).cost < fit_nominal(problem).cost
