"""Which starts of a search are followed, and how far."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import rwn
from ranked import ranked
from rwn.fit.fit import BRIEFLY, TO_THE_END, Fit, fit, fit_nominal
from rwn.fit.hypothesis import hypothesis
from rwn.fit.levenberg_marquardt import FitStatus
from rwn.fit.nominal import weighted_by_nominal
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.screening_part import part
from rwn.model.model import Model
from rwn.name import screening
from rwn.name.forward import _weighted_beforehand
from rwn.name.screening import FURTHER, _further, _has_room, _to_the_end, screen
from rwn.name.starts import FittedStart, Start, starts

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
def lagging() -> Problem:
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


def test_a_lag_that_has_changed_places_with_the_motor_is_found_in_its_own(lagging: Problem) -> None:
    ranking = ranked(lagging, ["speed-sensor-lag", "input-delay", "actuator-deadzone"])
    best = ranking.fits[0].fit
    assert best.added == ("speed-sensor-lag",)
    assert best.values_of("speed-sensor-lag")["time_constant"] == pytest.approx(LAG, rel=0.01)
    assert ranking.left.at_the_floor


def test_starts_of_a_drives_end_compete_per_first_guess_of_the_motor(lagging: Problem) -> None:
    bent = fit_nominal(lagging)
    names = ("speed-sensor-lag", "backlash")
    kinds = {name: {s.motor for s in starts(lagging, bent, name, orders=3)} for name in names}
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
    problem, nominal = _weighted_beforehand(prepare([replace(run, signals={**run.signals, **signals})], sheet))
    found = screen(problem, nominal, ["input-delay"])[0]
    assert found.value("input-delay.delay") == pytest.approx(1e-3 * late, abs=2e-5)


@pytest.mark.parametrize(
    ("came", "briefly", "known", "legs"),
    [
        ((100.0, 30.0), None, np.inf, [TO_THE_END]),
        ((100.0, 90.0), None, np.inf, [BRIEFLY]),
        ((1000.0, 400.0), None, np.inf, [TO_THE_END]),
        ((100.0, 90.0), (60.0, 30.0), np.inf, [BRIEFLY, TO_THE_END]),
        ((50.0, 30.0), None, 2.0, [BRIEFLY]),
    ],
    ids=["near the best", "far behind", "far behind as yet, and falling", "not far behind on all", "a better is known"],
)  # fmt: skip
def test_a_fit_goes_on_to_the_end_where_it_may_still_win(
    lagging: Problem, monkeypatch: pytest.MonkeyPatch, came: tuple[float, float],
    briefly: tuple[float, float] | None, known: float, legs: list[int],
) -> None:  # fmt: skip
    """`came`, `briefly`: first and last cost on the part, and of a brief leg on all if not `came`; the best has 10."""
    nominal = fit_nominal(lagging)
    best, other = (Start(name, 0.0, 0, nominal.hypothesis) for name in ("best", "other"))
    gone: list[int] = []

    def attempt(start: Start, iterations: int, on: Problem, *, share: float) -> FittedStart:
        assert share > 0.0
        assert on is lagging
        if start is best:
            return FittedStart(start, _ended(nominal, (20.0, 10.0)))
        gone.append(iterations)
        ended = _ended if iterations == TO_THE_END else _under_way
        return FittedStart(start, ended(nominal, briefly or came))

    monkeypatch.setattr(screening, "_attempt", attempt)
    attempts = [FittedStart(best, _ended(nominal, (20.0, 10.0))), FittedStart(other, _under_way(nominal, came))]
    _to_the_end(lagging, attempts, part(lagging, nominal, 100), best_here=known, best=known)
    assert gone == legs


@pytest.mark.parametrize(("explained", "gone"), [(False, ["near", "far"]), (True, ["near"])])
def test_until_one_leaves_but_noise_all_that_are_under_way_go_on_before_the_promising_are_chosen(
    lagging: Problem, monkeypatch: pytest.MonkeyPatch, explained: bool, gone: list[str]
) -> None:
    nominal = fit_nominal(lagging)
    best, near, far = (Start(name, 0.0, 0, nominal.hypothesis) for name in ("best", "near", "far"))
    attempts = [
        FittedStart(best, _ended(nominal, (20.0, 10.0))),
        FittedStart(near, _under_way(nominal, (35.0, 30.0))),
        FittedStart(far, _under_way(nominal, (100.0, 90.0))),
    ]
    rounds: list[list[str]] = []

    def go_on(these: Sequence[Start], *, iterations: int, **_: object) -> list[FittedStart]:
        assert iterations == FURTHER
        rounds.append([s.name for s in these])
        return [FittedStart(s, _ended(nominal, (9.0, 8.0))) for s in these]

    monkeypatch.setattr(screening, "_round", go_on)
    monkeypatch.setattr(screening, "statistics", lambda *_: SimpleNamespace(at_the_floor=explained))
    ends = _further(lagging, attempts, lagging, np.inf)
    assert rounds == [gone]
    assert [a.start for a in ends] == [best, near, far]
    assert [a.cost for a in ends] == [10.0, 8.0, 90.0 if explained else 8.0]


def _ended(this: Fit, costs: tuple[float, float]) -> Fit:
    """A fit that converged, with first and last cost."""
    first, cost = costs
    return replace(this, minimum=replace(this.minimum, status=FitStatus.CONVERGED, first=first, cost=cost))


def _under_way(this: Fit, costs: tuple[float, float]) -> Fit:
    first, cost = costs
    end = replace(this.minimum, status=FitStatus.ITERATION_LIMIT, first=first, cost=cost, iterations=1)
    return replace(this, minimum=end)


def test_the_next_leg_starts_where_the_last_one_ended_and_tries_nothing_again_that_was_refused(
    lagging: Problem,
) -> None:
    nominal = fit_nominal(lagging)
    start, end = Start("lag", 0.0, 0, nominal.hypothesis), nominal.minimum
    again = start.after(replace(nominal, minimum=replace(end, values=1.1 * end.values, damping=0.5)))
    np.testing.assert_array_equal(again.hypothesis.start, 1.1 * end.values)
    assert (again.name, again.order, again.motor, again.damping) == ("lag", 0.0, 0, 0.5)
    bold = replace(nominal, minimum=replace(end, damping=1e-9))
    assert start.after(bold).damping == start.damping  # no bolder than at first


@pytest.mark.slow
def test_a_model_that_is_exact_is_adequate() -> None:
    """What rwn simulates itself leaves nothing at all: an error of exactly zero."""
    voltage = np.repeat(np.random.default_rng(1).uniform(-10.0, 10.0, 10), 100)
    run = rwn.Recording(name="own", time=1e-3 * np.arange(1000.0), signals={"voltage": voltage})
    model = Model(kind="dc", parameters=TRUE)
    seen = rwn.simulate(model, run).signals
    signals = {"voltage": voltage, "current": seen["current"], "speed": seen["speed"]}
    assert rwn.diagnose([replace(run, signals=signals)], model).verdict == "adequate"


def test_effects_come_in_the_order_of_the_best_of_their_fits(lagging: Problem, monkeypatch: pytest.MonkeyPatch) -> None:
    """An effect that another start has led astray is not behind those that are worse than its best."""
    base = fit_nominal(lagging)

    def ended(name: str, cost: float) -> FittedStart:
        of = starts(lagging, base, name, orders=1)[0]
        minimum = replace(base.minimum, values=of.hypothesis.vector[: len(of.hypothesis.unknowns)], cost=cost)
        return FittedStart(of, Fit(hypothesis=of.hypothesis, minimum=minimum))

    ends = [ended("speed-sensor-lag", 2.0), ended("input-delay", 5.0), ended("speed-sensor-lag", 9.0)]
    monkeypatch.setattr(screening, "_to_the_end", lambda *_, **__: ends)
    found = screen(lagging, base, ["speed-sensor-lag", "input-delay"])
    assert [(f.added, f.cost) for f in found] == [(("speed-sensor-lag",), 2.0), (("input-delay",), 5.0)]


def test_a_law_that_starts_far_behind_goes_on_where_what_is_ahead_leaves_more_than_noise() -> None:
    """A limit of the current gains at once what a saturation gains after twenty more iterations, and then far more."""
    truth = {"resistance": 11.55, "inductance": 1.6e-3, "torque_constant": 0.00396, "back_emf_constant": 0.00396,
             "inertia": 4.16e-8, "viscous_friction": 2.95e-8}  # fmt: skip
    given = {"resistance": 13.7, "inductance": 1.1e-3, "torque_constant": 0.00374, "back_emf_constant": 0.0042,
             "inertia": 5.3e-8, "viscous_friction": 1e-7}  # fmt: skip
    known_to = {"resistance": 0.12, "inductance": 0.25, "torque_constant": 0.03, "back_emf_constant": 0.033,
                "inertia": 0.18, "viscous_friction": 0.8}  # fmt: skip
    time = 1e-3 * np.arange(3000)
    voltage = 1.7 * np.sign(np.sin(2 * np.pi * 3 * time)) + 0.5 * np.sin(2 * np.pi * 13 * time)
    effect = {"magnetic-saturation": {"saturation_current": 0.06}}
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(rwn.Model(kind="dc", parameters=truth, effects=effect), bare).signals["speed"]
    speed = speed + 0.5 * np.random.default_rng(1).standard_normal(time.size)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage, "speed": speed})
    problem = prepare([run], rwn.Model(kind="dc", parameters=given, uncertainty=known_to))
    problem, nominal = weighted_by_nominal(problem)
    found = screen(problem, nominal, ["current-limit", "magnetic-saturation", "supply-sag"])
    assert found[0].added == ("magnetic-saturation",)
    assert found[0].cost < 0.1 * found[1].cost


def test_of_the_machine_itself_three_effects_are_added_at_most(lagging: Problem) -> None:
    sheet = lagging.prior
    three = ("stribeck-friction", "quadratic-drag", "cogging-torque")
    base = fit(lagging, hypothesis(sheet, three, lagging.scales), max_iterations=1)
    assert _has_room(base, "speed-sensor-lag")
    assert _has_room(base, "input-delay")
    assert not _has_room(base, "constant-load")
    assert _has_room(fit(lagging, hypothesis(sheet, three[:2], lagging.scales), max_iterations=1), "constant-load")


def test_there_is_room_for_one_second_mass(lagging: Problem) -> None:
    base = fit(lagging, hypothesis(lagging.prior, ("shaft-compliance",), lagging.scales), max_iterations=1)
    assert not _has_room(base, "backlash")
    assert _has_room(base, "cogging-torque")
