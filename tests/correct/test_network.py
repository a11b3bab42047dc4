"""What has no name: a wavelet network as the correction."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, recorded
from ranked import ranked_from
from rwn.correct.network import network_correction, proved_network
from rwn.decide.calibration import calibration
from rwn.model.drives.axis import LINEAR_AXIS
from rwn.model.files import write_model
from rwn.model.model import Model
from rwn.model.own_effects import OwnEffect, OwnParameter
from rwn.report.sentences import verdict_sentence
from rwn.simulate.recorded_run import judging_run
from rwn.unnamed_law.places import places

pytestmark = pytest.mark.slow

LITTLE = 0.1  # effort of a search that is to find no name: what follows it is looked at

NOMINAL = Model(
    kind="dc",
    parameters={**MOTOR, "inertia": 3.2e-4, "resistance": 0.78},
    uncertainty={"resistance": 0.05, "inertia": 0.1, "viscous_friction": 0.3, "torque_constant": 0.03},
)


def wavy(speed: float, _: float) -> float:
    """No drag: it brakes and drives by turns."""
    return -0.03 * float(np.sin(speed / 15.0))


def once_a_turn(_: float, angle: float) -> float:
    """A catch at one angle, much narrower than any sine."""
    return -0.08 * float(np.sin(angle) * np.exp(-((np.sin(angle / 2.0) / 0.2) ** 2)))


def rubbing_and_caught(speed: float, angle: float) -> float:
    """Dry friction beside a torque that depends on speed and angle at once."""
    return -0.03 * float(np.tanh(speed / 0.3)) - 0.1 * float(np.sin(speed / 9.0) * np.sin(7 * angle))


@pytest.fixture(scope="module", autouse=True)
def nothing_stated() -> Iterator[None]:
    """What is corrected where no name is stated, whatever the calibration makes of a mimic."""
    doubting = replace(calibration(), intercept=-50.0)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("rwn.decide.account.calibration", lambda: doubting)
        yield


@pytest.fixture(scope="module")
def waved() -> rwn.Diagnosis:
    runs = [recorded(seed, wavy, samples=1200) for seed in range(3)]
    return rwn.diagnose(runs[:2], NOMINAL, heldout=runs[2:], jobs=1, effort=LITTLE)


def test_a_torque_without_a_name_is_corrected_by_a_network(waved: rwn.Diagnosis) -> None:
    assert waved.verdict == "unexplained"
    assert waved.effects == ()
    assert waved.stand_in == "a wavelet network, a torque over speed"
    rows = [r for r in waved.heldout if r.region == "all"]
    assert {r.signal for r in rows} == {"speed", "current"}
    for row in rows:
        assert row.corrected is not None
        assert row.corrected < 0.5 * row.refitted
        assert row.gain_interval is not None
        assert row.gain_interval[0] > 0.3
    fitted = waved.nominal_fit.parameters
    for name in ("inertia", "resistance"):  # what the network took over is not on the motor's account
        assert fitted[name].corrected is not None
        assert fitted[name].corrected.value == pytest.approx(MOTOR[name], rel=0.02)
    assert (waved.curves[-1].y_label, waved.curves[-1].y_unit) == ("torque", "N m")
    picture = waved.curves[-1].traces[0]
    inside = np.abs(picture.x) < 80.0
    assert np.std((picture.y - [wavy(w, 0.0) for w in picture.x])[inside]) < 0.2 * 0.03


def test_the_network_is_an_own_effect_of_the_file(waved: rwn.Diagnosis, tmp_path: Path) -> None:
    write_model(waved.corrected, tmp_path / "corrected.toml")
    model = rwn.read_model(tmp_path / "corrected.toml")
    assert model == waved.corrected
    assert list(model.effects) == ["unexplained-torque"]
    fresh = recorded(9, wavy)
    error = rwn.simulate(model, fresh).signals["speed"] - fresh.signals["speed"]
    plain = rwn.simulate(NOMINAL, fresh).signals["speed"] - fresh.signals["speed"]
    assert np.std(error) < 0.5 * np.std(plain)


def test_the_sentence_says_so(waved: rwn.Diagnosis) -> None:
    text = verdict_sentence(waved)
    assert "no name" in text
    assert "stands for it: a wavelet network, a torque over speed" in text
    assert "reduces" in text


def test_a_network_over_the_angle() -> None:
    ranking = ranked_from([recorded(seed, once_a_turn) for seed in range(2)], NOMINAL, NONE)
    made = network_correction(ranking, NOMINAL)
    assert made is not None
    assert made.place.words == "a torque over angle"
    assert made.cost < 1.1 * ranking.left.count, "nothing but noise is left"
    assert ranking.nominal_fit.cost > 2.0 * ranking.left.count


def test_what_the_nominal_term_can_do_is_not_left_to_the_network() -> None:
    unsure = replace(NOMINAL, uncertainty={**NOMINAL.uncertainty, "viscous_friction": np.inf})
    ranking = ranked_from([recorded(seed, wavy) for seed in range(2)], unsure, NONE)
    made = network_correction(ranking, unsure, at=places(ranking.problem, unsure)[0])
    assert made is not None
    effect = made.model.own_effects[-1]
    speed = np.concatenate([r.speed for r in ranking.problem.whole])
    values = {p.name: p.start for p in effect.parameters}
    torque = effect.formula.evaluate({**values, "speed": speed})
    share = (torque @ speed) ** 2 / (torque @ torque) / (speed @ speed)
    assert share < 1e-3


def test_a_network_that_does_not_help_elsewhere_is_not_kept() -> None:
    """Held-out recordings of another machine, which brakes where this one drives."""
    runs = [recorded(0, wavy), recorded(1, wavy), recorded(2, lambda w, a: -wavy(w, a))]
    ranking = ranked_from(runs[:2], NOMINAL, NONE)
    assert network_correction(ranking, NOMINAL) is not None
    assert proved_network(ranking, NOMINAL, [judging_run(runs[2], NOMINAL)], seed=0) is None


def test_a_name_that_is_proved_and_not_the_whole_stands_in(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rwn.correct.correction.proved_network", lambda *_, **__: None)
    runs = [recorded(seed, rubbing_and_caught, samples=1200) for seed in range(3)]
    found = rwn.diagnose(runs[:2], NOMINAL, heldout=runs[2:], jobs=1, effort=LITTLE)
    assert found.verdict == "unexplained"
    assert found.effects == (), "it is not named"
    assert found.stand_in.startswith("coulomb-friction, which helps")
    assert list(found.corrected.effects) == ["coulomb-friction"]
    assert all(r.gain is not None and r.gain > 0.1 for r in found.heldout if r.region == "all")
    assert "stands for it: coulomb-friction" in verdict_sentence(found)


def test_without_held_out_recordings_it_is_learned_anew_for_each() -> None:
    runs = [recorded(seed, wavy) for seed in range(2)]
    ranking = ranked_from(runs, NOMINAL, NONE)
    kept = proved_network(ranking, NOMINAL, [], seed=0)
    assert kept is not None
    assert all("left out" in row.recording for row in kept[1])
    main = next(r for r in kept[1] if r.region == "all" and r.signal == "speed")
    assert main.corrected is not None
    assert main.corrected < 0.6 * main.refitted


def test_a_force_over_the_position_of_a_linear_axis() -> None:
    """A cable that pulls the more the further the carriage is out."""
    cable = OwnEffect(
        name="cable", term="load", equation="-pull * tanh(3 * position / out)", drive=LINEAR_AXIS,
        parameters=(
            OwnParameter(name="pull", unit="N", lower=0, upper=100, start=1, strength=True),
            OwnParameter(name="out", unit="m", lower=0.01, upper=10, start=1),
        ),
    )  # fmt: skip
    plain = Model(
        kind="axis", linear=True, parameters={"inertia": 20.0, "viscous_friction": 40.0},
        uncertainty={"inertia": 0.1, "viscous_friction": 0.3},
    )  # fmt: skip
    pulled = replace(plain, own_effects=(cable,), effects={"cable": {"pull": 6.0, "out": 0.4}})
    t = 2e-3 * np.arange(4000)
    runs = []
    for seed in range(3):
        rng = np.random.default_rng(seed)
        tones = zip((9.0, 7.0, 5.0), rng.uniform(0.2, 1.0, 3), rng.uniform(0.0, 6.0, 3), strict=True)
        force = sum(a * np.sin(2 * np.pi * f * t + p) for a, f, p in tones)
        run = rwn.Recording(name=f"run_{seed}", time=t, signals={"force": force}, linear=True)
        true = rwn.simulate(pulled, run).signals
        signals = {"force": force, "position": true["position"] + rng.normal(0, 2e-5, t.size),
                   "speed": true["speed"] + rng.normal(0, 1e-3, t.size)}  # fmt: skip
        runs.append(replace(run, signals=signals))
    ranking = ranked_from(runs[:2], plain, NONE)
    kept = proved_network(ranking, plain, [judging_run(runs[2], plain)], seed=0)
    assert kept is not None
    assert kept[0].place.words == "a force over position"
    row = next(r for r in kept[1] if r.region == "all" and r.signal == "speed")
    assert row.corrected is not None
    assert row.corrected < 0.2 * row.refitted


NONE = ["constant-load"]  # what stands in does not depend on the names that were tried
