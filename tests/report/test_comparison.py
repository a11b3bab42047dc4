"""Two diagnoses beside each other."""

from __future__ import annotations

import re
from dataclasses import replace

import made_up
from rwn.fit.intervals import Estimate
from rwn.report.comparison import comparison
from rwn.report.diagnosis import Diagnosis
from rwn.report.nominal_fit import FittedParameter


def rows(first: Diagnosis, second: Diagnosis) -> dict[str, tuple[str, ...]]:
    """The table of differences as text: what -> before, after, differs."""
    text = comparison(first, second, ("before", "after")).split("What differs")[1].split("</table>")[0]
    cells = [re.findall(r"<td[^>]*>(.*?)</td>", row) for row in re.findall(r"<tr>(.*?)</tr>", text)]
    plain = [[re.sub("<[^>]*>", "", cell) for cell in row] for row in cells if row]
    return {row[0]: tuple(row[1:]) for row in plain}


def test_a_repair_takes_an_effect_away() -> None:
    told = rows(made_up.found(), made_up.adequate())
    assert told["Verdict"] == ("missing-physics", "adequate", "yes")
    assert told["Coulomb friction"] == ("probability 97 %", "not found", "yes")
    assert told["Coulomb torque T_c"] == ("20.8 ± 0.5 mN m", "–", "–")


def test_parameters_differ_where_their_intervals_are_apart() -> None:
    found = made_up.found()
    fit = found.nominal_fit
    hot = replace(fit.parameters["resistance"].refitted, value=0.95, interval=(0.93, 0.97))
    warm = replace(fit.parameters["resistance"], corrected=hot)
    after = replace(found, nominal_fit=replace(fit, parameters={**fit.parameters, "resistance": warm}))
    told = rows(found, after)
    assert told["Resistance"][1:] == ("0.950 ± 0.020 Ω", "yes")
    assert told["Inductance"][-1] == "no"


def test_both_laws_are_drawn_apart() -> None:
    text = comparison(made_up.found(), made_up.found(), ("a<b", "b"))
    drawn = re.findall(r'data-figure="(figure-[^"]*)"', text)
    assert len(drawn) == len(set(drawn)) == 2
    assert "a<b" not in text.split("<main>")[1]


def test_what_the_second_model_holds_is_not_said_to_be_gone() -> None:
    """Before: Coulomb friction was found. After: the model that was corrected by it, which lacks nothing."""
    found, after = made_up.found(), made_up.adequate()
    torque = Estimate(value=0.0208, unit="N m", interval=(0.0203, 0.0213))
    held = FittedParameter(nominal=0.02, uncertainty=0.2, refitted=torque)
    parameters = {**after.nominal_fit.parameters, "coulomb_friction": held}
    told = rows(found, replace(after, nominal_fit=replace(after.nominal_fit, parameters=parameters)))
    assert told["Coulomb friction"] == ("probability 97 %", "in the model", "no")
    assert told["Coulomb torque T_c"] == ("20.8 ± 0.5 mN m", "20.8 ± 0.5 mN m", "no")


def test_a_parameter_of_one_model_alone_has_its_row() -> None:
    after = made_up.adequate()
    more = FittedParameter(nominal=1e-3, uncertainty=0.2, refitted=Estimate(value=1e-3, unit="N m"))
    parameters = {**after.nominal_fit.parameters, "pendulum_torque": more}
    told = rows(after, replace(after, nominal_fit=replace(after.nominal_fit, parameters=parameters)))
    assert told["Pendulum torque"] == ("–", "1.00 mN m", "–")


def test_results_of_two_models_say_so() -> None:
    found = made_up.found()
    other = replace(found, sources=tuple(replace(s, sha256="x" * 64) if s.use == "model" else s for s in found.sources))
    assert [s for s in found.sources if s.use == "model"]
    assert rows(found, found)["Model that it began with"][-1] == "no"
    assert rows(found, other)["Model that it began with"][-1] == "yes"


def test_a_result_without_a_law_says_so() -> None:
    text = comparison(made_up.found(), made_up.adequate(), ("before", "after"))
    assert text.count("No law is drawn.") == 1
