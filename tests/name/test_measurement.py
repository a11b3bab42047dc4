"""How recordings were made is asked again of what was found."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.signal import lfilter

import rwn
from made_up_files import files_of
from made_up_motor import SMALL
from ranked import ranked
from rwn.fit.fit import Fit, fit, fit_nominal
from rwn.fit.hypothesis import hypothesis
from rwn.fit.nominal import weighted_by_nominal
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.residuals import Statistics, statistics
from rwn.measurement.filter_colour import SensorFilter
from rwn.model.model import Model
from rwn.name import extending, forward
from rwn.name.forward import _grown, rank
from rwn.name.measurement import CHANGES, Measurement, is_explained
from rwn.name.ranking import NO_EXTENSIONS, Fits
from rwn.recording.filters import as_filtered

STEP, SHARE, SLOW = 1e-3, 0.6, 0.9
MODEL = Model(kind="dc", parameters=SMALL, uncertainty={"inertia": 0.1, "viscous_friction": 0.1})


def _filter(share: float) -> SensorFilter:
    return SensorFilter(signal="speed", share=share, time_constant=-STEP / float(np.log(share)), digital=True)


@pytest.fixture(scope="module")
def recorded() -> Problem:
    return _recorded(3.0)


def _recorded(volts: float) -> Problem:
    """A drive with friction, whose speed and the noise of it went through a filter of samples."""
    rng, time = np.random.default_rng(7), STEP * np.arange(4000)
    voltage = np.repeat(volts * rng.uniform(-1.0, 1.0, 80), 50)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    real = replace(MODEL, effects={"coulomb-friction": {"coulomb_torque": 4e-3}})
    speed = rwn.simulate(real, run).signals["speed"] + 0.2 * rng.standard_normal(time.size)
    shown = as_filtered(time, speed, _filter(SHARE).time_constant)
    return prepare([replace(run, signals={"voltage": voltage, "speed": shown})], MODEL)


def _rubbed(made: Measurement) -> tuple[Problem, Fit]:
    problem, _ = weighted_by_nominal(made.problem)
    return problem, fit(problem, hypothesis(problem.prior, ("coulomb-friction",), problem.scales))


def test_a_filter_that_is_not_known_is_asked_of_any_explanation(recorded: Problem) -> None:
    made = Measurement(as_prepared=recorded)
    found = made.otherwise(*_rubbed(made), completely=False)
    assert found is not None
    assert [f.signal for f in found.filters] == ["speed"]
    assert found.changes == 0


def test_noise_that_lasts_is_noise_where_the_motion_went_through_no_filter() -> None:
    """First-order noise of the current, of which 0.9 is in the next sample: no filter, and nothing is missing."""
    rng, time = np.random.default_rng(11), STEP * np.arange(4000)
    voltage = np.repeat(3.0 * rng.uniform(-1.0, 1.0, 80), 50)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    shown = rwn.simulate(MODEL, run).signals
    lasting = lfilter([np.sqrt(1.0 - SLOW**2)], [1.0, -SLOW], rng.standard_normal(time.size))
    white = rng.standard_normal(time.size)
    noisy = {"speed": shown["speed"] + 0.2 * white, "current": shown["current"] + 0.02 * lasting}
    made = Measurement(as_prepared=prepare([replace(run, signals={"voltage": voltage, **noisy})], MODEL))
    problem, nominal = weighted_by_nominal(made.problem)
    assert not statistics(problem, nominal).at_the_floor
    found = made.otherwise(problem, nominal, completely=True)
    assert found is not None
    assert not found.problem.filters
    assert not found.problem.prior.nuisance
    assert found.problem.coloured["current"] == pytest.approx((SLOW,), abs=0.02)
    problem, nominal = weighted_by_nominal(found.problem)
    assert statistics(problem, nominal).at_the_floor
    assert found.otherwise(problem, nominal, completely=True) is None


@pytest.mark.parametrize(
    ("names", "factors", "loads", "shown"),
    [
        (["inertia"], (0.8, 1.3), (), "inertia of run_0"),
        (["viscous_friction"], (0.6, 1.6), (), "friction of run_0"),
        ([], (1.0, 1.0), (-2e-3, 2e-3), "load of run_0"),
        ([], (1.0, 1.0), (), None),
    ],
)  # fmt: skip
def test_what_differs_from_file_to_file_is_what_shows_most(
    names: list[str], factors: tuple[float, ...], loads: tuple[float, ...], shown: str | None
) -> None:
    made = Measurement(as_prepared=prepare(files_of(MODEL, names, factors, loads=loads), MODEL))
    found = made.otherwise(*weighted_by_nominal(made.problem), completely=True)
    own = [] if found is None else [o.name for o in found.problem.prior.of_runs]
    assert (own[:1] or [None]) == [shown]
    assert found is None or found.supposed == (names == ["inertia"])


def test_several_machines_are_not_supposed_twice() -> None:
    made = Measurement(as_prepared=prepare(files_of(MODEL, ["inertia"], (0.8, 1.3)), MODEL), of_one_machine=True)
    assert made.otherwise(*weighted_by_nominal(made.problem), completely=True) is None


def test_a_filter_is_asked_early_where_the_noise_itself_shows_it() -> None:
    """Where the motion is large, what the filter makes of it hides what it makes of the noise."""
    made, slow = Measurement(as_prepared=_recorded(30.0)), Measurement(as_prepared=_recorded(0.3))
    assert made.in_noise(*_rubbed(made)) is None
    found = slow.in_noise(*_rubbed(slow))
    assert found is not None
    assert [f.signal for f in found.filters] == ["speed"]
    assert found.in_noise(*_rubbed(found)) is None  # it is known


def test_white_noise_shows_no_filter_that_could_be_known_early(problem: Problem) -> None:
    assert Measurement(as_prepared=problem).in_noise(*weighted_by_nominal(problem)) is None


def test_a_known_filter_is_asked_again_of_a_complete_explanation(recorded: Problem) -> None:
    made = Measurement(as_prepared=recorded, filters=(_filter(0.3),))
    assert made.otherwise(*_rubbed(made), completely=False) is None
    found = made.otherwise(*_rubbed(made), completely=True)
    assert found is not None
    (of_speed,) = found.filters
    assert of_speed.share == pytest.approx(SHARE, abs=0.02)
    assert found.changes == 1
    assert found.otherwise(*_rubbed(found), completely=True) is None


def test_filters_change_so_many_times_at_most(recorded: Problem) -> None:
    made = Measurement(as_prepared=recorded, filters=(_filter(0.3),), changes=CHANGES)
    assert made.otherwise(*_rubbed(made), completely=True) is None


def test_nothing_is_built_on_what_another_measurement_shows(
    problem: Problem, fit_with: Callable[[str], Fit], monkeypatch: pytest.MonkeyPatch
) -> None:
    """How recordings were made is asked of the best single effect, before pairs of effects are tried."""
    single, asked = fit_with("coulomb-friction"), list[Fit]()
    monkeypatch.setattr(extending, "beside", lambda *_: pytest.fail("pairs were tried"))
    nominal = replace(single, minimum=replace(single.minimum, cost=9.0 * single.cost))
    another = Measurement(as_prepared=problem)

    def otherwise(best: Fit) -> Measurement:
        asked.append(best)
        return another

    alone = Fits(problem, nominal, [single])
    monkeypatch.setattr(forward, "_best_of", lambda _, fits: (fits[-1], SimpleNamespace(structured=("speed",))))
    known = NO_EXTENSIONS
    grown = _grown(alone, [single], [], known, at_once=4, begun=0, progress=lambda *_: None, otherwise=otherwise)
    assert grown.measured is another
    assert (asked, grown.complete, grown.paired) == ([single], False, False)


def test_under_another_filter_a_search_goes_on_from_what_was_found(
    problem: Problem, fit_with: Callable[[str], Fit], monkeypatch: pytest.MonkeyPatch
) -> None:
    single, nominal = fit_with("unbalance"), fit_nominal(problem)
    pair = fit(problem, hypothesis(problem.prior, ["unbalance", "coulomb-friction"], problem.scales))
    tried = list[tuple[int, list[Fit]]]()

    def nothing_found(_: Fits, __: Fit, bases: list[Fit], *___: object, size: int, **____: object) -> object:
        tried.append((size, bases))
        return NO_EXTENSIONS, ()

    monkeypatch.setattr(forward, "beside_and_in_windows", nothing_found)
    monkeypatch.setattr(forward, "_best_of", lambda *_: (pair, SimpleNamespace(structured=("speed",))))
    monkeypatch.setattr(forward, "_is_worth_it", lambda *_, **__: False)
    alone, wanted = Fits(problem, nominal, [single]), ["unbalance", "coulomb-friction"]
    _grown(
        alone, [single], wanted, NO_EXTENSIONS, at_once=4, begun=0, progress=lambda *_: None, known=[pair]
    )  # fmt: skip
    assert tried == [(3, [pair])]


def test_what_is_known_of_the_recordings_goes_along_when_a_ranking_is_gone_on_with(recorded: Problem) -> None:
    """Else the filter would count as unknown where it is undone already, and never be asked again."""
    names = ["coulomb-friction"]
    alone = ranked(recorded, names, at_once=1)
    further = ranked(recorded, names, after=alone)
    assert [f.signal for f in alone.measurement.filters] == ["speed"]
    assert further.measurement == alone.measurement


@pytest.mark.parametrize(("left", "otherwise", "yes"), [(1.06, 253.0, True), (3.0, 253.0, False), (1.06, 1.5, False)])
def test_several_machines_leave_noise_or_next_to_nothing(left: float, otherwise: float, yes: bool) -> None:
    """What a simulator, or a logger, adds to a signal is no reason to take two machines for one."""

    def leaving(variance: float) -> Statistics:
        return Statistics(count=10000, variance=variance, correlation_time=2.0, structured=("current",))

    assert is_explained(leaving(left), leaving(otherwise)) == yes
    assert is_explained(replace(leaving(left), variance=1.0, structured=()), leaving(otherwise))


def test_an_explanation_that_is_known_is_weighed_with_those_that_a_search_finds(problem: Problem) -> None:
    pair = ("unbalance", "coulomb-friction")
    known = [fit(problem, hypothesis(problem.prior, pair, problem.scales))]
    found = rank(problem, progress=lambda *_: None, names=list(pair), at_once=1, known=known)
    assert set(pair) in [set(one.added) for one in found.fits]
