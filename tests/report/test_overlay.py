"""`rwn.plot`: recordings, and models over them, as the report draws them."""

from __future__ import annotations

import builtins
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rwn

DEMO = Path(rwn.__file__).parent / "demo"
MODEL = DEMO / "model.toml"


@pytest.fixture(scope="module")
def run() -> rwn.Recording:
    return rwn.read_recording(DEMO / "train.csv").beginning(600)


@pytest.fixture
def _plotly() -> None:
    pytest.importorskip("plotly")


def _lines(figure: Any) -> list[tuple[str, str]]:
    """Name and axis of every line."""
    return [(line.name, line.yaxis or "y") for line in figure.data]


@pytest.mark.usefixtures("_plotly")
def test_each_signal_of_a_recording_is_a_panel_over_its_time(run: rwn.Recording) -> None:
    drawn = rwn.plot(run)
    assert _lines(drawn) == [("voltage", "y"), ("current", "y2"), ("speed", "y3")]
    assert drawn.layout.title.text == run.name
    assert [drawn.layout[f"yaxis{k}"].title.text for k in ("", 2, 3)] == ["Input [V]", "Current [A]", "Speed [rad/s]"]
    for line, values in zip(drawn.data, run.signals.values(), strict=True):
        assert {*line.y} <= {*values.astype(np.float32)}
        assert line.y.max() == np.float32(values.max())  # no extreme is thinned away


@pytest.mark.usefixtures("_plotly")
def test_one_signal_alone_and_a_file_will_do(run: rwn.Recording) -> None:
    assert _lines(rwn.plot(DEMO / "train.csv", signal="speed")) == [("speed", "y")]
    with pytest.raises(rwn.InputError, match="did you mean 'speed'"):
        rwn.plot(run, signal="speeed")


@pytest.mark.usefixtures("_plotly")
def test_what_was_not_measured_breaks_the_line(run: rwn.Recording) -> None:
    lost = np.arange(len(run)) % 100 == 7
    drawn = rwn.plot(replace(run, missing={"speed": lost}), signal="speed")
    np.testing.assert_array_equal(np.isnan(drawn.data[0].y), lost)
    compared = rwn.plot(replace(run, missing={"speed": lost}), {"model": MODEL})
    measured, error = (line for line in compared.data if line.name == "measured" or line.yaxis == "y2")
    np.testing.assert_array_equal(np.isnan(measured.y), lost)
    np.testing.assert_array_equal(np.isnan(error.y), lost)


@pytest.mark.usefixtures("_plotly")
def test_models_are_drawn_over_the_recording_with_their_errors(run: rwn.Recording) -> None:
    given = rwn.read_model(MODEL)
    fitted = rwn.identify(run, given)
    drawn = rwn.plot(run, {"as given": MODEL, "fitted": fitted})
    assert _lines(drawn) == [
        ("measured", "y"), ("as given", "y"), ("fitted", "y"), ("as given", "y2"), ("fitted", "y2"), ("input", "y3"),
    ]  # fmt: skip
    lines = {(line.name, line.yaxis or "y"): np.asarray(line.y) for line in drawn.data}
    speed = rwn.simulate(fitted.model, run).signals["speed"]
    np.testing.assert_allclose(lines["fitted", "y"], speed, rtol=1e-6)  # float32 in a figure
    error = run.signals["speed"] - rwn.simulate(given, run).signals["speed"]
    np.testing.assert_allclose(lines["as given", "y2"], error, rtol=1e-6)
    np.testing.assert_allclose(lines["input", "y3"], run.signals["voltage"], rtol=1e-6)


@pytest.mark.usefixtures("_plotly")
def test_another_signal_can_be_compared_and_only_one_that_both_have(run: rwn.Recording) -> None:
    without = replace(run, signals={name: run.signals[name] for name in ("voltage", "current")})
    assert rwn.plot(without, {"model": MODEL}).layout.yaxis.title.text == "Current [A]"
    assert rwn.plot(run, {"model": MODEL}, signal="current").layout.yaxis.title.text == "Current [A]"
    with pytest.raises(rwn.InputError, match=r"unknown signal 'position'.*current, speed"):
        rwn.plot(run, {"model": MODEL}, signal="position")


@pytest.mark.usefixtures("_plotly")
def test_the_last_of_several_models_stands_out_as_the_corrected_one_does(run: rwn.Recording) -> None:
    colours = [rwn.plot(run, dict.fromkeys(names, MODEL)).data[len(names)].line.color for names in ("a", "ab", "abc")]
    assert len(set(colours)) == 1
    with pytest.raises(rwn.InputError, match=r"4 models .* at most three"):
        rwn.plot(run, dict.fromkeys("abcd", MODEL))


def test_a_recording_without_samples_is_refused() -> None:
    with pytest.raises(rwn.InputError, match="nothing to draw"):
        rwn.plot(rwn.Recording(name="empty", time=[], signals={"speed": []}))


def test_where_plotly_is_missing_that_is_said(run: rwn.Recording, monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def imported(name: str, *rest: Any) -> Any:
        if name.startswith("plotly"):
            raise ModuleNotFoundError(name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", imported)
    with pytest.raises(rwn.InputError, match=r"plotly is not installed.*pip install 'rwn\[plot\]'"):
        rwn.plot(run)


@pytest.mark.usefixtures("_plotly")
def test_one_model_or_a_list_is_called_as_its_file(run: rwn.Recording) -> None:
    named = _lines(rwn.plot(run, {"model.toml": MODEL}))
    model = rwn.read_model(MODEL)
    for given in (MODEL, str(MODEL), model, [MODEL], (model,)):
        assert _lines(rwn.plot(run, given)) == named
    names = {name for name, _ in _lines(rwn.plot(run, [model, MODEL, replace(model, source="")]))}
    assert {"model.toml", "model.toml (2)", "model"} <= names
    with pytest.raises(rwn.InputError, match="4 models are given"):
        rwn.plot(run, [MODEL] * 4)
