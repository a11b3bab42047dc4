"""`rwn.save`: what is written is read back."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import made_up
import rwn

DEMO = Path(rwn.__file__).parent / "demo"


def test_a_model_and_a_fit_are_read_back_as_they_were(tmp_path: Path) -> None:
    model, run = rwn.read_model(DEMO / "model.toml"), rwn.read_recording(DEMO / "train.csv").beginning(600)
    fit = rwn.identify(run, model)
    rwn.save(model, tmp_path / "model.toml")
    rwn.save(fit, str(tmp_path / "new" / "fitted.toml"))
    assert rwn.read_model(tmp_path / "model.toml") == model
    assert rwn.read_model(tmp_path / "new" / "fitted.toml") == fit.model


def test_a_recording_keeps_the_units_of_its_source(tmp_path: Path) -> None:
    rows = "".join(f"{k},{1.5 - k % 2},{30 * k}\n" for k in range(60))
    (tmp_path / "a.csv").write_text(f"time [ms],voltage [V],speed [rpm]\n{rows}")
    run = rwn.read_recording(tmp_path / "a.csv")
    rwn.save(run, tmp_path / "b.csv")
    assert (tmp_path / "b.csv").read_text().splitlines()[0] == "time [ms],voltage [V],speed [rpm]"
    again = rwn.read_recording(tmp_path / "b.csv")
    np.testing.assert_allclose(again.time, run.time, rtol=1e-8)  # nine digits are written
    for name, values in run.signals.items():
        np.testing.assert_allclose(again.signals[name], values, rtol=1e-8)


def test_what_is_there_stays_unless_it_may_be_replaced(tmp_path: Path) -> None:
    model, path = rwn.read_model(DEMO / "model.toml"), tmp_path / "model.toml"
    path.write_text("mine")
    with pytest.raises(rwn.InputError, match=r"the output file exists.*overwrite=True"):
        rwn.save(model, path)
    assert path.read_text() == "mine"
    rwn.save(model, path, overwrite=True)
    assert rwn.read_model(path) == model


def test_what_has_no_file_is_refused_and_nothing_is_written(tmp_path: Path) -> None:
    with pytest.raises(rwn.InputError, match="a dict has no file of its own"):
        rwn.save({"time": [0.0]}, tmp_path / "a.csv")  # type: ignore[arg-type]
    assert not list(tmp_path.iterdir())


def test_a_diagnosis_is_written_to_a_folder_of_either_kind(tmp_path: Path) -> None:
    made_up.found().write(str(tmp_path))
    assert rwn.Diagnosis.load(tmp_path) == made_up.found()
    with pytest.raises(rwn.InputError, match="the path is 5"):
        made_up.found().write(5)  # type: ignore[arg-type]


def test_what_can_be_shown_has_its_methods(tmp_path: Path) -> None:
    """They do what the functions do; without them a result is a dead end in a notebook."""
    demo = Path(rwn.__file__).parent / "demo"
    recording, model = rwn.read_recording(demo / "train.csv").beginning(800), rwn.read_model(demo / "model.toml")
    fit, made = rwn.identify(recording, model), rwn.simulate(model, recording)
    assert recording.plot() == rwn.plot(recording)
    assert recording.plot(model) == model.plot(recording) == rwn.plot(recording, model)
    assert fit.plot(signal="current") == rwn.plot(recording, {"fitted": fit}, signal="current")
    assert [trace.y.size for trace in made.plot().data] == [800] * len(made.signals)
    made.save(tmp_path / "made.csv")
    np.testing.assert_allclose(rwn.read_recording(tmp_path / "made.csv").signals["speed"], made.signals["speed"], 1e-6)
    fit.save(tmp_path / "fit.toml")
    assert rwn.read_model(tmp_path / "fit.toml").parameters == pytest.approx(fit.model.parameters)
    with pytest.raises(rwn.InputError, match="pass the recording"):
        model.plot()


@pytest.mark.parametrize("name", ["run.mat", "run", "run.toml"])
def test_a_recording_has_the_ending_of_what_is_written(name: str, tmp_path: Path) -> None:
    """It would be CSV, and read as something else."""
    run = rwn.Recording(name="a", time=np.arange(3.0), signals={"speed": np.arange(3.0)})
    with pytest.raises(rwn.InputError, match=r"written as \.csv"):
        rwn.save(run, tmp_path / name)
    assert not list(tmp_path.iterdir())
