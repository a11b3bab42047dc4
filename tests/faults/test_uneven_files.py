"""Recordings of machines that differ, or of one whose load and friction do."""

from __future__ import annotations

from dataclasses import replace

import pytest

import rwn
from made_up_files import files_of
from ranked import ranked, ranked_from
from rwn.faults.uneven_files import at_own_levels, uneven_files, uneven_unseen
from rwn.fit.preparation import prepare
from rwn.fit.residuals import statistics
from rwn.measurement.levels import all_levels, load, with_levels
from rwn.model.model import Model
from rwn.model.own_effects import OwnEffect, OwnParameter
from rwn.simulate.recorded_run import judging_run

MOTOR = {
    "resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 2e-5,
    "viscous_friction": 4e-5,
}  # fmt: skip
UNCERTAIN = ("inertia", "resistance", "viscous_friction")
MODEL = Model(kind="dc", parameters=MOTOR, uncertainty=dict.fromkeys(UNCERTAIN, 0.1))
RUBBING = replace(MODEL, effects={"coulomb-friction": {"coulomb_torque": 4e-3}})


@pytest.mark.parametrize("quantity", ["resistance", "inertia"])
def test_what_files_disagree_on_is_said_by_file(quantity: str) -> None:
    problem = prepare(files_of(MODEL, [quantity], (0.9, 1.0, 1.12)), MODEL)
    (level,) = (level for level in all_levels(problem) if level.quantity == quantity)
    found = uneven_files(ranked(with_levels(problem, level), ["coulomb-friction"], at_once=1))
    said = {f.recording: f.words for f in found if f.kind == "files-disagree"}
    assert {"run_0", "run_2"} <= set(said)
    assert said["run_0"].startswith(f"its {quantity} is -")
    assert said["run_2"].startswith(f"its {quantity} is +")
    value, unit = {"resistance": (1.12, "ohm"), "inertia": (2.24e-5, "kg m^2")}[quantity]
    shown = said["run_2"].split("(")[1].split(", deviation")[0]
    assert float(shown.split(" ")[0]) == pytest.approx(value, rel=0.05)
    assert shown.endswith(unit)


def test_loads_are_said_by_file_also_of_one_that_was_not_fitted() -> None:
    *known, unseen = files_of(MODEL, [], (1.0, 1.0, 1.0), loads=(0.002, 0.006, 0.013))
    problem = prepare(known, MODEL)
    ranking = ranked(with_levels(problem, load(problem)), ["constant-load"], at_once=1)
    assert ranking.fits[0].final.values_of("constant-load")["torque"] == pytest.approx(0.004, rel=0.05)
    said = {f.recording: float(f.words.split()[3]) for f in uneven_files(ranking) if f.kind == "uneven-load"}
    assert said == pytest.approx({"run_0": -0.002, "run_1": 0.002}, rel=0.05)
    (other,) = uneven_unseen(ranking, [judging_run(unseen, MODEL)])
    assert float(other.words.split()[3]) == pytest.approx(0.009, rel=0.05)


@pytest.mark.parametrize(
    ("names", "factor", "load", "said"),
    [
        (["inertia"], 1.5, 0.0, "its inertia is +50 %"),
        ([], 1.0, 0.006, "its load is +0.006"),
        ([], 1.0, 0.0, None),
    ],
)
def test_a_recording_kept_back_that_contradicts_the_others_is_said(
    names: list[str], factor: float, load: float, said: str | None
) -> None:
    known = files_of(MODEL, [], (1.0,))
    (_, unseen) = files_of(MODEL, names, (1.0, factor), loads=(0.0, load))
    ranking = ranked_from(known, MODEL, ["coulomb-friction"])
    ((run,), found) = at_own_levels(ranking, [judging_run(unseen, MODEL)])
    assert [f.words.startswith(said or "") for f in found] == ([True] if said else [])
    judged = ranking.problem.in_free_run().on([run])
    assert statistics(judged, ranking.nominal_fit).at_the_floor or load


@pytest.mark.slow
@pytest.mark.parametrize("loads", [(0.0, 0.009), (-0.004, 0.004)])
def test_a_friction_is_named_beside_loads_that_differ(loads: tuple[float, float]) -> None:
    found = rwn.diagnose(files_of(RUBBING, [], (1.0, 1.0), loads=loads), MODEL, jobs=1)
    assert "coulomb-friction" in {e.name for e in found.effects}
    assert {f.recording for f in found.findings if f.kind == "uneven-load"} == {"run_0", "run_1"}


@pytest.mark.slow
def test_a_friction_is_named_where_files_contradict_each_other() -> None:
    found = rwn.diagnose(files_of(RUBBING, ["inertia"], (0.8, 1.3)), MODEL, jobs=1)
    assert [e.name for e in found.effects][:1] == ["coulomb-friction"]
    (odd,) = [f for f in found.findings if f.kind == "files-disagree"]
    assert (odd.recording, odd.held) == ("run_1", "that of run_0"), "whose inertia is nearer to that of the model"
    assert odd.words.startswith("its inertia is +62 % off that of run_0 (")
    assert found.corrected is not None
    assert found.corrected.parameters["inertia"] == pytest.approx(0.8 * MODEL.parameters["inertia"], rel=0.02)


@pytest.mark.slow
def test_numbers_of_a_machine_do_not_stand_in_for_physics_without_a_name() -> None:
    """A brake that lets go at speed: the machine is one, and something is missing."""
    brake = OwnEffect(
        name="brake", term="torque", equation="k * speed / (1 + (speed / w0)^4)",
        parameters=(
            OwnParameter(name="k", unit="N m s/rad", lower=0, upper=1, start=1e-3, strength=True),
            OwnParameter(name="w0", unit="rad/s", lower=1, upper=1e3, start=30),
        ),
    )  # fmt: skip
    braked = replace(MODEL, own_effects=(brake,), effects={"brake": {"k": 3e-4, "w0": 30.0}})
    found = rwn.diagnose(files_of(braked, [], (1.0, 1.0)), MODEL, jobs=1)
    assert found.verdict == "unexplained"
    assert not [f for f in found.findings if f.kind == "files-disagree"]
