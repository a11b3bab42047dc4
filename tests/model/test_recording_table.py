"""The table [recording] and the numbers of a model file: read, with the place and the remedy of every slip."""

from __future__ import annotations

import math
import sys
from dataclasses import fields

import pytest

from rwn.errors import InputError
from rwn.model.toml_reader import parse_model
from rwn.recording.layout import Column, Layout

MOTOR = '[motor]\nkind = "dc"\nresistance = 0.8\ninductance = 1.5e-3\ntorque_constant = 0.1\nback_emf_constant = 0.1\n'
MODEL = f"{MOTOR}inertia = 3e-4\nviscous_friction = 7e-5\n"


def _layout(table: str) -> Layout:
    return parse_model(f"{MODEL}[recording]\n{table}\n", where="motor.toml").recording


def _refused(text: str) -> InputError:
    with pytest.raises(InputError) as refused:
        parse_model(text, where="motor.toml")
    assert refused.value.fix
    return refused.value


def test_every_key_is_read() -> None:
    read = _layout(
        'sample_time = "2 ms"\ninitial = "rest"\ninitial_samples = 7\nfrom = 1\nto = "1500 ms"\ndecimate = 3\n'
        'intersample = "bridged"\nprofile = "sysid"\ndelays.speed = "3 ms"\nfilters.current = 0.004\n'
        'columns.speed = { source = "w", unit = "rpm", scale = -2 }\ncolumns.voltage = { unit = "mV" }\n'
        'columns.torque = { source = "u", scale = "0.4 N m/V" }\nrename = { i = "current" }\n'
        "speed_rows = [1, 0]"
    )
    assert read == Layout(
        sample_time=0.002, initial="rest", initial_samples=7, start=1.0, end=1.5, decimate=3, intersample="bridged",
        profile="sysid", delays={"speed": 0.003}, filters={"current": 0.004}, speed_rows=(1, 0),
        columns={
            "speed": Column(source="w", unit="rpm", scale=-2.0), "voltage": Column(source="voltage", unit="mV"),
            "torque": Column(source="u", scale=0.4, scale_unit="N m/V"), "current": Column(source="i"),
        },
    )  # fmt: skip
    assert all(getattr(read, f.name) != getattr(Layout(), f.name) for f in fields(Layout)), "each was given"
    assert parse_model(MODEL, where="motor.toml").recording == Layout()


