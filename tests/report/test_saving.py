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
    with pytest.raises(rwn.InputError, match="the output file exists"):
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
