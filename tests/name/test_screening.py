"""Which starts of a search are followed, and how far."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from rwn.fit.levenberg_marquardt import FitStatus, Minimum
from rwn.fit.preparation import Setup, prepare
from rwn.fit.problem import OutputError
from rwn.model.model import Model
from rwn.name.forward import _begun, explain
from rwn.name.screening import ASTRAY, HARDLY, IN_PASSING, TO_THE_END, Search
from rwn.name.starts import Racer, Row

TRUE = {
    "resistance": 0.84, "inductance": 1e-4, "torque_constant": 0.116, "back_emf_constant": 0.116, "inertia": 3.84e-4,
    "viscous_friction": 6e-5, "coulomb_friction": 0.02,
}  # fmt: skip
SHEET = {
    **TRUE, "resistance": 0.69, "torque_constant": 0.118, "back_emf_constant": 0.118, "inertia": 4.1e-4,
    "viscous_friction": 1.7e-4, "coulomb_friction": 0.018,
}  # fmt: skip
UNCERTAIN = {
    "resistance": 0.2, "torque_constant": 0.06, "back_emf_constant": 0.06, "inertia": 0.34, "viscous_friction": 0.8,
    "coulomb_friction": 0.46,
}  # fmt: skip
LAG = 0.0124  # half of the motor's own 24 ms


@pytest.fixture(scope="module")
def lagging() -> Setup:
    """Voltage, and a speed that lags: as far as dry friction lets it, lag and time constant may change places."""
    time, rng = 1e-3 * np.arange(4400.0), np.random.default_rng(9)
    steps = np.repeat(rng.uniform(-20.0, 20.0, 22), 200)
    runs = []
    for name, voltage in (("steps", steps), ("sweep", 18.0 * np.sin(2.0 * np.pi * (0.3 + 0.2 * time) * time))):
        run = rwn.Recording(name=name, time=time, signals={"voltage": voltage})
        plant = Model(kind="dc", parameters=TRUE, effects={"speed-sensor-lag": {"time_constant": LAG}})
        seen = rwn.simulate(plant, run)
        speed = seen.signals["speed"] + 0.08 * rng.standard_normal(time.size)
        runs.append(rwn.Recording(name=name, time=time, signals={"voltage": voltage, "speed": speed}))
    return prepare(runs, Model(kind="dc", parameters=SHEET, uncertainty=UNCERTAIN))


def test_a_lag_that_has_changed_places_with_the_motor_is_found_in_its_own(lagging: Setup) -> None:
    found = explain(lagging, progress=lambda *_: None, names=["speed-sensor-lag", "input-delay", "actuator-deadzone"])
    best = found.hypotheses[0].fitted
    assert best.added == ("speed-sensor-lag",)
    assert best.values_of("speed-sensor-lag")["time_constant"] == pytest.approx(LAG, rel=0.01)
    assert found.left.at_the_floor


def test_starts_of_a_drives_end_compete_per_first_guess_of_the_motor(lagging: Setup) -> None:
    search = Search.of(lagging)
    bent = search.fit_nominal()
    kinds = {name: {r.begin for r in search._starts(bent, name, orders=3)} for name in ("speed-sensor-lag", "backlash")}
    assert kinds == {"speed-sensor-lag": {0, 1}, "backlash": {0}}


@pytest.mark.parametrize("late", [0.4, 0.85, 0.95, 1.5, 2.5, 2.8, 6.0])
def test_a_delay_of_any_part_of_a_sample_is_found_where_the_winding_is_fast(late: float) -> None:
    """The current follows a step within a seventh of a sample: the error has a minimum in every one."""
    fast = {**TRUE, "resistance": 12.0, "inductance": 1.67e-3, "torque_constant": 0.0113, "back_emf_constant": 0.0113,
            "inertia": 4.7e-7, "viscous_friction": 3.6e-7, "coulomb_friction": 0.0}  # fmt: skip
    time, rng = 1e-3 * np.arange(3000.0), np.random.default_rng(3)
    run = rwn.Recording(name="prbs", time=time, signals={"voltage": np.repeat(rng.choice([-4.0, 4.0], 75), 40)})
    seen = rwn.simulate(Model(kind="dc", parameters=fast, effects={"input-delay": {"delay": 1e-3 * late}}), run).signals
    noise = {"current": 5e-4, "speed": 1.8}
    signals = {s: seen[s] + level * rng.standard_normal(time.size) for s, level in noise.items()}
    uncertainty = dict.fromkeys(fast, 0.06) | {"inductance": 0.0, "coulomb_friction": 0.0}
    sheet = Model(kind="dc", parameters={**fast, "inertia": 4.8e-7}, uncertainty=uncertainty)
    search, nominal = _begun(prepare([replace(run, signals={**run.signals, **signals})], sheet))
    found = search.explain(nominal, ["input-delay"])[0]
    assert found.value("input-delay.delay") == pytest.approx(1e-3 * late, abs=2e-5)


@pytest.mark.parametrize(("factor", "astray"), [(1.0, False), (1.02, False), (1.2, True)])
def test_a_start_that_a_glance_has_led_far_astray_goes_on_from_where_it_began(
    lagging: Setup, factor: float, astray: bool
) -> None:
    search = Search.of(lagging)
    before = search._starts(search.fit_nominal(), "quadratic-drag", orders=3)[0]
    values = before.candidate.start.copy()
    values[0] *= factor
    after = before._replace(candidate=before.candidate.starting_at(values))
    errors = [search.problem.error(r.candidate.vector, r.candidate.active) for r in (after, before)]
    assert errors[0] >= errors[1]
    assert (errors[0] > ASTRAY * errors[1]) == astray
    assert search._not_astray([(after, before)], search.problem) == [before if astray else after]


ON_LOOK, ON_ALL = "look", "all"


@pytest.mark.parametrize(
    ("raced", "later", "known", "legs"),
    [
        ((100.0, 30.0), {}, np.inf, [(ON_LOOK, IN_PASSING), (ON_ALL, TO_THE_END)]),
        ((100.0, 90.0), {}, np.inf, [(ON_ALL, HARDLY)]),
        ((1000.0, 400.0), {}, np.inf, [(ON_LOOK, IN_PASSING), (ON_ALL, TO_THE_END)]),
        ((1000.0, 400.0), dict.fromkeys((ON_LOOK, ON_ALL), (400.0, 390.0)), np.inf,
         [(ON_LOOK, IN_PASSING), (ON_ALL, HARDLY)]),
        ((100.0, 90.0), {ON_ALL: (60.0, 30.0)}, np.inf, [(ON_ALL, HARDLY), (ON_ALL, TO_THE_END)]),
        ((50.0, 30.0), {}, 2.0, [(ON_ALL, HARDLY)]),
    ],
    ids=["near the best", "hopeless", "hopeless as yet, and falling", "fell no further", "not hopeless on all",
         "a better is known"],
)  # fmt: skip
def test_a_race_goes_on_with_what_may_still_win(
    lagging: Setup, monkeypatch: pytest.MonkeyPatch, raced: tuple[float, float],
    later: dict[str, tuple[float, float]], known: float, legs: list[tuple[str, int]],
) -> None:  # fmt: skip
    """`raced`, `later`: first and last cost of another's legs, where the best has come to 10, as raced if not given."""
    search = Search.of(lagging)
    look = search.part(search.fit_nominal(), 100)
    fitted = search.fit_nominal()
    best, other = (Racer(name, 0.0, 0, fitted.candidate) for name in ("best", "other"))
    done = replace(fitted.minimum, status=FitStatus.CONVERGED, cost=10.0, first=20.0)

    def under_way(costs: tuple[float, float]) -> Minimum:
        return replace(fitted.minimum, status=FitStatus.ITERATION_LIMIT, first=costs[0], cost=costs[1], iterations=1)

    run: list[tuple[str, int]] = []

    def leg(
        _: Search, racer: Racer, iterations: int, problem: OutputError | None = None, *, share: float
    ) -> Row:
        assert share > 0.0
        if racer is best:
            return racer, done
        run.append((ON_LOOK if problem is look else ON_ALL, iterations))
        if iterations == TO_THE_END:
            return racer, replace(done, cost=raced[1])
        return racer, under_way(later.get(run[-1][0], raced))

    monkeypatch.setattr(Search, "_leg", leg)
    search._to_the_end([(best, done), (other, under_way(raced))], look, best_here=known, best=known)
    assert run == legs