@pytest.mark.parametrize(
    ("table", "what", "where"),
    [
        ("sample_time = 0", "sample_time is 0 s", "motor.toml, [recording]"),
        ("sample_time = -1e-3", "sample_time is -0.001 s", "motor.toml, [recording]"),
        ("initial_samples = 0", "initial_samples is 0", "motor.toml, [recording]"),
        ("decimate = 0", "decimate is 0", "motor.toml, [recording]"),
        ("speed_rows = [1, -1]", "speed_rows is [1, -1]", "motor.toml, [recording] speed_rows"),
        ("from = 2\nto = 2", "from is 2 s, to is 2 s", "motor.toml, [recording]"),
        ("from = 3\nto = 2", "from is 3 s, to is 2 s", "motor.toml, [recording]"),
        ("filters.speed = 0", "the filter of the speed has a time constant of 0 s", "motor.toml, [recording] filters"),
        ("filters.speed = -1", "the filter of the speed has a time constant of -1 s",
         "motor.toml, [recording] filters"),
        ("filters.speed = inf", "the filter of the speed has a time constant of inf s",
         "motor.toml, [recording] filters"),
        ("delays.voltage = 0.1", "unknown measured signal 'voltage'", "motor.toml, [recording] delays"),
        ("columns.speed = { scale = 0 }", "scale is 0", "motor.toml, [recording] columns.speed"),
        ("columns.speed = { scale = 9e-16 }", "scale is 9e-16", "motor.toml, [recording] columns.speed"),
        ("columns.speed = { scale = -1.1e15 }", "scale is -1100000000000000.0",
         "motor.toml, [recording] columns.speed"),
        ('columns.speed = { scale = "rpm" }', "'rpm' is not a number with a unit",
         "motor.toml, [recording] columns.speed"),
        ("columns.sped = { scale = 2 }", "unknown signal 'sped'", "motor.toml, [recording] columns.sped"),
        ('rename = { w = "sped" }', "unknown signal 'sped'", "motor.toml, [recording] rename"),
        ('rename = { w = "speed", v = "speed" }', "'speed' is mapped and renamed to", "motor.toml, [recording] rename"),
        ('profile = "odriv"', "unknown profile 'odriv'", "motor.toml, [recording] profile"),
        ('intersample = "bridge"', "unknown", "motor.toml, [recording] intersample"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_refused_where_it_stands(table: str, what: str, where: str) -> None:
    said = _refused(f"{MODEL}[recording]\n{table}\n")
    assert said.what.startswith(what)
    assert said.where == where


@pytest.mark.parametrize("scale", ["1e-15", "-1e-15", "1e15", "-1e15"])
def test_scales_may_be_very_large_or_small(scale: str) -> None:
    assert _layout(f"columns.speed = {{ scale = {scale} }}").columns["speed"].scale == float(scale)


@pytest.mark.parametrize("key", ["initial_samples", "decimate"])
def test_one_of_what_is_counted_will_do(key: str) -> None:
    assert getattr(_layout(f"{key} = 1"), key) == 1


def test_one_end_of_a_stretch_will_do() -> None:
    assert (_layout("from = 3").start, _layout("from = 3").end) == (3.0, None)
    assert (_layout("to = -3").start, _layout("to = -3").end) == (None, -3.0)


@pytest.mark.parametrize(
    ("line", "got", "expected"),
    [
        ('columns.speed = { source = 3, unit = "rad/s" }', "a number", "text in quotes"),
        ("from = true", "true or false", "a number, or text with a unit"),
        ("decimate = 1.5", "a number", "a whole number"),
        ("columns = [1]", "a list", "a table"),
    ],
)
def test_a_key_of_another_type_is_refused_in_words(line: str, got: str, expected: str) -> None:
    said = _refused(f"{MODEL}[recording]\n{line}\n")
    assert (said.what, said.expected) == (f"the value is {got}", expected)


@pytest.mark.parametrize(
    ("value", "kind"), [("true", "true or false"), ("[1]", "list"), ("{ a = 1 }", "dict"), ("1979-05-27", "date")]
)
def test_a_value_is_a_number_or_a_text_with_a_unit(value: str, kind: str) -> None:
    said = _refused(MODEL.replace("inertia = 3e-4", f"inertia = {value}"))
    assert said.what == f"the value is {kind}"
    assert said.where == "motor.toml, [motor] inertia"
    assert said.fix == 'write for instance 0.4 or "0.4 kg m^2"'


def test_a_number_too_long_for_one_is_infinite_and_refused() -> None:
    assert "the value is inf" in _refused(MODEL.replace("inertia = 3e-4", f"inertia = {10**400}")).what


@pytest.mark.parametrize(
    ("given", "read"), [("0.1", 0.1), ('"10 %"', 0.1), ("inf", math.inf), ("1", 1.0), ('"3"', 3.0)]
)
def test_an_uncertainty_is_relative(given: str, read: float) -> None:
    model = parse_model(f"{MODEL}[uncertainty]\ninertia = {given}\n", where="motor.toml")
    assert model.uncertainty == {"inertia": pytest.approx(read)}


def test_what_is_not_known_at_all_is_written_so_and_a_huge_number_is_a_slip() -> None:
    said = _refused(f'{MODEL}[uncertainty]\ninertia = "1e999"\n')
    assert said.what == f"the value is {sys.float_info.max}"


def test_an_effect_has_uncertainties_of_its_own() -> None:
    friction = "[effects.coulomb-friction]\ncoulomb_torque = 0.01\n"
    doubt = "[uncertainty]\ncoulomb-friction.coulomb_torque = 0.2\ninertia = 0.1\n"
    read = parse_model(MODEL + friction + doubt, where="motor.toml")
    assert read.uncertainty == {"coulomb-friction.coulomb_torque": 0.2, "inertia": 0.1}
    said = _refused(MODEL + doubt)
    assert said.what == "coulomb-friction is a table, and there is no effect of that name"
    assert said.where == "motor.toml, [uncertainty]"


@pytest.mark.parametrize(
    ("motor", "what"),
    [
        ("linear = false", "there is no kind"),
        ("kind = 3", "kind is 3"),
        ('kind = "d"', "unknown kind 'd'"),
        ('kind = "dc"\nlinear = true', "linear is True"),
        ('kind = "axis"\nlinear = 1', "linear is 1"),
        ('kind = "axis"\ninertai = 1', "unknown key 'inertai'"),
    ],
)
def test_the_drive_is_one_that_there_is(motor: str, what: str) -> None:
    said = _refused(f"[motor]\n{motor}\n")
    assert said.what.startswith(what)
    assert said.where == "motor.toml, [motor]"


def test_a_linear_axis_has_a_mass_in_kg() -> None:
    text = '[motor]\nkind = "axis"\nlinear = {}\ninertia = "{}"\nviscous_friction = 1\n'
    assert parse_model(text.format("true", "2000 g"), where="x").parameters["inertia"] == pytest.approx(2.0)
    assert parse_model(text.format("true", "2000 g"), where="x").linear
    assert "wrong dimension" in _refused(text.format("false", "2000 g")).what
    assert not parse_model(text.format("false", "2 kg m^2"), where="x").linear


def test_effects_are_known_and_bring_one_second_mass_at_most() -> None:
    said = _refused(f"{MODEL}[effects.coulomb-frction]\ncoulomb_torque = 1\n")
    assert (said.where, said.fix) == ("motor.toml, [effects]", "did you mean 'coulomb-friction'?")
    said = _refused(f"{MODEL}[effects.coulomb-friction]\ntorque = 1\n")
    assert (said.what, said.where) == ("unknown parameter 'torque'", "motor.toml, [effects.coulomb-friction]")
    model = parse_model(f'{MODEL}[effects.coulomb-friction]\ncoulomb_torque = "10 mN m"\n', where="x")
    assert model.effects == {"coulomb-friction": {"coulomb_torque": pytest.approx(0.01)}}


def test_a_pendulum_hangs_on_a_shaft() -> None:
    load = '[load.pendulum]\nmass = "300 g"\nlength = 0.1\n'
    read = parse_model(MODEL + load, where="x")
    assert read.load == {"pendulum": {"mass": pytest.approx(0.3), "length": 0.1}}
    said = _refused('[motor]\nkind = "axis"\nlinear = true\ninertia = 1\nviscous_friction = 1\n' + load)
    assert (said.what, said.where) == ("a pendulum on a drive without a shaft", "motor.toml, [load.pendulum]")
