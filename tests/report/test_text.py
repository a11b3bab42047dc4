from __future__ import annotations

import math
from dataclasses import replace

import pytest

import made_up
from rwn.decide.account import Remainder
from rwn.decide.shaft_alone import ShaftAlone
from rwn.fit.intervals import Estimate
from rwn.mismatch_map.regions import Region
from rwn.prove.proof import LEFT_OUT
from rwn.report import text as words
from rwn.report.assemble import from_near
from rwn.report.diagnosis_data import Alternative, Location
from rwn.report.next_steps import next_steps
from rwn.report.page import page
from rwn.report.proof_sentences import before_after, headline
from rwn.report.sentences import verdict_sentence
from rwn.report.terminal import lines


@pytest.mark.parametrize(
    ("value", "unit", "interval", "text"),
    [
        (20.4, "N", (20.1, 20.7), "20.4 ± 0.3 N"),
        (0.0208, "N m", (0.0203, 0.0213), "20.8 ± 0.5 mN m"),
        (0.815, "ohm", (0.799, 0.831), "0.815 ± 0.016 Ω"),
        (1.8e-4, "kg m^2", (1.7e-4, 1.9e-4), "(1.80 ± 0.10)×10⁻⁴ kg m²"),
        (0.0121, "rad", (0.009, 0.019), "0.0121 rad [0.00900, 0.0190]"),
        (-3.1648, "N", (-3.3, -3.03), "−3.16 ± 0.14 N"),
        (250.0, "rad/s", None, "250 rad/s"),
        (4.2e-5, "s", (4.1e-5, 4.3e-5), "42.0 ± 1.0 µs"),
        (0.43, "1", (0.38, 0.48), "0.43 ± 0.05"),
        (0.43, "1", (0.43, 0.43), "0.430"),
        (20.4, "N", (-math.inf, math.inf), "20.4 N"),
        (math.nan, "N", None, "– N"),
    ],
)
def test_estimates_read_well(value: float, unit: str, interval: tuple[float, float] | None, text: str) -> None:
    assert words.estimate(Estimate(value=value, unit=unit, interval=interval)) == text


@pytest.mark.parametrize("state", made_up.ALL)
def test_the_verdict_is_one_sentence_or_two(state: str) -> None:
    sentence = verdict_sentence(made_up.ALL[state]())
    assert sentence.endswith(".")
    assert "  " not in sentence
    assert 30 < len(sentence) < 300


def test_a_set_names_every_member() -> None:
    sentence = verdict_sentence(made_up.ambiguous())
    assert "backlash, shaft compliance or presliding hysteresis" in sentence
    assert "cannot tell" in sentence


def test_what_a_name_leaves_is_said_beside_it() -> None:
    found = made_up.found()
    assert "no name here" not in verdict_sentence(found)
    left = replace(found, remainder=Remainder(share=0.12, error=3.0, signals=("speed",)))
    assert verdict_sentence(left).startswith("The model lacks ")
    assert "What it leaves of the speed, 12 % of the mismatch, is not noise" in verdict_sentence(left)


@pytest.mark.parametrize(("added", "who"), [
    (("coulomb-friction", "unbalance"), "them"), ((), "them"), (("unbalance",), "unbalance alone"),
    (("stribeck-friction", "unbalance"), "Stribeck friction and unbalance"),
])  # fmt: skip
def test_the_proof_is_of_what_the_corrected_model_holds(added: tuple[str, ...], who: str) -> None:
    both = Alternative(effects=("coulomb-friction", "unbalance"), probability=0.94)
    effects = made_up.found().effects * 2
    found = replace(made_up.found(), explanation=both, effects=effects, added=added)
    assert f"Adding {who} reduces" in verdict_sentence(found)
    held = who if who != "them" else "the effects that were found"
    assert any(f"holds the model with {held}:" in step for step in next_steps(found))


def test_a_loss_is_not_called_a_gain() -> None:
    found = made_up.found()
    worse = replace(found, heldout=(replace(found.heldout[0], gain=-0.2),))
    assert "increases" in verdict_sentence(worse)


