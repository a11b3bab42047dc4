"""What a calibration is fitted on, and the bias of intervals that counted with one already."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from rwn.decide.account import Remainder
from rwn.errors import InputError
from rwn.fit.intervals import Estimate
from rwn.studies.trials.calibrate import HALF_WIDTH, Names, _bias_in, _bias_needed, origin

SHARE = 0.04  # of the mismatch that is left


@pytest.mark.parametrize("bias", [0.0, 0.3, 0.7])
def test_the_bias_needed_does_not_depend_on_the_one_that_intervals_count_with(bias: float) -> None:
    """A value 12 % off with 2 % of noise, where a fifth of the mismatch's rms is left."""
    wide = 2.0 * HALF_WIDTH * float(np.hypot(0.02, bias * np.sqrt(SHARE)))
    estimate = Estimate(value=2.0, unit="A", interval=(2.0 - wide, 2.0 + wide))
    left = Remainder(share=SHARE, signals=("speed",))
    needed = _bias_needed(estimate, 2.0 * 1.12, left, bias)
    assert needed == pytest.approx(np.sqrt((np.log(1.12) / HALF_WIDTH) ** 2 - 0.02**2) / np.sqrt(SHARE))


def test_intervals_of_an_unknown_bias_are_refused(tmp_path: Path) -> None:
    (tmp_path / "timing.json").write_text('{"seconds": 2.0}')
    with pytest.raises(InputError, match=r"timing\.json: nothing says which bias .*; fix: diagnose the set anew"):
        _bias_in(tmp_path)
    (tmp_path / "timing.json").write_text('{"seconds": 2.0, "bias": 0.4}')
    assert _bias_in(tmp_path) == 0.4


def test_a_calibration_says_what_it_was_fitted_on(tmp_path: Path) -> None:
    for name, commit in (("a", "1234567"), ("b", "89abcde")):
        for trial, done in (("trial_0001", True), ("trial_0002", False)):
            out = tmp_path / name / trial / "out"
            out.mkdir(parents=True)
            (out.parent / "model.toml").touch()
            if done:
                (out / "diagnosis.json").touch()
                (out / "timing.json").write_text(json.dumps({"commit": commit, "date": "", "machine": ""}))
    names = Names(features=np.zeros((3, 5)), acts=np.ones(3), trial=np.array([0, 0, 1]))
    told = origin(names, [tmp_path / "a", tmp_path / "b"], check=["b"])
    assert told == "3 names of 2 trials: a, b, diagnosed by 1234567 and 89abcde; bias without b, which check it"
