from __future__ import annotations

import copy
import pickle
import re
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from rwn.errors import InputError
from rwn.model.drives import KINDS, axis
from rwn.model.files import read_model, write_model
from rwn.model.model import Model
from rwn.recording.layout import Column, Layout

DC = {
    "resistance": 0.8102,
    "inductance": 0.0015,
    "torque_constant": 0.105,
    "back_emf_constant": 0.127,
    "inertia": 3.2365e-4,
    "viscous_friction": 7e-5,
}
MODELS = {
    "dc": Model(kind="dc", parameters=DC, uncertainty={"resistance": 0.044}),
    "dc with effects": Model(
        kind="dc",
        parameters={**DC, "coulomb_friction": 0.02},
        effects={
            "coulomb-friction": {"coulomb_torque": 0.1},
            "sensor-rectification": {"exponent": 1.0, "reference_speed": 9.0},
        },
        load={"pendulum": {"mass": 0.49, "length": 0.1}},
    ),
    "linear axis": Model(
        kind="axis",
        linear=True,
        parameters={"inertia": 95.0, "viscous_friction": 300.0},
        uncertainty={"inertia": 0.2},
        recording=Layout(
            columns={
                "force": Column(source='v "ir"', unit="V", scale=35.15065, scale_unit="N/V"),
                "position": Column(source="RawData.qm", unit="mm", scale=-1.0),
            },
            sample_time=0.001,
            initial="estimate",
        ),
    ),
    "lti": Model(kind="lti", order=2, parameters={"b0": 3.0, "b1": -1.0, "a0": 20.0, "a1": 4.0}),
    "lti, to be estimated": Model(kind="lti", order=3, parameters={}),
}


@pytest.mark.parametrize("name", MODELS)
def test_round_trip(name: str, tmp_path: Path) -> None:
    write_model(MODELS[name], tmp_path / "model.toml")
    assert read_model(tmp_path / "model.toml") == MODELS[name]


def _read(tmp_path: Path, text: str) -> Model:
    (tmp_path / "model.toml").write_text(text, encoding="utf-8")
    return read_model(tmp_path / "model.toml")


def test_values_with_units(tmp_path: Path) -> None:
    model = _read(
        tmp_path,
        """[motor]
kind = "dc"
resistance = "400 mohm"
inductance = "0.4 mH"
torque_constant = "55 mNm/A"
back_emf_constant = "5.76 V/krpm"
inertia = "1800 g cm^2"
viscous_friction = "0.01 mNm/rpm"
[uncertainty]
resistance = "10 %"
""",
    )
    assert dict(model.parameters) == pytest.approx(
        {
            "resistance": 0.4,
            "inductance": 4e-4,
            "torque_constant": 0.055,
            "back_emf_constant": 0.0550039,
            "inertia": 1.8e-4,
            "viscous_friction": 9.5493e-5,
        },
        rel=1e-5,
    )
    assert model.uncertainty["resistance"] == pytest.approx(0.1)


def test_the_shaft_alone_is_written_as_a_model_file_has_it() -> None:
    said = KINDS["dc"].halves({"torque_constant": 0.062})
    (line,) = re.findall(r"`(columns[^`]*)`", said)
    assert tomllib.loads(line)["columns"]["torque"] == {
        "source": "<the column of the current>", "unit": "A", "scale": "0.062 N m/A"
    }  # fmt: skip
    assert KINDS["axis"].halves({}) == ""


def test_a_data_sheet_with_one_of_the_two_constants_will_do(tmp_path: Path) -> None:
    path = tmp_path / "motor.toml"
    text = (
        '[motor]\nkind = "dc"\nresistance = 0.8\ninductance = 1e-3\n{} = 0.062\ninertia = 1e-4\n'
        "viscous_friction = 4e-5\n[uncertainty]\n{} = 0.03\n"
    )
    for given, other in (("torque_constant", "back_emf_constant"), ("back_emf_constant", "torque_constant")):
        path.write_text(text.format(given, given))
        model = read_model(path)
        assert model.parameters[other] == model.parameters[given] == 0.062
        assert model.uncertainty == {given: 0.03, other: 0.03}
    path.write_text(text.format("torque_constant", "resistance"))
    assert read_model(path).uncertainty == {"resistance": 0.03}
    path.write_text(text.format("inertia_of_nothing", "resistance"))
    with pytest.raises(InputError, match="unknown key"):
        read_model(path)


