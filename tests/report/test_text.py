from __future__ import annotations

import math
from dataclasses import replace

import pytest

import made_up
from rwn.decide.account import Remainder
from rwn.fit.intervals import Estimate
from rwn.report import text as words


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
    ],
)
def test_estimates_read_well(
    value: float, unit: str, interval: tuple[float, float] | None, text: str
) -> None:
    assert words.estimate(Estimate(value=value, unit=unit, interval=interval)) == text


@pytest.mark.parametrize("state", made_up.ALL)
def test_the_verdict_is_one_sentence_or_two(state: str) -> None:
    sentence = words.verdict_sentence(made_up.ALL[state]())
    assert sentence.endswith(".")
    assert "  " not in sentence
    assert 30 < len(sentence) < 250


def test_a_set_names_every_member() -> None:
    sentence = words.verdict_sentence(made_up.ambiguous())
    assert "backlash, shaft compliance or presliding hysteresis" in sentence
    assert "cannot tell" in sentence


def test_what_a_name_leaves_is_said_beside_it() -> None:
    found = made_up.found()
    assert "no name here" not in words.verdict_sentence(found)
    left = replace(found, remainder=Remainder(share=0.12, error=3.0, signals=("speed",)))
    assert words.verdict_sentence(left).startswith("The model lacks ")
    assert "What they leave of the speed, 12 % of the mismatch, is not noise" in words.verdict_sentence(left)


def test_a_loss_is_not_called_a_gain() -> None:
    found = made_up.found()
    worse = replace(found, heldout=(replace(found.heldout[0], gain=-0.2),))
    assert "increases" in words.verdict_sentence(worse)


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
    assert "within their declared uncertainty" in words.verdict_sentence(fine)
    name, p = next((n, p) for n, p in fine.nominal_fit.parameters.items() if p.uncertainty > 0)
    off = replace(p, refitted=replace(p.refitted, value=p.nominal * math.exp(20.0 * p.uncertainty)))
    parameters = {**fine.nominal_fit.parameters, name: off}
    said = words.verdict_sentence(replace(fine, nominal_fit=replace(fine.nominal_fit, parameters=parameters)))
    assert said.endswith(f"But {name} had to move by 20 times its declared uncertainty: check it.")
    assert "within" not in said
