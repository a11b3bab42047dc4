"""Every bad model ends alike: exit code 2, one line with the place and the remedy, nothing written."""

from __future__ import annotations

import pytest

from bad_input import MODEL, Refuse, csv_text


def _model(old: str, new: str) -> str:
    assert old in MODEL
    return MODEL.replace(old, new)


LTI = '[motor]\nkind = "lti"\norder = 1\n'
MODELS: dict[str, tuple[str, tuple[str, ...]]] = {
    "empty model": ("", ("no table [motor]", 'kind = "dc"')),
    "not TOML": (_model("resistance = 0.81", "resistance = 0,81"), ("not valid TOML", "line 4")),
    "misspelt table": (
        _model("[uncertainty]", "[uncertanty]"),
        ("'uncertanty'", "did you mean 'uncertainty'"),
    ),
    "misspelt motor": (_model("[motor]", "[moter]"), ("[motor]", "[moter]")),
    "misspelt key": (_model("inductance", "inductence"), ("'inductence'", "did you mean 'inductance'")),
    "missing key": (_model("inertia = 3.2e-4\n", ""), ("no inertia", "kg m^2", "[motor]")),
    "no kind": (_model('kind = "dc"\n', ""), ("no kind", '"dc"')),
    "unknown kind": (_model('"dc"', '"ac"'), ("unknown kind 'ac'", "dc, axis, lti")),
    "linear dc": (_model('"dc"', '"dc"\nlinear = true'), ("linear", "axis")),
    "true for a number": (_model("3.2e-4", "true"), ("inertia", "true or false", "kg m^2")),
    "list for a number": (_model("3.2e-4", "[1.0]"), ("inertia", "list", "kg m^2")),
    "text for a number": (_model("3.2e-4", '"small"'), ("inertia", "'small'", "kg m^2")),
    "wrong unit": (_model('"1.5 mH"', '"1.5 mF"'), ("inductance", "'mF'", "wrong dimension")),
    "unknown unit": (_model('"1.5 mH"', '"1.5 mHenri"'), ("inductance", "unknown unit 'mHenri'")),
    "negative inertia": (_model("3.2e-4", "-3.2e-4"), ("inertia is -0.00032", "positive")),
    "zero resistance": (_model("0.81", "0.0"), ("resistance is 0", "positive")),
    "negative friction": (_model("7e-5", "-7e-5"), ("viscous_friction", "not negative")),
    "nan": (_model("7e-5", "nan"), ("viscous_friction", "the value is nan", "finite")),
    "doubt of nothing": (
        _model("inertia = 0.1", "mass = 0.1"),
        ("unknown parameter 'mass'", "[uncertainty]"),
    ),
    "negative doubt": (_model("inertia = 0.1", "inertia = -0.1"), ("inertia is -0.1", "0.1 = 10 %")),
    "doubt that is a table": (_model("inertia = 0.1", "inertia = { a = 1 }"), ("uncertainty", "a number")),
    "unknown effect": (
        MODEL + "[effects.coulomb]\ncoulomb_torque = 1\n",
        ("effect 'coulomb'", "coulomb-friction"),
    ),
    "unknown effect parameter": (
        MODEL + "[effects.coulomb-friction]\ncoulomb_torqe = 1.0\n",
        ("'coulomb_torqe'", "did you mean 'coulomb_torque'"),
    ),
    "an effect without a term": (
        '[motor]\nkind = "axis"\ninertia = 1e-4\nviscous_friction = 1e-5\n[effects.pwm-supply-sag]\nsag = 1e-3\n',
        ("pwm-supply-sag acts on the voltage", "a drive of kind axis has no equation", "load, sensor, torque"),
    ),
    "an own effect without a term": (
        '[motor]\nkind = "axis"\ninertia = 1e-4\nviscous_friction = 1e-5\n[own_effects.arc]\nterm = "drop"\n'
        'equation = "a*current"\nparameters.a = { unit = "ohm", start = 0.1, lower = 0, upper = 1, strength = true }\n',
        ("[own_effects.arc]", "acts on the voltage", "a drive of kind axis has no equation"),
    ),
    "a part of a further line": (
        MODEL + "[effects.cogging-torque]\namplitude = 0.01\nperiods_per_rev = 7\nphase = 0\nperiods_per_rev_3 = 14\n",
        ("there is no amplitude_3", "N m", "add amplitude_3"),
    ),
    "a load that ends before it begins": (
        MODEL + "[effects.load-disturbance]\ntorque = 0.01\nt_start = 1.0\nt_end = 0.5\n",
        ("t_end is 0.5 s, t_start 1: it never acts", "exchange the two"),
    ),
    "two second masses": (
        MODEL
        + "[effects.backlash]\ngap = 0.1\nload_inertia = 1e-5\ncontact_rate = 1e3\n"
        + "contact_damping_ratio = 0.3\nload_viscous_share = 0.3\n"
        + "[effects.shaft-compliance]\nstiffness = 1.0\ndamping = 0.01\nload_inertia = 1e-5\n"
        + "load_viscous_share = 0.3\n",
        ("backlash and shaft-compliance each bring a second mass", "one of them"),
    ),
    "effect without values": (MODEL + "[effects.coulomb-friction]\n", ("no coulomb_torque", "N m")),
    "unknown load": (MODEL + "[load.pendulm]\nmass = 1.0\n", ("'pendulm'", "did you mean 'pendulum'")),
    "order of a motor": (_model('"dc"', '"dc"\norder = 2'), ("'order'", "[motor]")),
    "pendulum on a transfer function": (
        LTI + "[load.pendulum]\nmass = 1.0\nlength = 0.1\n",
        ("without a shaft", "dc or axis", "[load.pendulum]"),
    ),
    "misspelt coefficients": (LTI + "denominater = [1.0, 2.0]\n", ("'denominater'", "did you mean 'denominator'")),
    "coefficient that is no number": (
        LTI + 'numerator = [1.0]\ndenominator = [1.0, "2"]\n',
        ("denominator is [1.0, '2']", "highest power first"),
    ),
    "coefficients of another order": (
        LTI + "numerator = [1.0]\ndenominator = [1.0, 2.0, 3.0]\n",
        ("numerator has 1 and denominator 3", "1 to 1 and 2 for order 1"),
    ),
    "weightless pendulum": (MODEL + "[load.pendulum]\nmass = 0.0\nlength = 0.1\n", ("mass is 0", "positive")),
    "map of an unknown signal": (
        MODEL + '[recording]\ncolumns.sped = { source = "x" }\n',
        ("'sped'", "'speed'"),
    ),
    "map without source": (
        MODEL + '[recording]\ncolumns.speed = { unit = "rpm" }\n',
        ("column 'speed'", "the column is in [rad/s], the map says 'rpm'"),
    ),
    "map with a wrong key": (
        MODEL + '[recording]\ncolumns.speed = { source = "w", units = "rpm" }\n',
        ("'units'", "did you mean 'unit'"),
    ),
    "map to a column that is not there": (
        MODEL + '[recording]\ncolumns.speed = { source = "w", unit = "rpm" }\n',
        ("no column 'w'", "mapped to speed"),
    ),
    "scale of zero": (
        MODEL + '[recording]\ncolumns.speed = { source = "speed", scale = 0 }\n',
        ("scale is 0",),
    ),
    "unknown start": (MODEL + '[recording]\ninitial = "moving"\n', ("moving", "[recording.initial]")),
    "own parameter without a start": (
        MODEL + '[own_effects.a]\nterm = "torque"\nequation = "g * speed"\n[own_effects.a.parameters.g]\n'
        'unit = "N m s/rad"\nlower = 0.0\nupper = 1.0\n',
        ("[own_effects.parameters]: 'start' is missing; expected start = ..; fix: add it",),
    ),
    "sample time of zero": (MODEL + "[recording]\nsample_time = 0\n", ("sample_time is 0", "positive")),
}


@pytest.mark.parametrize("case", MODELS)
def test_bad_model(case: str, refuse: Refuse) -> None:
    text, held = MODELS[case]
    line = refuse(csv_text(), text)
    assert "model.toml" in line or "run.csv" in line
    assert "; expected " in line
    assert "; fix: " in line
    for part in held:
        assert part in line


def test_there_are_enough_bad_models() -> None:
    assert len(MODELS) >= 30


def test_missing_model(refuse: Refuse) -> None:
    line = refuse(csv_text(), None)
    assert "model.toml" in line
    assert "no such file" in line


def test_a_recording_of_megabytes_given_as_model(refuse: Refuse) -> None:
    line = refuse(csv_text(), "0.0,1.0\n" * 2**18)
    assert "larger than 1 MB" in line
    assert "was a recording given as --model?" in line


def test_recording_given_as_model(refuse: Refuse) -> None:
    said = refuse(csv_text(), csv_text())
    assert "not valid TOML" in said
    assert "fix: was a recording given as --model?" in said
