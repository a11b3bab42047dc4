"""Units at the edges."""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor

import pint
import pytest

from rwn.errors import InputError
from rwn.recording import units


def test_threads_share_one_registry() -> None:
    units._made.cache_clear()
    with ThreadPoolExecutor(4) as pool:
        made = list(pool.map(lambda _: units._registry(), range(4)))
    assert all(registry is made[0] for registry in made)


def test_a_speed_constant_is_told_from_a_back_emf_constant() -> None:
    with pytest.raises(InputError, match="1 over the number, in V/rpm"):
        units.factor("rpm/V", "V s/rad", where="motor.toml")


@pytest.mark.parametrize(
    ("unit", "si", "size"),
    [
        ("mV", "V", 1e-3),
        ("rpm", "rad/s", math.pi / 30.0),
        ("RPM", "rad/s", math.pi / 30.0),
        ("1/min", "rad/s", math.pi / 30.0),
        ("min^-1", "rad/s", math.pi / 30.0),
        ("r/min", "rad/s", math.pi / 30.0),
        ("U/min", "rad/s", math.pi / 30.0),
        ("Umdr./min", "rad/s", math.pi / 30.0),
        ("tr/min", "rad/s", math.pi / 30.0),
        ("min-1", "rad/s", math.pi / 30.0),
        ("min⁻¹", "rad/s", math.pi / 30.0),
        ("Degrees/s", "rad/s", math.pi / 180.0),
        ("Volts", "V", 1.0),
        ("Amps", "A", 1.0),
        ("amp", "A", 1.0),
        ("mOhm", "ohm", 1e-3),
        ("MOhm", "ohm", 1e6),
        ("Ohms", "ohm", 1.0),
        ("revs/s", "rad/s", 2.0 * math.pi),
        ("rotation", "rad", 2.0 * math.pi),
        ("mNm", "N m", 1e-3),
        ("Nms/rad", "N m s/rad", 1.0),
        ("mVs/rad", "V s/rad", 1e-3),
        ("gcm²", "kg m^2", 1e-7),
        ("Ncm", "N m", 1e-2),
        ("kNm/A", "N m/A", 1e3),
        ("g cm²", "kg m^2", 1e-7),
        ("kgcm^2", "kg m^2", 1e-4),
        ("N·mm", "N m", 1e-3),
        ("V/krpm", "V s/rad", 0.03 / math.pi),
        ("km/h", "m/s", 1.0 / 3.6),
    ],
)
def test_a_unit_is_what_people_write_for_it(unit: str, si: str, size: float) -> None:
    assert units.factor(unit, si, where="x") == pytest.approx(size, rel=1e-12)


@pytest.mark.parametrize("unit", ["min-12", "Furz", "MOHM", "VOLTS", "V?", "V|A", "V & A", "<V"])
def test_what_only_looks_like_a_unit_is_none(unit: str) -> None:
    assert not units.is_unit(unit)


@pytest.mark.parametrize("unit", ["1/s", "Hz", "kHz"])
def test_a_speed_says_which_angle_it_counts(unit: str) -> None:
    with pytest.raises(InputError, match=rf"unit '{unit}' does not say which angle.*like rad/s.*rad, deg or turn"):
        units.factor(unit, "rad/s", where="x")


def test_only_of_a_parameter_may_the_radian_be_left_out() -> None:
    """Ke in V s, as tables of constants have it; a frequency in Hz stays open."""
    assert units.factor("V s", "V s/rad", where="x", strict_angle=False) == 1.0
    assert units.quantity("20 mV s", "V s/rad", where="x") == pytest.approx(0.02)
    for unit, si in (("V s", "V s/rad"), ("N m/rad", "N m")):
        with pytest.raises(InputError, match="which angle"):
            units.factor(unit, si, where="x")
    for unit in ("Hz", "V/Hz"):
        with pytest.raises(InputError, match="which angle"):
            units.factor(unit, "rad/s" if unit == "Hz" else "V s/rad", where="x", strict_angle=False)
    with pytest.raises(InputError, match="which angle"):
        units.factor("N m rad", "N m", where="x", strict_angle=False)


@pytest.mark.parametrize(("unit", "si"), [("A", "V"), ("rad", "rad/s"), ("kg", "kg m^2"), ("V/rad", "rad/s")])
def test_a_unit_of_another_kind_is_refused_with_one_that_would_do(unit: str, si: str) -> None:
    with pytest.raises(InputError) as refused:
        units.factor(unit, si, where="run.csv")
    assert refused.value.what == f"unit '{unit}' has the wrong dimension"
    assert refused.value.where == "run.csv"
    assert refused.value.fix == f"write the unit that the numbers have, for instance {si} ([{si}] in a header)"
    assert not units.has_dimension(unit, si, where="x")


def test_a_share_or_a_count_is_asked_what_it_is_worth() -> None:
    with pytest.raises(InputError) as refused:
        units.factor("%", "V", where="run.csv")
    assert refused.value.fix == 'say what it is worth, with its unit, by a scale: scale = "0.24 V/%", for instance'
    assert not units.has_dimension("%", "rad", where="x"), "a share is no angle"


@pytest.mark.parametrize(
    ("text", "number", "unit"),
    [("19.2/8192", 19.2 / 8192, ""), ("1/8192 turn", 1 / 8192, "turn"), ("3 1/min", 3.0, "1/min"), ("2 /s", 2.0, "/s")],
)  # fmt: skip
def test_a_number_may_be_a_fraction(text: str, number: float, unit: str) -> None:
    assert units.split(text, where="x") == (pytest.approx(number), unit)


def test_a_fraction_has_a_denominator() -> None:
    with pytest.raises(InputError, match="is not a number with a unit"):
        units.split("1/0 turn", where="x")


