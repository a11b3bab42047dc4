"""Recordings, models, simulations and fits in the hands of their user: looked at, compared, copied, tabulated."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rwn

DEMO = Path(rwn.__file__).parent / "demo"
MADE: dict[str, Callable[[], Any]] = {
    "recording": lambda: rwn.read_recording(DEMO / "train.csv"),
    "model": lambda: rwn.read_model(DEMO / "model.toml"),
    "simulation": lambda: rwn.simulate(DEMO / "model.toml", DEMO / "train.csv"),
    "identification": lambda: rwn.identify(DEMO / "train.csv", DEMO / "model.toml"),
}


@pytest.fixture(scope="module", params=MADE)
def made(request: pytest.FixtureRequest) -> Any:
    return MADE[request.param]()


def test_it_is_short_to_look_at(made: Any) -> None:
    assert repr(made).startswith(f"<{type(made).__name__} ")
    assert len(repr(made)) < 200
    assert "&lt;" in made._repr_html_()


def test_it_survives_pickling_and_copying(made: Any) -> None:
    for again in (pickle.loads(pickle.dumps(made)), copy.deepcopy(made)):
        assert again == made
        assert again is not made
    assert made != 3


def test_recordings_differ_by_one_sample_or_a_name() -> None:
    recording = MADE["recording"]()
    other = dict(recording.signals)
    other["speed"] = np.where(np.arange(len(recording)) == 7, 1.0, other["speed"])
    assert recording != replace(recording, signals=other)
    assert recording != replace(recording, name="another")
    assert recording == replace(recording, signals=dict(recording.signals))
    with pytest.raises(TypeError, match="unhashable"):
        hash(recording)
    copied = pickle.loads(pickle.dumps(recording))
    with pytest.raises(ValueError, match="read-only"):
        copied.time[0] = 1.0


def _rows(found: Any) -> list[dict[str, Any]]:
    return [
        {"parameter": n, "value": e.value, "low": e.interval[0], "high": e.interval[1], "unit": e.unit}
        for n, e in found.parameters.items()
    ]


def test_the_table_of_a_fit() -> None:
    frame, found = pytest.importorskip("pandas"), MADE["identification"]()
    assert frame.DataFrame(_rows(found)).equals(found.table())


@pytest.mark.usefixtures("without_pandas")
def test_the_table_of_a_fit_is_plain_rows_without_pandas() -> None:
    found = MADE["identification"]()
    assert found.table() == _rows(found)


def test_the_table_of_a_recording_is_read_back() -> None:
    frame, recording = pytest.importorskip("pandas"), MADE["recording"]()
    table = recording.table()
    assert isinstance(table, frame.DataFrame)
    assert list(table) == ["time [s]", "voltage [V]", "current [A]", "speed [rad/s]"]
    again = rwn.read_recording(table)
    assert np.array_equal(again.time, recording.time)
    assert all(np.array_equal(again.signals[name], values) for name, values in recording.signals.items())


@pytest.mark.usefixtures("without_pandas")
def test_the_table_of_a_recording_is_arrays_without_pandas() -> None:
    signals = {"force": np.ones(60), "speed": np.ones(60)}
    run = rwn.Recording(name="x", time=np.arange(60.0), signals=signals, linear=True)
    table = run.table()
    assert isinstance(table, dict)
    assert list(table) == ["time [s]", "force [N]", "speed [m/s]"]
    assert np.array_equal(table["time [s]"], run.time)


def test_the_table_of_a_model_has_what_is_believed_of_each_value() -> None:
    frame, model = pytest.importorskip("pandas"), MADE["model"]()
    told = replace(model, effects={"coulomb-friction": {"coulomb_torque": 0.01}},
                   uncertainty={**model.uncertainty, "coulomb-friction.coulomb_torque": 0.2})  # fmt: skip
    table = told.table()
    assert isinstance(table, frame.DataFrame)
    rows = [tuple(row.values()) for row in table.to_dict("records")]
    assert rows[0] == ("resistance", 1.166, 0.07, "ohm")
    assert rows[1] == ("inductance", 0.00045, 0.0, "H"), "exact"
    assert rows[-1] == ("coulomb-friction.coulomb_torque", 0.01, 0.2, "N m")


@pytest.mark.usefixtures("without_pandas")
def test_the_table_of_a_model_is_plain_rows_without_pandas() -> None:
    rows = MADE["model"]().table()
    assert isinstance(rows, list)
    assert [row["parameter"] for row in rows] == list(MADE["model"]().parameters)