def test_the_next_leg_starts_where_the_last_one_ended_and_tries_nothing_again_that_was_refused(lagging: Setup) -> None:
    search = Search.of(lagging)
    fitted = search.fit_nominal()
    racer = Racer("lag", 0.0, 0, fitted.candidate)
    again = racer.after(replace(fitted.minimum, values=1.1 * fitted.minimum.values, damping=0.5))
    np.testing.assert_array_equal(again.candidate.start, 1.1 * fitted.minimum.values)
    assert (again.name, again.order, again.begin, again.damping) == ("lag", 0.0, 0, 0.5)
    assert racer.after(replace(fitted.minimum, damping=1e-9)).damping == racer.damping  # no bolder than at first


def test_a_model_that_is_exact_is_adequate() -> None:
    """What rwn simulates itself leaves nothing at all: an error of exactly zero."""
    voltage = np.repeat(np.random.default_rng(1).uniform(-10.0, 10.0, 10), 100)
    run = rwn.Recording(name="own", time=1e-3 * np.arange(1000.0), signals={"voltage": voltage})
    model = Model(kind="dc", parameters=TRUE)
    seen = rwn.simulate(model, run).signals
    signals = {"voltage": voltage, "current": seen["current"], "speed": seen["speed"]}
    assert rwn.diagnose([replace(run, signals=signals)], model).verdict == "adequate"
