"""First guesses that are read off a residual."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import AXIS, MOTOR, slow_axis
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.name.initial_guesses import spectra


@pytest.fixture(scope="module")
def rippled() -> Problem:
    """Half of the motor constant comes and goes nine times a revolution, and the data sheet is off."""
    time = 1e-3 * np.arange(3000)
    voltage = 6.0 * np.sin(2 * np.pi * 1.1 * time) + 3.0 * np.sin(2 * np.pi * 2.7 * time)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    ripple = {"amplitude": 0.5, "harmonic": 9.0, "phase": 0.3}
    seen = rwn.simulate(Model(kind="dc", parameters=MOTOR, effects={"torque-ripple": ripple}), run).signals
    rng = np.random.default_rng(5)
    noisy = {s: seen[s] + 0.01 * np.std(seen[s]) * rng.standard_normal(time.size) for s in ("current", "speed")}
    sheet = {**MOTOR, "resistance": 0.9, "back_emf_constant": 0.09, "torque_constant": 0.09}
    recording = replace(run, signals={"voltage": voltage, **noisy})
    return prepare([recording], Model(kind="dc", parameters=sheet, uncertainty={"inertia": 0.1}))


def test_a_ripple_of_the_flux_shows_in_the_windings_voltage(rippled: Problem) -> None:
    start = rippled.as_given()
    grid = spectra.order_grid(rippled)
    shares = spectra.flux_spectrum(rippled, start.vector, grid)
    assert spectra.orders_of(shares, grid, 1) == [9.0]
    assert shares[grid == 9.0] > 0.8
    assert np.max(shares[np.abs(grid - 9.0) > 3.0]) < 0.2


def test_what_the_motor_constants_could_take_is_no_ripple(rippled: Problem) -> None:
    """Another R and Ke change the voltage that is left, not what is seen beside them."""
    grid, start = np.array([9.0]), rippled.as_given().vector
    other = start.copy()
    other[:4] = [0.5, 2e-3, 0.1, 0.12]
    one, two = (spectra.flux_spectrum(rippled, vector, grid)[0] for vector in (start, other))
    assert one == pytest.approx(two, rel=1e-6)


def test_cogging_shows_in_the_torque_where_the_free_run_is_lost() -> None:
    """A slow axis stops and breaks away elsewhere than its model without the detents, and is then off for good."""
    problem = prepare([slow_axis(cogging=0.09, periods=24.0)], AXIS)
    found = spectra.read(problem, problem.as_given(), problem.prior.table["cogging-torque"], 1)
    assert found is not None
    assert found[0] == {"periods_per_rev": 24.0}
    grid, given = spectra.order_grid(problem), problem.as_given().vector
    by_free_run = spectra.angle_spectrum(problem, given, problem.residuals(given, []), grid)
    assert spectra.orders_of(by_free_run, grid, 1) != [24.0]


def test_a_ripple_shows_in_the_winding_where_only_a_position_tells_the_motion() -> None:
    """At an even speed it turns little current into torque, but all of the back-EMF into current."""
    time = 5e-4 * np.arange(6000)
    voltage = 6.0 * np.abs((0.9 * time) % 2.0 - 1.0) - 3.0  # slow triangles
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    small = {**MOTOR, "resistance": 2.3, "torque_constant": 0.0234, "back_emf_constant": 0.0234, "inertia": 2e-5}
    ripple = {"amplitude": 0.06, "harmonic": 10.0, "phase": 0.7}
    seen = rwn.simulate(Model(kind="dc", parameters=small, effects={"torque-ripple": ripple}), run).signals
    counted = {s: np.round(seen[s] / step) * step for s, step in (("current", 0.003), ("position", 0.00314))}
    model = Model(kind="dc", parameters=small, uncertainty={"inertia": 0.1, "resistance": 0.05})
    problem = prepare([replace(run, signals={"voltage": voltage, **counted})], model)
    found = spectra.read(problem, problem.as_given(), problem.prior.table["torque-ripple"], 1)
    assert found == [{"harmonic": 10.0}]
    given, grid = problem.as_given().vector, spectra.order_grid(problem)
    by_torque = spectra.torque_spectrum(problem, given, [], grid)
    assert spectra.orders_of(by_torque, grid, 1) != [10.0]
