"""The misfit factor of intervals, from those that counted with one already."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from rwn.decide.account import Remainder
from rwn.errors import InputError
from rwn.fit.intervals import HALF_WIDTH, Estimate
from rwn.name.found_effect import FoundEffect
from rwn.report.diagnosis import Diagnosis
from rwn.studies.trials.grade import nearest_turn
from rwn.studies.trials.misfit_factor import Errors, _error, _factor_in, errors_of

LEFT = Remainder(error=4.0, signals=("speed",))  # three quarters of it are no noise


@pytest.mark.parametrize("logarithmic", [False, True])
@pytest.mark.parametrize("misfit_factor", [0.0, 2.0, 7.0])
def test_an_error_does_not_depend_on_the_factor_that_its_interval_counts_with(
    misfit_factor: float, logarithmic: bool
) -> None:
    """A value that is 12 times its noise off."""
    noise = 0.1
    half = HALF_WIDTH * noise * float(np.hypot(1.0, misfit_factor * np.sqrt(0.75)))
    ends = 2.0 * (np.exp([-half, half]) if logarithmic else 1.0 + np.array([-half, half]))
    estimate = Estimate(value=2.0, unit="A", interval=(float(ends[0]), float(ends[1])))
    off = 2.0 * (float(np.exp(12.0 * noise)) if logarithmic else 1.0 + 12.0 * noise)
    assert _error(estimate, off, LEFT, misfit_factor=misfit_factor) == pytest.approx(12.0)


def test_intervals_of_an_unknown_misfit_factor_are_refused(tmp_path: Path) -> None:
    (tmp_path / "timing.json").write_text('{"seconds": 2.0}')
    with pytest.raises(InputError, match=r"timing\.json: nothing says which misfit factor .*; fix: diagnose the set"):
        _factor_in(tmp_path)
    (tmp_path / "timing.json").write_text('{"seconds": 2.0, "misfit_factor": 0.4}')
    assert _factor_in(tmp_path) == 0.4


def test_the_factor_is_found_that_errors_were_drawn_with() -> None:
    rng = np.random.default_rng(5)
    misfits = rng.uniform(0.0, 1.0, 4000) * (rng.random(4000) < 0.7)
    errors = np.abs(rng.standard_normal(4000)) * np.hypot(1.0, 3.0 * np.sqrt(misfits))
    errors[misfits == 0.0] *= 20.0  # they miss by something else, which the factor is not for
    found = Errors(errors=errors, misfits=misfits, weights=np.ones(4000))
    assert found.likeliest() == pytest.approx(3.0, rel=0.05)
    telling = Errors(errors=errors[misfits > 0.0], misfits=misfits[misfits > 0.0], weights=np.ones(4000))
    assert telling.covered(3.0) == pytest.approx(0.95 * telling.errors.size, rel=0.01)
    assert telling.covered(0.0) < 0.7 * telling.errors.size


def test_without_misfit_or_with_errors_of_noise_no_factor_is_likelier_than_none() -> None:
    none = np.zeros(3)
    assert Errors(errors=np.full(3, 9.0), misfits=none, weights=np.ones(3)).likeliest() == 0.0
    assert Errors(errors=np.full(3, 0.5), misfits=np.full(3, 0.8), weights=np.ones(3)).likeliest() == 0.0


def test_every_trial_counts_alike(tmp_path: Path) -> None:
    """Three parameters of one trial that are 9 deviations off, and one of each of the others that is 1 off."""
    for k in range(4):
        trial, out = tmp_path / f"trial_{k:04d}", tmp_path / f"trial_{k:04d}" / "out"
        out.mkdir(parents=True)
        (trial / "model.toml").touch()
        names, off = (("gap", "load_inertia", "load_viscous_share"), 9.0) if k == 0 else (("gap",), 1.0)
        true = {"name": "backlash", "parameters": {name: {"value": 1.0 + 0.1 * off} for name in names}}
        (trial / "answer.json").write_text(json.dumps({"case": trial.name, "effects": [true], "background": {}}))
        half = HALF_WIDTH * 0.1
        estimate = Estimate(value=1.0, unit="rad", interval=(1.0 - half, 1.0 + half))
        effect = FoundEffect(
            name="backlash", equation="mechanical", probability=0.9, parameters=dict.fromkeys(names, estimate)
        )
        (out / "diagnosis.json").write_bytes(
            Diagnosis(verdict="missing-physics", effects=(effect,), remainder=LEFT).to_json()
        )
        (out / "timing.json").write_text('{"commit": "1234567", "misfit_factor": 0.0}')
    found = errors_of([tmp_path])
    assert found.errors == pytest.approx([9.0, 9.0, 9.0, 1.0, 1.0, 1.0])
    assert found.weights == pytest.approx([1 / 3, 1 / 3, 1 / 3, 1.0, 1.0, 1.0])
    mean_square = (81.0 + 3.0) / 4.0  # of all that are left together 1 + 0.75 f^2, since each of them is so
    assert found.likeliest() == pytest.approx(np.sqrt((mean_square - 1.0) / 0.75), rel=1e-3)
    assert "by 6 parameters beside which something is left; with it 6 of 6 intervals cover" in found.words(5.2)
    assert errors_of([tmp_path], check=[tmp_path.name]).likeliest() == 0.0


def test_a_phase_is_known_but_for_whole_turns() -> None:
    assert nearest_turn("phase", -3.1, 3.1) == pytest.approx(-3.1 + 2.0 * np.pi)
    assert nearest_turn("phase", 0.2, 0.3) == 0.2
    assert nearest_turn("amplitude", -3.1, 3.1) == -3.1
