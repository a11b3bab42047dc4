"""The main job, end to end."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.report.diagnosis import Diagnosis

DEMO = Path(rwn.__file__).parent / "demo"
EMPS = "data/nonlinear_benchmarks/EMPS"


def read(folder: Path, model: rwn.Model, *names: str) -> list[rwn.Recording]:
    return [rwn.read_recording(folder / name, layout=model.recording) for name in names]


def first_half(recording: rwn.Recording) -> rwn.Recording:
    half = len(recording) // 2
    return replace(recording, time=recording.time[:half], signals={s: v[:half] for s, v in recording.signals.items()})


def example(shared: Path, number: int) -> tuple[Diagnosis, dict[str, object]]:
    """What is found on half of every recording of an example case, which takes little more than half the time."""
    folder = shared / f"cases/case_{number:02d}"
    model = rwn.read_model(folder / "model.toml")
    train = sorted(p.name for p in folder.glob("train_?.csv"))
    fitted = [first_half(recording) for recording in read(folder, model, *train)]
    found = rwn.diagnose(fitted, model, heldout=read(folder, model, "heldout_1.csv"))
    return found, json.loads((folder / "answer.json").read_text())


@pytest.fixture(scope="module")
def demo() -> Diagnosis:
    model = rwn.read_model(DEMO / "model.toml")
    return rwn.diagnose(read(DEMO, model, "train.csv"), model, heldout=read(DEMO, model, "heldout.csv"), jobs=3)


@pytest.mark.slow
def test_the_demo_lacks_coulomb_friction_and_its_correction_predicts(demo: Diagnosis) -> None:
    assert demo.verdict == "missing-physics"
    assert [e.name for e in demo.effects] == ["coulomb-friction"]
    assert demo.equation == "mechanical"
    row = next(r for r in demo.heldout if r.region == "all" and r.signal == "speed")
    assert row.corrected is not None
    assert row.gain_interval is not None
    assert row.gain_interval[0] > 0.5
    assert row.corrected < 1.2 * (row.noise_floor or np.inf)


@pytest.mark.slow
def test_the_demo_draws_its_proof_and_its_law(demo: Diagnosis) -> None:
    heldout = [p for p in demo.curves if p.recording == "heldout.csv"]
    assert [(p.slot, p.use) for p in heldout] == [
        ("response", "heldout"), ("residual-time", "heldout"), ("input", "heldout"),
    ]  # fmt: skip
    assert demo.plots[0] == "heldout.csv"
    response, errors, _ = heldout
    assert [t.name for t in response.traces] == ["measured", "nominal as given", "nominal refitted", "corrected"]
    before, after = (float(np.sqrt(np.mean(t.y**2))) for t in errors.traces)
    assert after < 0.5 * before
    (law,) = [p for p in demo.curves if p.slot == "law"]
    points, line = law.traces
    assert line.name == "Coulomb friction"
    level = demo.effects[0].parameters["coulomb_torque"].value
    fast = np.abs(line.x) > 20.0
    np.testing.assert_allclose(line.y[fast], -level * np.sign(line.x[fast]), rtol=0.02)
    assert np.sqrt(np.mean((points.y + level * np.sign(points.x)) ** 2)) < 0.5 * level
    (where,) = [p for p in demo.curves if p.slot == "residual-speed"]
    cloud = where.traces[0]
    assert cloud.recording == "train.csv"
    assert cloud.at is not None
    assert (cloud.at.min(), cloud.at.max()) == (pytest.approx(0.0, abs=0.05), pytest.approx(4.999, abs=0.05))
    assert len(demo.to_json()) < 20_000


@pytest.mark.slow
def test_the_corrected_model_has_nothing_missing(demo: Diagnosis) -> None:
    model = replace(demo.corrected, uncertainty={})
    again = rwn.diagnose(read(DEMO, model, "train.csv"), model)
    assert again.verdict == "adequate"


@pytest.mark.slow
def test_the_result_does_not_depend_on_the_number_of_threads(demo: Diagnosis) -> None:
    model = rwn.read_model(DEMO / "model.toml")
    alone = rwn.diagnose(read(DEMO, model, "train.csv"), model, heldout=read(DEMO, model, "heldout.csv"), jobs=1)
    assert alone.to_json() == demo.to_json()


@pytest.mark.slow
@pytest.mark.parametrize("number", [2, 4, 8, 10, 13])
def test_example_cases_with_known_answers(shared: Path, number: int) -> None:
    found, answer = example(shared, number)
    assert found.verdict == answer["verdict"]
    effects = answer["effects"]
    assert isinstance(effects, list)
    if found.verdict == "missing-physics":
        assert [e.name for e in found.effects] == [e["name"] for e in effects]
        assert found.equation == effects[0]["equation"]


@pytest.mark.slow
def test_emps(shared: Path) -> None:
    """From inertia and viscous friction alone; published: Fc 20.3935 N, Fv 203.5034 N s/m, force error 5.982 %."""
    model = rwn.read_model(DEMO / "emps.toml")
    (train,) = read(shared / EMPS, model, "DATA_EMPS.mat")
    (pulses,) = read(shared / EMPS, model, "DATA_EMPS_PULSES.mat")
    found = rwn.diagnose([train], model, heldout=[pulses])
    assert found.verdict == "missing-physics"
    assert found.equation == "mechanical"
    assert found.effects[0].name == found.set[0] == "coulomb-friction"
    assert found.effects[0].parameters["coulomb_torque"].value == pytest.approx(20.3935, rel=0.05)
    assert found.effects[0].parameters["coulomb_torque"].unit == "N"
    viscous = found.nominal_fit.parameters["viscous_friction"]
    assert viscous.refitted.value == pytest.approx(411.0, rel=0.05), "alone, viscous friction doubles"
    assert viscous.corrected is not None
    assert viscous.corrected.value == pytest.approx(203.5034, rel=0.05)
    names = [r.name for r in found.location.regions if r.share - r.samples_share > 0.05]
    assert "low speed" in names
    assert "reversals" in names
    force = next(r for r in found.heldout if r.signal == "driving force")
    assert force.refitted > 15.0
    assert force.corrected is not None
    assert force.corrected <= 6.0
    position = next(r for r in found.heldout if r.signal == "position")
    assert position.corrected is not None
    assert position.corrected <= 5.2e-3, "corrected.toml is fitted to the free run"
    assert set(found.corrected.effects) & set(found.set)


def test_identify_says_how_far_the_nominal_structure_is_from_the_noise() -> None:
    model = rwn.read_model(DEMO / "model.toml")
    fit = rwn.identify(read(DEMO, model, "train.csv"), model)
    assert fit.status == "converged"
    assert fit.residual_over_noise > 2.0, "Coulomb friction is missing, so the nominal structure cannot reach the noise"


def test_identify_recovers_a_simulated_motor(demo: Diagnosis) -> None:
    truth = replace(demo.corrected, uncertainty={"inertia": 0.3, "resistance": 0.3})
    (run,) = read(DEMO, truth, "train.csv")
    signals = {name: values for name, values in rwn.simulate(truth, run).signals.items() if name in run.signals}
    made = replace(run, signals={"voltage": run.signals["voltage"], **signals})
    off = {**truth.parameters, "inertia": 1.2 * truth.parameters["inertia"]}
    fit = rwn.identify([made], replace(truth, parameters=off))
    assert fit.parameters["inertia"].value == pytest.approx(truth.parameters["inertia"], rel=1e-3)
    assert fit.parameters["resistance"].value == pytest.approx(truth.parameters["resistance"], rel=1e-3)


def test_simulation_follows_the_recording(demo: Diagnosis) -> None:
    (heldout,) = read(DEMO, demo.corrected, "heldout.csv")
    run = rwn.simulate(demo.corrected, heldout)
    assert run.status == "ok"
    error = run.signals["speed"] - heldout.signals["speed"]
    assert np.sqrt(np.mean(error**2)) < 0.05 * np.sqrt(np.mean(heldout.signals["speed"] ** 2))


@pytest.mark.parametrize("wandering", [0.0, pytest.param(0.004, marks=pytest.mark.slow)])
def test_of_a_torque_that_wanders_in_time_much_is_left(wandering: float) -> None:
    """It has no name; steady loads for a while are what comes nearest."""
    rng = np.random.default_rng(2)
    time = 2e-3 * np.arange(1200)
    model = rwn.Model(kind="axis", parameters={"inertia": 1e-3, "viscous_friction": 2e-3}, uncertainty={"inertia": 0.1})
    asked = np.repeat(rng.uniform(-0.05, 0.05, 60), 20)
    walk = np.cumsum(rng.standard_normal(time.size))
    acting = rwn.Recording(name="x", time=time, signals={"torque": asked + wandering * walk / np.std(walk)})
    speed = rwn.simulate(model, acting).signals["speed"] + 0.02 * rng.standard_normal(time.size)
    run = rwn.Recording(name="x", time=time, signals={"torque": asked, "speed": speed})
    said: list[tuple[str, float]] = []
    found = rwn.diagnose([run], model, effort=0.1, progress=lambda what, done: said.append((what, done)))
    assert (found.verdict == "adequate") == (wandering == 0.0)
    assert ("speed" in found.remainder.signals) == (wandering > 0.0)
    assert said[-1][1] > 0.9