def test_a_gain_that_may_be_none_is_not_stated() -> None:
    found = made_up.found()
    cases = ((0.035, (-0.02, 0.08), False), (-0.03, (-0.1, 0.0), False), (0.1, (0.01, 0.2), True))
    for gain, interval, certain in cases:
        row = replace(found.heldout[0], gain=gain, gain_interval=interval)
        said = verdict_sentence(replace(found, heldout=(row,)))
        assert ("changes little for certain: the speed error" in said) != certain
        assert (f"({words.percent(abs(gain))} less)" in said) == certain


@pytest.mark.parametrize(
    ("share", "text"),
    [(0.0, "0 %"), (0.034, "3.4 %"), (0.87, "87 %"), (0.996, "99.6 %"), (0.99999, "> 99.9 %")],
)
def test_percentages(share: float, text: str) -> None:
    assert words.percent(share) == text


@pytest.mark.parametrize(("probability", "text"), [(1.0, "> 99 %"), (0.97, "97 %"), (1e-9, "< 1 %")])
def test_no_probability_is_certainty(probability: float, text: str) -> None:
    assert words.likelihood(probability) == text


def test_a_parameter_beyond_its_declared_uncertainty_is_said_to_be_so() -> None:
    fine = made_up.adequate()
    assert "within their declared uncertainty" in verdict_sentence(fine)
    name, p = next((n, p) for n, p in fine.nominal_fit.parameters.items() if p.uncertainty > 0)
    off = replace(p, refitted=replace(p.refitted, value=p.nominal * math.exp(20.0 * p.uncertainty)))
    parameters = {**fine.nominal_fit.parameters, name: off}
    said = verdict_sentence(replace(fine, nominal_fit=replace(fine.nominal_fit, parameters=parameters)))
    assert f"But {words.plain_name(name)} had to move by 20 times its declared uncertainty: check it." in said
    assert "within" not in said


def test_a_near_explanation_has_the_experiment_that_tells_it_from_the_stated_one() -> None:
    near = Alternative(effects=("stribeck-friction",), probability=0.3, separated_by="slow ramps")
    far = Alternative(effects=("backlash",), probability=0.02, separated_by="reversals")
    again = Alternative(effects=("constant-load",), probability=0.2, separated_by="slow ramps")
    assert from_near((near, far, again), named=True) == "slow ramps"
    assert from_near((near,), named=False) == from_near((far,), named=True) == ""
    first, *_ = next_steps(replace(made_up.found(), next_experiment="slow ramps"))
    assert first == "To tell it from the next explanations: slow ramps"


def test_a_signal_that_got_worse_is_said_beside_the_one_that_improves() -> None:
    found = made_up.found()
    bad = replace(
        found.heldout[0], signal="current", unit="A", refitted=0.1, corrected=0.3, gain=-2.0, gain_interval=(-3, -1)
    )
    said = verdict_sentence(replace(found, heldout=(found.heldout[0], bad)))
    assert "But the current error on heldout_1.csv gets worse, from 0.100 A to 0.300 A." in said
    assert "worse" not in verdict_sentence(found)
    hardly = replace(bad, corrected=0.1000001, gain=-1e-6, gain_interval=(-2e-6, -1e-7))
    assert "worse" not in verdict_sentence(replace(found, heldout=(found.heldout[0], hardly)))


def test_a_current_that_stays_far_off_is_said_beside_the_speed() -> None:
    found = made_up.found()
    off = replace(found.heldout[0], signal="current", unit="A", refitted=0.5, corrected=0.48, noise_floor=0.02)
    off = replace(off, gain=0.04, gain_interval=(-0.01, 0.09))
    said = verdict_sentence(replace(found, heldout=(found.heldout[0], off)))
    assert said.endswith("The current error there is still 24 times its noise, 0.480 A.")
    assert " times its noise (" in said, "what is left of the speed is next to its noise"
    for fine in (replace(off, corrected=0.03), replace(off, noise_floor=None), replace(off, signal="position")):
        assert "is still" not in verdict_sentence(replace(found, heldout=(found.heldout[0], fine)))