def test_units_measure_the_same_kind_of_quantity_or_not() -> None:
    assert units.has_dimension("rpm", "rad/s", where="x")
    assert units.has_dimension("km/h", "m/s", where="x")
    with pytest.raises(InputError, match="unknown unit"):
        units.has_dimension("furz", "m/s", where="x")


@pytest.mark.parametrize(("text", "meant"), [("rads/ss", "rad/s"), ("Ohms!", "ohm"), ("mNn*m", "mN\\*m")])
def test_a_slip_is_answered_by_the_unit_that_was_meant(text: str, meant: str) -> None:
    assert not units.is_unit(text)
    with pytest.raises(InputError, match=rf"did you mean '{meant}'"):
        units.factor(text, "V", where="x")


@pytest.mark.parametrize("text", ["furz", "3 +", "(", "V))", "§"])
def test_what_is_no_unit_at_all_is_answered_in_general(text: str) -> None:
    assert not units.is_unit(text)
    with pytest.raises(InputError, match="write the unit in SI or with an SI prefix"):
        units.factor(text, "V", where="x")


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("rpm", "1/min", True),
        ("rpm", "2 rpm", None),
        ("mA", "A", False),
        ("A", "mA", False),
        ("V", "A", False),
        ("A", "V", False),
        ("N m", "mN km", True),
        ("N m", "J", True),
        ("turn/s", "deg/s", False),
    ],
)
def test_units_are_the_same_where_numbers_mean_the_same(one: str, other: str, same: bool | None) -> None:
    if same is None:
        with pytest.raises(InputError, match="unknown unit"):
            units.same(one, other, where="x")
    else:
        assert units.same(one, other, where="x") is same


@pytest.mark.parametrize(
    ("text", "number", "unit"),
    [
        ("0.4 N/V", 0.4, "N/V"), (" -3e-2mH ", -0.03, "mH"), (".5", 0.5, ""),
        ("+7. 1/min", 7.0, "1/min"), ("2E3", 2e3, ""),
    ],
)  # fmt: skip
def test_a_number_stands_before_its_unit(text: str, number: float, unit: str) -> None:
    assert units.split(text, where="x") == (number, unit)


@pytest.mark.parametrize("text", ["mH", "", "half a mH", ",5 mH"])
def test_a_text_without_a_number_is_refused_with_an_example(text: str) -> None:
    with pytest.raises(InputError, match=r'text like "0\.4 N/V"'):
        units.split(text, where="x")
    with pytest.raises(InputError, match=r'text like "0\.4 H"'):
        units.quantity(text, "H", where="x")


def test_a_decimal_comma_is_told() -> None:
    with pytest.raises(InputError, match=r"'1,6e-4 kg m\^2' is not a number.*a point for the decimal comma"):
        units.quantity("1,6e-4 kg m^2", "kg m^2", where="x")


def test_a_quantity_is_text_with_its_unit() -> None:
    assert units.quantity("0.5 mH", "H", where="x") == pytest.approx(5e-4)
    assert units.quantity("0.5", "1", where="x") == 0.5
    with pytest.raises(InputError, match=r"'0\.5' is text without a unit.*write 0\.5, without quotes, or \"0\.5 H\""):
        units.quantity("0.5", "H", where="x")


def test_a_scale_multiplies_the_unit_too() -> None:
    assert units.product("V", "") == "V"
    assert units.factor(units.product("V", "kN/V"), "N", where="x") == pytest.approx(1e3)
    assert units.factor(units.product("V/s", "m/V"), "m/s", where="x") == pytest.approx(1.0)


@pytest.mark.parametrize("unit", ["", "1"])
def test_a_pure_number_is_of_no_kind(unit: str) -> None:
    units.same_dimension(units.sample("V", 2.0) / units.sample("mV", 3.0), unit)
    units.same_dimension(0.5 + units.sample(unit, 3.0), unit)
    with pytest.raises(pint.DimensionalityError):
        units.same_dimension(units.sample("V", 2.0), unit)


def test_a_sample_is_a_value_of_its_unit() -> None:
    units.same_dimension(units.sample("N m", 2.0) * units.sample("rad/s", 3.0), "W")
    assert units.sample("N m", 2.0).magnitude == 2.0
    with pytest.raises(pint.DimensionalityError):
        units.sample("N m", 2.0) + units.sample("A", 1.0)


@pytest.mark.parametrize(
    ("rotary", "linear"),
    [("N m", "N"), ("kg m^2", "kg"), ("rad/s", "m/s"), ("N m/rad", "N/m"), ("V s/rad", "V s/m"), ("V", "V")],
)
def test_a_linear_axis_has_the_units_of_a_line(rotary: str, linear: str) -> None:
    assert units.linear_unit(rotary) == linear


@pytest.mark.parametrize(
    "unit",
    [
        *("s²²²²²²²", "2^2^2^2^2^2^2", "2^(2^(2^(2^(2^(2^2)))))", "((((((10^9)^9)^9)^9)^9)^9)^9", "s^99999999"),
        *("(10)^9", "m" * 81),
    ],
)
def test_a_tower_of_powers_is_no_unit_and_is_not_worked_out(unit: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Found by fuzzing: pint would not come to an end."""
    monkeypatch.setattr(pint.UnitRegistry, "parse_units", lambda *_: pytest.fail("worked out"))
    with pytest.raises(InputError, match="unknown unit"):
        units._parse(unit, where="x")


@pytest.mark.parametrize("unit", ["m/s^2", "m s**-2", "kg m^2 s^(-3) A^-2", "(m/s)^2", "V^0.5", "kg m²/s²"])
def test_powers_as_people_write_them_are_believed(unit: str) -> None:
    units._parse(unit, where="x")
