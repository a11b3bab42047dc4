"""Real machines: one quick test per set of recordings; all of them together is `rwn evidence`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import made_up
import rwn
from ranked import ranked
from rwn.cli import app
from rwn.errors import InputError
from rwn.fit.preparation import prepare
from rwn.fit.prior_weight import BELIEVABLE
from rwn.name.found_effect import FoundEffect
from rwn.recording.inspection import inspected
from rwn.recording.recording import Recording, read_recording
from rwn.report.diagnosis import Diagnosis
from rwn.report.file_units import in_file_units
from rwn.studies.machines import ced, emps, fra233, frc, hall, laas, odrive, undc, xl330
from rwn.studies.machines.hand_fit import HANDS, fitted, rms, shown
from rwn.studies.machines.machine import Error, Outcome, cut, error_of, nominal_model
from rwn.studies.machines.registry import MACHINES
from rwn.studies.machines.runner import run_machines
from rwn.studies.machines.sliding_motor import Drive, slide
from rwn.studies.machines.table import markdown
from rwn.studies.sections import check_sections, write_section


def silent(text: str) -> None:
    assert text


def test_nominal_models_leave_out_what_is_looked_for() -> None:
    for name in ("ced", "fra233", "frc", "hall", "laas", "odrive", "undc", "xl330"):
        assert not nominal_model(name).effects


def test_missing_data_and_wrong_names_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="the folder of recordings is not here"):
        run_machines([], tmp_path / "nowhere", tmp_path)
    with pytest.raises(InputError, match="did you mean 'emps'"):
        run_machines(["emsp"], tmp_path, tmp_path)
    for name in MACHINES:
        with pytest.raises(InputError, match="a recording of this machine is not here"):
            run_machines([name], tmp_path, tmp_path)
    told = CliRunner().invoke(app, ["evidence", "--help"])
    assert told.exit_code == 0


def test_the_table_says_what_was_found_and_what_was_wanted() -> None:
    found = Diagnosis(
        verdict="missing-physics",
        effects=(FoundEffect(name="a", equation="mechanical", probability=0.9),),
        set=("a", "b"),
    )
    error = Error(measure="x [m]", nominal=3.0, refitted=2.0, corrected=1.0, published="0.5 (them)", wanted=1.5)
    outcome = Outcome(machine="M", begins_with="linear", found=found, errors=(error,), notes=("drifts",))
    text = markdown([outcome])
    assert "| M | linear | a 0.90; not told apart: a, b | x [m] | 3 | 2 | 1 |  | <= 1.5 | 0.5 (them) |" in text
    assert "- M: drifts" in text
    nothing = replace(outcome, found=Diagnosis(verdict="unexplained"), errors=(replace(error, corrected=None),))
    assert "| unexplained | x [m] | 3 | 2 |  |  | <= 1.5 |" in markdown([nothing])


@pytest.mark.slow
def test_ced(shared: Path) -> None:
    low, high = ced.run(shared / "data" / ced.MACHINE.folder, silent)
    for outcome in (low, high):
        assert [e.name for e in outcome.found.effects] == ["sensor-rectification"]
        assert outcome.found.effects[0].parameters["exponent"].value > 1.3, "the sensor hardly sees slow motion"
    assert all(e.corrected is not None and e.corrected <= 0.115 for e in low.errors)
    assert all(e.corrected is not None and e.corrected <= 0.095 for e in high.errors)


def test_emps_friction_drifts_between_the_files(shared: Path) -> None:
    model = emps.read_model(emps.NOMINAL)
    rows = []
    for name in ("DATA_EMPS.mat", "DATA_EMPS_PULSES.mat"):
        run = read_recording(shared / "data" / emps.MACHINE.folder / name, layout=model.recording)
        _, speed, acceleration, force = emps.filtered(run)
        columns = np.column_stack([acceleration, speed, np.sign(speed), np.abs(speed), np.ones(speed.size)])
        rows.append(np.linalg.lstsq(columns, force, rcond=None)[0])
        if name == "DATA_EMPS.mat":
            assert rows[0][:3] == pytest.approx([95.1089, 203.5034, 20.3935], rel=0.01), "published"
    change = rows[1][:3] / rows[0][:3] - 1.0
    assert 0.02 < change[1] < 0.05
    assert 0.015 < change[2] < 0.04


@pytest.mark.slow
def test_fra233_dry_friction_does_not_bend_the_motor_beyond_belief(shared: Path) -> None:
    model = nominal_model("fra233")
    folder = shared / "data" / fra233.MACHINE.folder
    sine, ramp = (read_recording(folder / f"{name}_1.mat", layout=model.recording) for name in ("sine", "ramp"))
    names = ["coulomb-friction", "quadratic-drag", "load-dependent-friction"]
    problem = prepare([cut(sine, 2000, 8000), cut(ramp, 1000, 7000)], model)
    ranking = ranked(problem, names)
    first = ranking.fits[0].fit
    assert "coulomb-friction" in first.added
    assert first.minimum.chi2 < 0.3 * ranking.nominal_fit.minimum.chi2
    assert first.farthest_move < BELIEVABLE
    assert 0.4 < first.value("coulomb-friction.coulomb_torque") * 3.40 / 0.048 < 0.9, "volts"


def test_xl330_the_authors_load_dependent_model_predicts_better(shared: Path) -> None:
    folder = shared / "data" / xl330.MACHINE.folder
    servos = [xl330.read_servo(folder / f"2026-01-15_{xl330.HELDOUT[0]}.json")]
    values = {name: xl330.json.loads((folder / f"xl330_{name}.json").read_text()) for name in ("m1", "m3")}
    error = {name: xl330.closed_loop_error(v, servos, xl330.AUTHORS_GAIN) for name, v in values.items()}
    assert error["m3"] < error["m1"] < 150.0
    assert xl330.friction_level(values["m1"], 1.0, -1.0, 2.0) == pytest.approx(0.012833 + 2.0 * 0.0036617, rel=1e-3)
    assert xl330.friction_level(values["m3"], 1.0, -1.0, 0.0) == pytest.approx(0.0088818 + 0.243329, rel=1e-3)


def test_frc_speed_lags_the_voltage(shared: Path) -> None:
    folder = shared / "data" / frc.MACHINE.folder
    file, _, columns, unit = frc.MECHANISMS[0]
    run = frc.read_sysid(folder / file, "fast-forward", columns, unit)
    assert np.all(np.diff(run.time) > 0.0)
    assert 0.06 < frc.dead_time(run) < 0.12
    with pytest.raises(InputError, match="there is no test 'sideways'"):
        frc.read_sysid(folder / file, "sideways", columns, unit)


def test_no_steps_are_found_in_what_moves_at_a_steady_pace(shared: Path) -> None:
    """The positions of the drivetrain, updated every fourth row, are nearly as far apart as each other."""
    folder = shared / "data" / frc.MACHINE.folder
    for file, _, columns, unit in frc.MECHANISMS:
        runs = [frc.read_sysid(folder / file, test, columns, unit) for test in (*frc.FITTED, *frc.HELDOUT)]
        assert "converter-steps" not in {finding.kind for finding in inspected(runs).findings}


@pytest.mark.slow
def test_odrive_cogging_is_found_at_its_harmonics(shared: Path) -> None:
    folder = shared / "data" / odrive.MACHINE.folder
    first, second = (odrive.read_revolution(folder / f"nocomp_{k}.npy") for k in (0, 1))
    orders = odrive.blind_orders(first)
    assert {7, 14, 28} <= set(orders)
    assert sorted(odrive.blind_orders(second)) == sorted(orders), "either revolution says the same"
    seen = second.signals["torque"]
    left, unexplained = (np.std(seen - odrive.predicted(first, second, chosen)) for chosen in (orders, []))
    assert left < 0.25 * unexplained


def test_the_recordings_of_the_new_machines_are_read_in_si(shared: Path) -> None:
    data = shared / "data"
    for part in laas.parts(data / laas.MACHINE.folder):
        turned = np.gradient(part.signals["position"], part.time)
        assert np.corrcoef(turned, part.signals["speed"])[0, 1] > 0.9, "timestamps jitter"
        there = np.cumsum(part.signals["speed"][:-1] * np.diff(part.time))
        assert np.ptp(part.signals["position"]) == pytest.approx(np.ptp(there), rel=0.1)
    first, last = hall.parts(data / hall.MACHINE.folder)
    assert np.max(np.abs(first.signals["voltage"])) < hall.SUPPLY
    assert np.mean(np.diff(last.signals["speed"]) == 0.0) > 0.9, "held between the edges"
    for name, columns, signal in (*undc.FITTED, *undc.HELDOUT):
        run = undc.read_run(data / undc.MACHINE.folder, name, columns, signal)
        assert np.max(np.abs(run.signals["voltage"])) <= 5.0
        assert np.max(np.abs(run.signals[signal])) < 14.0, "radians"


def test_every_machine_is_fitted_by_hand_too() -> None:
    assert set(HANDS) == set(MACHINES)


def test_the_motor_by_hand_stops_by_friction_and_is_found_again() -> None:
    time = 0.01 * np.arange(600)
    voltage = np.where(np.arange(600) % 200 < 100, 4.0, -1.0) * (np.arange(600) > 10)
    truth = {"gain": 50.0, "damping": 4.0, "dry": 40.0, "delay": 0.015}
    run = Recording(name="made", time=time, signals={"voltage": voltage, "speed": np.zeros(600)})
    speed = shown(truth, run, given="voltage")["speed"]
    assert speed[100] == pytest.approx((50.0 * 4.0 - 40.0) / 4.0, rel=0.05), "where it settles"
    assert np.min(speed) < 0.0
    held = slide({name: np.array([v]) for name, v in truth.items()}, Drive(time=time, given=np.full(600, 0.7)))
    assert not held["speed"].any(), "35 rad/s^2 do not overcome 40"
    run = Recording(name="made", time=time, signals={"voltage": voltage, "speed": speed})
    found = fitted({"gain": 30.0, "damping": 6.0, "dry": 20.0, "delay": 0.005}, [run], given="voltage", seen="speed")
    assert found == pytest.approx(truth, rel=0.02)
    assert rms(run, "speed", shown(found, run, given="voltage")["speed"]) < 0.01 * np.std(speed)


def test_a_section_of_the_page_is_written_anew_and_the_rest_kept(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("above\n<!-- rwn evidence emps -->\nold\n<!-- end -->\nby hand\n", encoding="utf-8")
    with pytest.raises(InputError, match="there is no section for 'ced'"):
        check_sections(page, "rwn evidence", ["emps", "ced"])
    write_section(page, "rwn evidence", "emps", "| new |")
    text = page.read_text(encoding="utf-8")
    assert text.startswith("above\n<!-- rwn evidence emps -->\n| new |\n")
    assert text.endswith("<!-- end -->\nby hand\n")
    assert "old" not in text


def test_an_error_is_in_si_whatever_the_units_of_its_file() -> None:
    found = made_up.found()
    row = next(r for r in found.heldout if (r.signal, r.region) == ("speed", "all"))
    run = rwn.Recording(
        name=row.recording, time=np.arange(3.0), signals={"voltage": np.zeros(3)}, units={"speed": "rpm"}
    )
    for made in (found, in_file_units(found, [run])):
        error = error_of(made, row.recording, "speed", "speed [krad/s]", scale=1e-3)
        assert error.refitted == pytest.approx(1e-3 * row.refitted)