def test_an_adequate_model_that_fails_on_a_run_that_was_kept_back_says_so() -> None:
    fine = made_up.adequate()
    assert "But on" not in verdict_sentence(fine)
    assert "not used for fitting, the refitted model errs by" in verdict_sentence(fine)
    row = replace(fine.heldout[0], refitted=9.0 * (fine.heldout[0].noise_floor or 0.0))
    said = verdict_sentence(replace(fine, heldout=(row,)))
    assert f"But on {row.recording}, not used for fitting, the speed error is 9.0 times its noise" in said


def test_the_two_numbers_are_those_that_the_gain_is_of() -> None:
    found = made_up.found()
    row = headline(found)
    assert row is not None
    assert before_after(row) == ("6.31 rad/s", "0.830 rad/s")
    assert "from 6.31 rad/s, refitted alone, to 0.830 rad/s" in verdict_sentence(found)
    assert before_after(replace(row, corrected=None)) == ("14.2 rad/s", "6.31 rad/s")


def test_a_model_that_was_better_as_given_than_refitted_is_said_to_be() -> None:
    found = made_up.found()
    row = headline(found)
    assert row is not None
    better = replace(found, heldout=tuple(replace(r, nominal=2.0) if r is row else r for r in found.heldout))
    assert "(87 % less); as given, before any fit, the model leaves 2.00 rad/s." in verdict_sentence(better)
    assert "as given" not in verdict_sentence(found)


def test_a_part_that_was_left_out_does_not_read_as_an_error_in_seconds() -> None:
    found = made_up.found()
    row = replace(found.heldout[0], recording=f"last 30 % of train_1.csv {LEFT_OUT}")
    said = verdict_sentence(replace(found, heldout=(row,)))
    assert "the speed error on last 30 % of train_1.csv, left out of the fit, from 6.31 rad/s" in said


def test_what_the_data_sheet_says_and_is_none_is_zero() -> None:
    assert [words.times_given(x) for x in (2.5, 0.0)] == ["2.5 times what was given", "zero"]


def test_a_place_is_said_in_words() -> None:
    fast = Region(coordinate="acceleration", low=403, high=6500, unit="rad/s^2", share=0.89, samples_share=0.17)
    named = replace(fast, name="high acceleration")
    assert words.located([named], [], linear=False) == (
        "the torque that the refitted equation of motion leaves over is strongest at high acceleration, where 17 % of "
        "the samples hold 89 % of its square"
    )
    assert "from 403 rad/s² to 6500 rad/s²" in words.located([fast], [], linear=False)
    assert words.located([replace(fast, share=0.2)], [], linear=False) == ""
    assert words.located([fast], [], linear=True).startswith("the force that the refitted equation of motion leaves")
    assert "output is strongest" in words.located([fast], [], linear=False, motion=False)  # of a transfer function
    shaft = ShaftAlone(alone=0.25, drive=2.0, noise=0.1, signal="speed")
    assert words.located([fast], [], linear=False, shaft=shaft).startswith(
        "it lies between the voltage and the current: driven by the recorded current, the shaft alone errs by "
        "0.250 rad/s in speed, the whole drive by 2.00 rad/s; the voltage that the refitted equation of the winding"
    )
    assert words.located([fast], [], linear=False, shaft=replace(shaft, alone=1.9)).startswith("the torque that")


def test_a_place_is_said_briefly() -> None:
    slow = Region(coordinate="speed", low=0, high=2, unit="rad/s", share=0.7, samples_share=0.1, name="low speed")
    shaft = ShaftAlone(alone=0.25, drive=2.0, noise=0.1, signal="speed")
    said = [
        words.located_briefly([slow], [], linear=True),
        words.located_briefly([slow], [], linear=False, motion=False),
        words.located_briefly([slow], [], linear=False, shaft=shaft),
        words.located_briefly([], [], linear=False, shaft=shaft),
        words.located_briefly([replace(slow, share=0.2)], [], linear=False),
    ]
    assert said == [
        "a force that is strongest at low speed", "an error of the output that is strongest at low speed",
        "a voltage of the winding that is strongest at low speed", "a voltage of the winding", "",
    ]  # fmt: skip


