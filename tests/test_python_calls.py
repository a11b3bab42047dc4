"""What is made in Python is checked as files are: every call gives a result or one clear line, never anything else."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import made_up
import rwn
from rwn.errors import InputError

TIME = np.arange(200) * 1e-3
VOLTAGE = 5.0 * np.sin(TIME * 60.0)
SPEED = 40.0 * np.sin(TIME * 60.0 - 0.7)
CURRENT = 0.3 * np.cos(TIME * 60.0)
MOTOR = {
    "resistance": 0.8, "inductance": 1.5e-3, "torque_constant": 0.1, "back_emf_constant": 0.1, "inertia": 3e-4,
    "viscous_friction": 7e-5,
}  # fmt: skip
MODEL = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1})


def _recording(time: Any = TIME, **changed: Any) -> rwn.Recording:
    signals = {"voltage": VOLTAGE, "current": CURRENT, "speed": SPEED, **changed}
    return rwn.Recording(name="run", time=time, signals={n: x for n, x in signals.items() if x is not None})


def _with(values: np.ndarray, at: int, value: float) -> np.ndarray:
    return np.where(np.arange(values.size) == at, value, values)


CALLS: dict[str, Callable[..., Any]] = {
    "diagnose": lambda recordings, model=MODEL: rwn.diagnose(recordings, model, jobs=1),
    "identify": lambda recordings, model=MODEL: rwn.identify(recordings, model),
    "simulate": lambda recordings, model=MODEL: rwn.simulate(
        model, recordings[0] if isinstance(recordings, list) and recordings else recordings
    ),
    "read_recordings": lambda recordings, model=MODEL: rwn.read_recordings(recordings, model),
}

# what is wrong: (the recordings, what the line must hold)
RECORDINGS: dict[str, tuple[Callable[[], Any], str]] = {
    "a NaN in the speed": (lambda: [_recording(speed=_with(SPEED, 7, np.nan))], "sample 8: speed is nan"),
    "an infinity in the voltage": (lambda: [_recording(voltage=_with(VOLTAGE, 7, np.inf))], "voltage is inf"),
    "a NaN in the time": (lambda: [_recording(_with(TIME, 9, np.nan))], "time is nan"),
    "time reversed": (lambda: [_recording(TIME[::-1])], "runs back"),
    "time constant": (lambda: [_recording(0.0 * TIME)], "stands still"),
    "an instant twice": (lambda: [_recording(_with(TIME, 50, TIME[49]))], "stands still"),
    "a gap": (lambda: [_recording(TIME + 5.0 * (np.arange(200) > 99))], "a gap of 5"),
    "no samples": (lambda: [rwn.Recording(name="run", time=[], signals={"voltage": [], "speed": []})], "0 samples"),
    "no voltage": (lambda: [_recording(voltage=None)], "there is no 'voltage'"),
    "a voltage of 1e30 V": (lambda: [_recording(voltage=1e30 * VOLTAGE)], "voltage goes to"),
    "a voltage of 1e-100 V": (lambda: [_recording(voltage=1e-100 * VOLTAGE)], "voltage goes to"),
    "no recording but a number": (lambda: 3, "cannot be read from the int"),
    "no recording but None": (lambda: None, "cannot be read from the NoneType"),
    "a file that is not there": (lambda: "nowhere.csv", "no such file"),
    "a table without units": (lambda: {"time": TIME, "voltage": VOLTAGE}, "'time', 'voltage' have no unit"),
    "a table without a known column": (lambda: {"a": TIME}, "no column is called like a signal"),
}
COMPARED: dict[str, tuple[Callable[[], Any], str]] = {
    "nothing measured": (lambda: [_recording(current=None, speed=None)], "there is no 'speed'"),
    "a speed that is constant": (lambda: [_recording(speed=0.0 * SPEED)], "'speed' is constant"),
    "ten samples": (
        lambda: [_recording(TIME[:10], voltage=VOLTAGE[:10], speed=SPEED[:10], current=None)], "10 samples",
    ),
    "the same twice": (lambda: [_recording(), _recording()], "given twice"),
    "the same by another name": (lambda: [_recording(), replace(_recording(), name="b")], "given twice"),
    "a piece of the other": (
        lambda: [
            _recording(),
            _recording(TIME[:80] + 3.0, voltage=VOLTAGE[90:170], current=None, speed=SPEED[90:170]),
        ],
        "given twice",
    ),
}
# what is wrong: (what the model is made of, what the line must hold)
MODELS: dict[str, tuple[dict[str, Any], str]] = {
    "no inertia": ({"parameters": {n: v for n, v in MOTOR.items() if n != "inertia"}}, "there is no inertia"),
    "nothing": ({"parameters": {}}, "there is no resistance"),
    "a negative inertia": ({"parameters": {**MOTOR, "inertia": -6e-5}}, "inertia is -6e-05"),
    "an inertia of NaN": ({"parameters": {**MOTOR, "inertia": np.nan}}, "inertia: the value is nan"),
    "an inertia of infinity": ({"parameters": {**MOTOR, "inertia": np.inf}}, "inertia: the value is inf"),
    "an inertia of text": ({"parameters": {**MOTOR, "inertia": "small"}}, "inertia: the value is 'small'"),
    "an inertia of a number as text": ({"parameters": {**MOTOR, "inertia": "3e-4"}}, "inertia: the value is '3e-4'"),
    "an inertia of 400 digits": ({"parameters": {**MOTOR, "inertia": 10**400}}, "inertia: the value is 1000"),
    "an uncertainty of -1": ({"uncertainty": {"inertia": -1.0}}, "inertia is -1"),
    "an uncertainty of NaN": ({"uncertainty": {"inertia": np.nan}}, "the value is nan"),
    "an uncertainty of 5, which is a percentage": ({"uncertainty": {"inertia": 5.0}}, "inertia is 5, that is 500 %"),
    "an uncertainty of 1e300": ({"uncertainty": {"inertia": 1e300}}, "the value is 1e+300"),
    "an uncertainty of what is 0": (
        {"parameters": {**MOTOR, "viscous_friction": 0.0}, "uncertainty": {"viscous_friction": 0.1}},
        "relative to a nominal value of 0",
    ),
    "an effect without values": ({"effects": {"coulomb-friction": {}}}, "there is no coulomb_torque"),
    "a negative friction": ({"effects": {"coulomb-friction": {"coulomb_torque": -1.0}}}, "coulomb_torque is -1 N m"),
    "a negative delay": ({"effects": {"input-delay": {"delay": -1.0}}}, "delay is -1 s"),
    "a friction of 1e30": ({"effects": {"coulomb-friction": {"coulomb_torque": 1e30}}}, "the value is 1e+30"),
    "a ratio above its bound": ({"effects": {"load-dependent-friction": {"friction_ratio": 2.0}}}, "0 to 0.9"),
    "a load without a mass": ({"load": {"pendulum": {"length": 0.1}}}, "there is no mass"),
    "a load that there is not": ({"load": {"spring": {"stiffness": 0.1}}}, "unknown load 'spring'"),
    "no kind": ({"kind": ""}, "unknown kind"),
}  # fmt: skip


@pytest.mark.parametrize("lost", [[7], np.zeros(199, dtype=bool), np.zeros(200), None])
def test_what_flags_no_samples_is_refused(lost: Any) -> None:
    with pytest.raises(InputError, match=r"^run: missing of 'speed' has shape .*; expected shape \(200,\), bool; fix"):
        replace(_recording(), missing={"speed": lost})
    assert replace(_recording(), missing={"speed": [False] * 200}).missing["speed"].dtype == bool


@pytest.mark.parametrize("case", RECORDINGS)
@pytest.mark.parametrize("call", CALLS)
def test_recordings_that_cannot_be_used_are_refused(call: str, case: str) -> None:
    made, held = RECORDINGS[case]
    with pytest.raises(InputError) as refused:
        CALLS[call](made())
    assert held in str(refused.value)
    assert "; fix: " in str(refused.value)


@pytest.mark.parametrize("case", COMPARED)
@pytest.mark.parametrize("call", [name for name in CALLS if name != "simulate"])
def test_recordings_that_say_nothing_are_refused(call: str, case: str) -> None:
    made, held = COMPARED[case]
    with pytest.raises(InputError) as refused:
        CALLS[call](made())
    assert held in str(refused.value)


@pytest.mark.parametrize("case", MODELS)
def test_models_that_no_drive_has_are_refused(case: str) -> None:
    wrong, held = MODELS[case]
    given: dict[str, Any] = {"kind": "dc", "parameters": MOTOR}
    with pytest.raises(InputError) as refused:
        rwn.Model(**(given | wrong))
    assert held in str(refused.value)
    assert "; fix: " in str(refused.value)


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("model", [None, 3, {"kind": "dc"}, b"model.toml"])
def test_what_is_no_model_is_refused(call: str, model: Any) -> None:
    if call != "read_recordings":
        with pytest.raises(InputError, match="a model cannot be read from the"):
            CALLS[call]([_recording()], model)


@pytest.mark.parametrize("call", ["diagnose", "identify"])
def test_no_recording_at_all_is_refused(call: str) -> None:
    with pytest.raises(InputError, match="no recording is given"):
        CALLS[call]([])


@pytest.mark.parametrize(
    ("options", "held"),
    [
        ({"jobs": 0}, "jobs is 0"),
        ({"jobs": -4}, "jobs is -4"),
        ({"jobs": 1.5}, "jobs is 1.5"),
        ({"jobs": "2"}, "jobs is '2'"),
        ({"effort": 0}, "effort is 0"),
        ({"effort": float("nan")}, "effort is nan"),
        ({"effort": "3"}, "effort is '3'"),
        ({"seed": -1}, "seed is -1"),
        ({"seed": 0.5}, "seed is 0.5"),
        ({"heldout": [_recording()]}, "given twice"),
        ({"heldout": replace(_recording(), name="copy")}, "given twice"),
        ({"heldout": [3]}, "cannot be read from the int"),
    ],
)
def test_options_that_make_no_sense_are_refused_before_the_search(options: dict[str, Any], held: str) -> None:
    with pytest.raises(InputError, match="fix: ") as refused:
        rwn.diagnose([_recording()], MODEL, **options)
    assert held in str(refused.value)


def test_a_linear_dc_motor_is_refused() -> None:
    with pytest.raises(InputError, match="linear is True"):
        rwn.Model(kind="dc", parameters=MOTOR, linear=True)


def test_paths_tables_and_recordings_give_the_same(tmp_path: Path) -> None:
    table = {"time [s]": TIME, "voltage [V]": VOLTAGE, "speed [rad/s]": SPEED}
    columns = (TIME.tolist(), VOLTAGE.tolist(), SPEED.tolist())
    rows = "".join(f"{t!r},{u!r},{w!r}\n" for t, u, w in zip(*columns, strict=True))
    (tmp_path / "run.csv").write_text(",".join(table) + "\n" + rows)
    motor = "".join(f"{name} = {value!r}\n" for name, value in MOTOR.items())
    (tmp_path / "motor.toml").write_text(f'[motor]\nkind = "dc"\n{motor}[uncertainty]\ninertia = 0.1\n')
    made = _recording(current=None)
    fits = [
        rwn.identify(made, MODEL),
        rwn.identify([str(tmp_path / "run.csv")], tmp_path / "motor.toml"),
        rwn.identify(table, str(tmp_path / "motor.toml")),
    ]
    assert fits[0].parameters == fits[1].parameters == fits[2].parameters
    (read,) = rwn.read_recordings(tmp_path / "run.csv", MODEL)
    np.testing.assert_array_equal(read.time, made.time)
    np.testing.assert_array_equal(read.signals["speed"], made.signals["speed"])
    np.testing.assert_array_equal(
        rwn.simulate(tmp_path / "motor.toml", table).signals["speed"], rwn.simulate(MODEL, made).signals["speed"]
    )


@pytest.mark.parametrize(
    ("call", "held"),
    [
        (lambda: rwn.Recording(name="r", time=TIME, signals=None), "signals is None; expected a dictionary"),  # type: ignore[arg-type]
        (lambda: rwn.read_model(None), "the path is None"),  # type: ignore[arg-type]
        (lambda: rwn.Diagnosis.load(None), "the path is None"),  # type: ignore[arg-type]
        (lambda: rwn.Diagnosis.load(Path(__file__).parent), "there is no diagnosis.json in this folder"),
        (lambda: rwn.save(MODEL, None), "the path is None"),  # type: ignore[arg-type]
        (lambda: made_up.found().save(None), "the path is None"),  # type: ignore[arg-type]
        (lambda: made_up.found().plot(3), "unknown figure '3'"),  # type: ignore[arg-type]
        (lambda: rwn.diagnose(_recording(), MODEL, progress="x"), "progress is 'x'"),  # type: ignore[arg-type]
        (lambda: rwn.plot(made_up.found()), "its method plot()"),
        (lambda: _recording(speed=np.ma.masked_greater(SPEED, 39.0)), "samples of 'speed' are masked"),
        (lambda: _recording(np.ma.masked_greater(TIME, 0.1)), "samples of 'time' are masked"),
        (
            lambda: rwn.read_recording({"time [s]": TIME, "speed [rad/s]": np.ma.masked_greater(SPEED, 39.0)}),
            "samples of 'speed' are masked",
        ),
        (lambda: _recording(speed=SPEED > 0.0), "'speed' is no vector of real numbers"),
        (lambda: replace(MODEL, order=-1), "order is -1"),
        (lambda: rwn.Model(kind="lti", parameters={}, order=0), "order is 0"),
        (lambda: rwn.Model(kind="lti", parameters={}, order=True), "order is True"),
    ],
)
def test_what_no_call_can_take_is_refused(call: Callable[[], Any], held: str) -> None:
    with pytest.raises(InputError, match="; fix: ") as said:
        call()
    assert held in str(said.value)


def test_a_mask_that_masks_nothing_is_no_matter() -> None:
    assert _recording(speed=np.ma.masked_greater(SPEED, 1e9)) == _recording()


def test_a_model_may_be_its_file_wherever_one_is_taken(tmp_path: Path) -> None:
    rwn.save(MODEL, tmp_path / "motor.toml")
    rwn.save(_recording(), tmp_path / "run.csv")
    (read,) = rwn.read_recordings(str(tmp_path / "run.csv"), str(tmp_path / "motor.toml"))
    assert list(read.signals) == ["voltage", "current", "speed"]


def test_a_simulation_is_a_table_that_is_read_again() -> None:
    made = rwn.simulate(MODEL, _recording())
    again = rwn.read_recording(made.table())
    np.testing.assert_array_equal(again.signals["speed"], made.signals["speed"])
    np.testing.assert_array_equal(again.time, TIME)
