"""The misfit factor of intervals, from those that counted with one already."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from rwn.decide.account import Remainder
from rwn.errors import InputError
from rwn.fit.intervals import HALF_WIDTH, Estimate
from rwn.name.found_effect import FoundEffect
from rwn.report.diagnosis import Diagnosis
from rwn.studies.trials.grade import nearest_turn
from rwn.studies.trials.misfit_factor import ParameterErrors, _error, _factor_in, errors_of

Array = NDArray[np.float64]

LINEAR = ("load_viscous_share",)  # may be 0; the others are even about their logarithm
LEFT = Remainder(error=4.0, signals=("speed",))  # three quarters of it are no noise


@pytest.mark.parametrize("logarithmic", [False, True])
@pytest.mark.parametrize("least", [0.0, 0.05])
def test_the_deviation_of_a_value_is_that_of_its_interval_without_what_no_interval_is_narrower_than(
    logarithmic: bool, least: float
) -> None:
    """From the end that no bound has cut."""
    half = HALF_WIDTH * float(np.hypot(0.1, least))
    ends = 2.0 * (np.exp([-half, half]) if logarithmic else 1.0 + np.array([-half, half]))
    off = 2.0 * (float(np.exp(1.2)) if logarithmic else 2.2)
    for low in (float(ends[0]), 2.0):
        estimate = Estimate(value=2.0, unit="A", interval=(low, float(ends[1])))
        assert _error(estimate, off, least=least, logarithmic=logarithmic) == pytest.approx((1.2, 0.1))


def test_intervals_of_an_unknown_misfit_factor_are_refused(tmp_path: Path) -> None:
    (tmp_path / "timing.json").write_text('{"seconds": 2.0}')
    with pytest.raises(InputError, match=r"timing\.json: nothing says which misfit factor .*; fix: diagnose the set"):
        _factor_in(tmp_path)
    (tmp_path / "timing.json").write_text('{"seconds": 2.0, "misfit_factor": 0.4}')
    assert _factor_in(tmp_path) == 0.4


def _errors(off: Array, misfits: Array, least: float = 0.0) -> ParameterErrors:
    """Of values of one trial each, in deviations by noise."""
    one = np.ones(off.size)
    return ParameterErrors(off=off, noise=one, least=least * one, misfits=misfits, trials=np.arange(off.size))


def test_the_factor_is_found_that_errors_were_drawn_with() -> None:
    rng = np.random.default_rng(5)
    misfits = rng.uniform(0.0, 1.0, 4000) * (rng.random(4000) < 0.7)
    off = np.abs(rng.standard_normal(4000)) * np.sqrt(1.0 + 9.0 * misfits + 4.0)
    off[misfits == 0.0] *= 20.0  # they miss by something else, which the factor is not for
    found = _errors(off, misfits, least=2.0)
    assert found.likeliest() == pytest.approx(3.0, rel=0.08)
    telling = found.with_misfit
    assert telling.covered(3.0) == pytest.approx(0.95 * telling.off.size, rel=0.01)
    assert telling.covered(0.0) < 0.92 * telling.off.size


def test_without_misfit_or_with_errors_of_noise_no_factor_is_likelier_than_none() -> None:
    assert _errors(np.full(3, 9.0), np.zeros(3)).likeliest() == 0.0
    assert _errors(np.full(3, 0.5), np.full(3, 0.8)).likeliest() == 0.0


def test_errors_that_no_factor_explains_are_refused() -> None:
    with pytest.raises(InputError, match="no misfit factor below 100 explains"):
        _errors(np.full(3, 5e3), np.full(3, 0.8)).likeliest()
    no_width = replace(_errors(np.ones(3), np.ones(3)), noise=np.zeros(3))
    with pytest.raises(InputError, match="an interval has no width"):
        no_width.likeliest()


def test_every_trial_counts_alike(tmp_path: Path) -> None:
    """Three parameters of one trial that are 9 deviations off, and one of each of the others that is 1 off."""
    for k in range(4):
        trial, out = tmp_path / f"trial_{k:04d}", tmp_path / f"trial_{k:04d}" / "out"
        out.mkdir(parents=True)
        (trial / "model.toml").touch()
        names, off = (("gap", "load_inertia", "load_viscous_share"), 9.0) if k == 0 else (("gap",), 1.0)
        value = {name: 1.0 + 0.1 * off if name in LINEAR else float(np.exp(0.1 * off)) for name in names}
        true = {"name": "backlash", "parameters": {name: {"value": v} for name, v in value.items()}}
        (trial / "answer.json").write_text(json.dumps({"case": trial.name, "effects": [true], "background": {}}))
        half = HALF_WIDTH * 0.1
        ends = {name: (1.0 - half, 1.0 + half) if name in LINEAR else (np.exp(-half), np.exp(half)) for name in names}
        known = {name: Estimate(value=1.0, unit="", interval=(float(a), float(b))) for name, (a, b) in ends.items()}
        effect = FoundEffect(name="backlash", equation="mechanical", probability=0.9, parameters=known)
        (out / "diagnosis.json").write_bytes(
            Diagnosis(verdict="missing-physics", effects=(effect,), remainder=LEFT).to_json()
        )
        (out / "timing.json").write_text('{"commit": "1234567", "misfit_factor": 0.0}')
    found = errors_of([tmp_path])
    assert found.off == pytest.approx([0.9, 0.9, 0.9, 0.1, 0.1, 0.1])
    assert np.hypot(found.noise, found.least) == pytest.approx(0.1)
    assert list(found.trials) == [0, 0, 0, 1, 2, 3]
    variance = np.average((found.off / found.noise) ** 2, weights=[1 / 3, 1 / 3, 1 / 3, 1.0, 1.0, 1.0])
    assert found.likeliest() == pytest.approx(np.sqrt((variance - 1.0) / 0.75), rel=1e-2), "all have misfit 0.75"
    least, most = found.without_one()
    assert least == pytest.approx(0.0, abs=0.1), "without the one that is off"
    assert most > found.likeliest()
    assert found.counted == "6 parameters of 4 trials"
    assert "with it cover 6 of 6 of their intervals" in found.words(5.2)
    assert errors_of([tmp_path], check=[tmp_path.name]).likeliest() == 0.0


def test_a_phase_is_known_but_for_whole_turns() -> None:
    assert nearest_turn("phase", -3.1, 3.1) == pytest.approx(-3.1 + 2.0 * np.pi)
    assert nearest_turn("phase", 0.2, 0.3) == 0.2
    assert nearest_turn("amplitude", -3.1, 3.1) == -3.1