def test_a_place_says_that_it_is_not_that_of_the_errors_in_the_proof() -> None:
    """Strongest at low speed in the equation of motion, and in free run less off there than elsewhere."""
    slow = Region(coordinate="speed", low=0, high=2, unit="rad/s", share=0.7, samples_share=0.1, name="low speed")
    place = Location(
        regions=(slow,), description=words.located([slow], [], linear=False),
        briefly=words.located_briefly([slow], [], linear=False),
    )  # fmt: skip
    found = replace(made_up.unexplained(), location=place)
    assert verdict_sentence(found).startswith(
        "Something is missing that has no name here: a torque that is strongest at low speed. "
    )
    assert any(line.startswith("  Where: the torque that the refitted equation of motion") for line in lines(found))
    assert "The proof compares free runs: their errors may be largest elsewhere." in page(found)


@pytest.mark.parametrize(
    ("coordinate", "low", "high", "said"),
    [
        ("direction", 0.0, 1.0, "in forward motion"),
        ("direction", -1.0, 0.0, "in backward motion"),
        ("angle", 0.0, math.pi / 2.0, "between 0° and 90° of a turn"),
        ("time", 1.33, 1.67, "from 1.33 s to 1.67 s"),
    ],
)
def test_directions_angles_and_times_are_said_in_their_own_words(
    coordinate: str, low: float, high: float, said: str
) -> None:
    unit = "s" if coordinate == "time" else "rad"
    region = Region(coordinate=coordinate, low=low, high=high, unit=unit, share=0.9, samples_share=0.2)
    assert words.region_in_words(region) == said


def test_a_correction_that_changes_nothing_is_not_given_two_numbers() -> None:
    found = made_up.found()
    same = replace(found.heldout[0], corrected=found.heldout[0].refitted, gain=1e-4)
    said = verdict_sentence(replace(found, heldout=(same,)))
    assert "changes nothing in the speed error on heldout_1.csv, not used for fitting, 6.31 rad/s" in said
    assert "something larger is off there" in said
    at_the_floor = replace(same, noise_floor=0.8 * same.refitted)
    assert "6.31 rad/s, 1.2 times its noise" in verdict_sentence(replace(found, heldout=(at_the_floor,)))


def test_without_a_run_to_prove_it_on_no_error_is_said() -> None:
    assert "error" not in verdict_sentence(replace(made_up.found(), heldout=()))


def test_a_mistake_that_could_not_be_undone_says_nothing_beneath_it() -> None:
    said = verdict_sentence(replace(made_up.mistake(), beneath=None))
    assert said == "The recordings hold a mistake: speed in rpm taken for rad/s."


def test_parameters_have_the_symbol_of_their_law() -> None:
    assert words.parameter_name("stribeck-friction", "static_torque") == "static torque T_s"
    assert words.parameter_name("backlash", "gap") == "gap"
    assert words.parameter_name("my-own", "width") == "width"


@pytest.mark.parametrize(
    ("text", "begun"),
    [
        ("what is left", "What is left"),
        ("the end.", "The end."),
        ("train_1.csv, line 812: a gap", "train_1.csv, line 812: a gap"),
        ("train_1.csv: a gap", "train_1.csv: a gap"),
        ("", ""),
    ],
)
def test_a_sentence_begins_large_and_a_file_keeps_its_name(text: str, begun: str) -> None:
    assert words.capital(text) == begun


def test_an_interval_of_decades_is_said_in_words() -> None:
    told = words.estimate(Estimate(value=0.486, unit="N m/rad", interval=(3.6e-5, 36000.0)))
    assert told == "0.486 N m/rad, not told to a factor of ten"
    assert "[" in words.estimate(Estimate(value=0.486, unit="N m/rad", interval=(0.0, 4.0)))