def test_a_transfer_function_is_made_monic(tmp_path: Path) -> None:
    model = _read(tmp_path, '[motor]\nkind = "lti"\nnumerator = [8.0]\ndenominator = [2.0, 4.0, 6.0]\n')
    assert model.order == 2
    assert dict(model.parameters) == {"b0": 4.0, "a0": 3.0, "a1": 2.0}


def test_linear_axis_units(tmp_path: Path) -> None:
    text = '[motor]\nkind = "axis"\nlinear = true\ninertia = "95 kg"\nviscous_friction = "0.2 kN s/m"\n'
    model = _read(tmp_path, text)
    assert dict(model.parameters) == pytest.approx({"inertia": 95.0, "viscous_friction": 200.0})
    assert model.drive is axis.LINEAR_AXIS
    with pytest.raises(InputError, match="wrong dimension"):
        _read(tmp_path, text.replace("95 kg", "95 kg m^2"))


def test_a_model_cannot_be_changed_from_outside() -> None:
    mine = dict(DC)
    model = Model(kind="dc", parameters=mine)
    mine["inertia"] = 5.0
    assert model.parameters["inertia"] == DC["inertia"]
    with pytest.raises(TypeError):
        model.parameters["inertia"] = 1.0  # type: ignore[index]


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"kind": "DC"}, "unknown kind 'DC'.*did you mean 'dc'"),
        ({"kind": "DC motor"}, "unknown kind 'DC motor'.*did you mean 'dc'"),
        ({"parameters": {"resistence": 1.0}}, "unknown parameter 'resistence'.*did you mean 'resistance'"),
        ({"uncertainty": {"inertias": 0.1}}, r"\[uncertainty\]: unknown parameter 'inertias'"),
        ({"effects": {"quadratic_drag": {}}}, "unknown effect.*did you mean 'quadratic-drag'"),
        ({"effects": {"quadratic-drag": {"coefficient": 1e-6}}}, r"\[effects.quadratic-drag\]: unknown parameter"),
    ],
)
def test_a_name_that_nobody_knows_is_refused(wrong: dict[str, Any], said: str) -> None:
    given: dict[str, Any] = {"kind": "dc", "parameters": {"resistance": 1.0}}
    with pytest.raises(InputError, match=said):
        Model(**(given | wrong))


def test_where_a_model_came_from_is_no_part_of_it() -> None:
    assert replace(MODELS["dc"], source="a.toml") == MODELS["dc"]


def test_nominal_parameters_are_those_of_the_core() -> None:
    effects = pytest.importorskip("rwn.model.vocabulary")
    known = effects.motor_parameters()
    for drive in KINDS.values():
        for parameter in drive.parameters:
            assert known[parameter.name].unit == parameter.unit


@pytest.mark.parametrize(("linear", "unit"), [(False, "N m"), (True, "N")])
def test_effects_are_written_and_read_in_the_units_of_their_drive(*, linear: bool, unit: str, tmp_path: Path) -> None:
    """An actuator's law is of the input: a dead zone of volts in a motor's, of newtons in an axis'."""
    effects = {"coulomb-friction": {"coulomb_torque": 20.4}, "actuator-deadzone": {"deadzone": 1.5}}
    values = {"inertia": 95.0, "viscous_friction": 203.5}
    model = Model(kind="axis", linear=linear, parameters=values, effects=effects)
    write_model(model, tmp_path / "model.toml")
    text = (tmp_path / "model.toml").read_text(encoding="utf-8")
    assert f"coulomb_torque = 20.4  # {unit}\n" in text
    assert f"deadzone = 1.5  # {unit}\n" in text
    assert [model.unit(name) for name in model.effect_values] == [unit, unit]
    written_out = text.replace("= 20.4", f'= "20.4 {unit}"').replace("= 1.5", f'= "1.5 {unit}"')
    assert _read(tmp_path, written_out).effects == model.effects
    with pytest.raises(InputError, match="wrong dimension"):
        _read(tmp_path, text.replace("= 1.5", '= "1.5 V"'))


@pytest.mark.parametrize("model", MODELS.values(), ids=MODELS)
def test_a_model_is_short_to_look_at_and_can_be_pickled_and_copied(model: Model) -> None:
    assert repr(model).startswith(f"<Model {model.kind}: ")
    assert len(repr(model)) < 200
    assert pickle.loads(pickle.dumps(model)) == model
    assert copy.deepcopy(model) == model
    assert not hasattr(pickle.loads(pickle.dumps(model)).parameters, "update")  # it stays read-only
