"""What `rwn identify` says of a fit contradicts nothing else that it says."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.identify import Identification, _describes_nothing
from rwn.model.model import Model
from rwn.recording.recording import Recording
from rwn.report import identification
from rwn.simulate.explained_signal import ExplainedSignal

DEMO = Path(rwn.__file__).parent / "demo"


def _as(change: Callable[[Mapping[str, np.ndarray]], Mapping[str, np.ndarray]], count: int = 4000) -> Recording:
    run = rwn.read_recording(DEMO / "train.csv").beginning(count)
    return replace(run, signals={**run.signals, **change(run.signals)})


WRONG: dict[str, Recording] = {
    "a speed of the other sign": _as(lambda s: {"speed": -s["speed"]}),
    "a current of the other sign": _as(lambda s: {"current": -s["current"]}),
    "a current in mA": _as(lambda s: {"current": 1e3 * s["current"]}),
    "ten times the voltage": _as(lambda s: {"voltage": 10.0 * s["voltage"]}),
    "a run of 120 samples": _as(lambda _: {}, 120),
    "nothing": _as(lambda _: {}),
}


def _model() -> Model:
    """Said to be held from row to row: no other law is looked for."""
    model = rwn.read_model(DEMO / "model.toml")
    return replace(model, recording=replace(model.recording, intersample="held"))


@cache
def _identified(case: str) -> tuple[Identification, Model, list[str], str]:
    run, model = WRONG[case], _model()
    fit = rwn.identify(run, model)
    doubts = [line for line in identification.lines(fit, model) if line.startswith("warning")]
    return fit, model, doubts, fit.failure


@pytest.mark.parametrize("case", WRONG)
def test_nothing_is_said_to_be_unseen_that_moved_far_or_to_a_bound(case: str) -> None:
    _, model, doubts, _ = _identified(case)
    for name in model.uncertainty:
        said = [line for line in doubts if re.search(rf"\b{name.replace('_', ' ')}\b", line)]
        assert sum("say nothing of" in line for line in said) in (0, len(said)), said


def test_what_moved_far_was_seen() -> None:
    fit, _, doubts, _ = _identified("ten times the voltage")
    assert "resistance" not in fit.not_identifiable  # 1.1 ohm in all but a scale: 10.9 +- 0.15 is not unknown
    assert any("resistance moved to" in line for line in doubts)


@pytest.mark.parametrize("case", ["a speed of the other sign", "a current of the other sign"])
def test_a_sign_error_that_drives_a_parameter_to_the_end_of_its_search_is_no_fit(case: str) -> None:
    fit, model, doubts, why = _identified(case)
    ran = [n for n, e in fit.parameters.items() if not 2e-3 < e.value / model.parameters[n] < 500.0 and e.value > 0.0]
    assert ran
    assert "end of the search" in why
    assert "check signs" in why
    assert any("ran into a bound" in line for line in doubts)


def test_a_friction_that_comes_out_as_nothing_is_a_fit() -> None:
    model = _model()
    exact = replace(model, parameters={**model.parameters, "viscous_friction": 1e-12}, uncertainty={})
    given = rwn.read_recording(DEMO / "train.csv")
    rng = np.random.default_rng(1)
    made = {name: x + 0.02 * rng.standard_normal(x.size) for name, x in rwn.simulate(exact, given).signals.items()}
    run = replace(given, signals={**given.signals, "current": made["current"], "speed": made["speed"]})
    fit = rwn.identify(run, model)
    assert not fit.failure


def test_the_error_is_said_in_the_units_of_the_file(tmp_path: Path) -> None:
    """By hand: the rms of what the fitted model leaves, in rpm and mA; a recording without units says it in SI."""
    model = _model()
    run = _as(lambda _: {}, 1000)
    rwn.save(replace(run, units={"speed": "rpm", "current": "mA"}), tmp_path / "run.csv")
    fit = rwn.identify(run, model)
    made = rwn.simulate(fit.model, run).signals
    rms = {s: float(np.sqrt(np.mean((run.signals[s] - made[s]) ** 2))) for s in ("speed", "current")}
    for given, units, scales in (
        (rwn.read_recording(tmp_path / "run.csv"), ("rpm", "mA"), (30.0 / np.pi, 1e3)),
        (replace(run, units={}), ("rad/s", "A"), (1.0, 1.0)),
    ):
        text = "\n".join(identification.lines(rwn.identify(given, model), model))
        for (signal, error), unit, scale in zip(rms.items(), units, scales, strict=True):
            said = re.search(rf"of the {signal} is explained, rms error (\S+) {unit}$", text, re.MULTILINE)
            assert said, text
            assert float(said[1]) == pytest.approx(scale * error, rel=6e-3)  # three digits


@pytest.mark.parametrize("case", ["a speed of the other sign", "a current of the other sign"])
def test_what_failed_says_so_in_python_too_and_is_not_saved(case: str, tmp_path: Path) -> None:
    fit, _, _, why = _identified(case)
    assert repr(fit) == f"<Identification failed: {why}>"
    with pytest.raises(rwn.NoResultError, match="check signs"):
        rwn.save(fit, tmp_path / "fitted.toml")
    assert not list(tmp_path.iterdir())


def test_one_signal_of_which_nothing_is_explained_is_enough_to_fail() -> None:
    """The current is described; the speed, of the other sign, is not even by its mean."""
    described = [_row("current", 0.9), _row("speed", -0.2)]
    assert [*_describes_nothing(described, ["current", "speed"])]
    assert not [*_describes_nothing(described, ["current"])], "of a speed that is but noise nothing can be explained"
    assert not [*_describes_nothing([_row("current", 0.9), _row("speed", 0.1)], ["current", "speed"])]
    adrift = [_row("speed", 0.9), _row("position", -3.0)]
    assert not [*_describes_nothing(adrift, ["speed", "position"])]


def _row(signal: str, explained: float) -> ExplainedSignal:
    return ExplainedSignal(recording="a", signal=signal, explained=explained, error=1.0, unit="1")


def test_an_identified_model_replaces_nothing_that_it_was_made_from(tmp_path: Path) -> None:
    (tmp_path / "model.toml").write_bytes((DEMO / "model.toml").read_bytes())
    rwn.save(WRONG["a run of 120 samples"], tmp_path / "train.csv")
    fit = rwn.identify(tmp_path / "train.csv", tmp_path / "model.toml")
    for name in ("model.toml", "train.csv"):
        with pytest.raises(rwn.InputError, match=r"input|written as \.toml"):
            rwn.save(fit, tmp_path / name, overwrite=True)
    recording = rwn.read_recording(tmp_path / "train.csv")
    with pytest.raises(rwn.InputError, match="input"):
        rwn.save(recording, tmp_path / "train.csv", overwrite=True)
    rwn.save(fit.model, tmp_path / "model.toml", overwrite=True)  # a model that was read may be edited


def test_a_model_that_leaves_nothing_open_says_that_nothing_was_fitted() -> None:
    model = replace(_model(), uncertainty={})
    said = "\n".join(identification.lines(rwn.identify(WRONG["nothing"], model), model))
    assert "warning: nothing was fitted" in said
    assert "[uncertainty]" in said
