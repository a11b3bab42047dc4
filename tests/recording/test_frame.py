"""Tables in Python are read as files are, whatever library they are of."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal
from typing import Any

import numpy as np
import pytest

from one_recording import NAMED, RPM, TIME, UNITS, VOLTAGE, as_meant, imported, pandas_timetable
from rwn.errors import InputError
from rwn.recording.layout import Column, Layout
from rwn.recording.recording import read_recording


def _pandas() -> Any:
    return imported("pandas").DataFrame(NAMED)


def _pandas_with_an_index() -> Any:
    frame = pandas_timetable().rename(columns={"Voltage": "voltage", "Speed": "speed"})
    frame.attrs["units"] = {"voltage": "V", "speed": "rpm"}
    frame.index.name = None
    return frame


def _pandas_with_a_named_index() -> Any:
    frame = _pandas()
    return frame.set_index("time [s]")


def _pandas_with_dates() -> Any:
    instants = np.datetime64("2026-03-01T12:00:00", "ms") + np.round(1e3 * TIME).astype("timedelta64[ms]")
    return imported("pandas").DataFrame({**NAMED, "time [s]": instants}).rename(columns={"time [s]": "time"})


def _polars() -> Any:
    return imported("polars").DataFrame(NAMED)


def _pyarrow() -> Any:
    return imported("pyarrow").table(NAMED)


def _pyarrow_with_units_of_its_fields() -> Any:
    pyarrow = imported("pyarrow")
    table = pyarrow.table({name: NAMED[f"{name} [{unit}]"] for name, unit in UNITS.items()})
    fields = [f.with_metadata({"unit": UNITS[f.name]}) for f in table.schema]
    return table.cast(pyarrow.schema(fields))


def _pandas_with_an_index_of_durations() -> Any:
    """That says its unit though its values have one."""
    frame = _pandas_with_an_index()
    frame.index.name = "time [s]"
    return frame


def _xarray() -> Any:
    xarray = imported("xarray")
    return xarray.Dataset(
        {"voltage": ("time", VOLTAGE, {"units": "V"}), "speed": ("time", RPM, {"units": "rpm"})},
        coords={"time": ("time", TIME, {"units": "s"})},
    )


def _xarray_with_units_in_its_names() -> Any:
    return imported("xarray").Dataset({name: ("row", values) for name, values in NAMED.items()})


def _pandas_with_a_zone() -> Any:
    """Its index is of instants in a zone."""
    frame = _pandas_with_dates().set_index("time")
    frame.index = frame.index.tz_localize("Europe/Berlin")
    return frame


def _pandas_of_decimals() -> Any:
    return _pandas().assign(**{"speed [rpm]": [Decimal(float(w)) for w in RPM]})


def _xarray_with_instants() -> Any:
    began = np.datetime64("2026-03-01T12:00:00", "ns")
    times = began + np.round(1e3 * TIME).astype("timedelta64[ms]")
    return imported("xarray").Dataset({"voltage [V]": ("time", VOLTAGE), "speed [rpm]": ("time", RPM)}, {"time": times})


OBJECTS: dict[str, Callable[[], Any]] = {
    "pandas": _pandas,
    "pandas with times as its index": _pandas_with_an_index,
    "pandas with a named index": _pandas_with_a_named_index,
    "pandas with dates": _pandas_with_dates,
    "pandas with instants in a zone": _pandas_with_a_zone,
    "pandas of decimals": _pandas_of_decimals,
    "polars": _polars,
    "polars, lazy": lambda: _polars().lazy(),
    "pyarrow": _pyarrow,
    "pyarrow with units of its fields": _pyarrow_with_units_of_its_fields,
    "pandas with a named index of durations": _pandas_with_an_index_of_durations,
    "xarray": _xarray,
    "xarray with units in its names": _xarray_with_units_in_its_names,
    "xarray with instants": _xarray_with_instants,
    "dictionary": lambda: dict(NAMED),
    "dictionary of lists": lambda: {name: values.tolist() for name, values in NAMED.items()},
}


@pytest.mark.parametrize("kind", OBJECTS)
def test_tables_in_python_are_read_as_files_are(kind: str) -> None:
    as_meant(read_recording(OBJECTS[kind]()))


@pytest.mark.parametrize(
    ("source", "held"),
    [
        (3, "cannot be read from the int"),
        (None, "cannot be read from the NoneType"),
        ([1, 2, 3], "cannot be read from the list"),
        ({}, "no column is called like a signal"),
        ({"time [s]": TIME, "voltage [V]": VOLTAGE[:5]}, "5 samples"),
        ({"time [s]": TIME, "voltage": VOLTAGE}, "'voltage' has no unit"),
        ({"time [s]": TIME, "voltage [V]": ["a"] * 80}, "real numbers"),
        ({"time [s]": TIME, "speed [rpm]": RPM, "speed [rad/s]": RPM}, "two columns are called 'speed'"),
        ({"time [s]": TIME, "speed [rpm]": np.where(TIME[7] == TIME, np.nan, RPM)}, "sample 8: speed is nan"),
    ],
)
def test_what_is_no_table_is_refused(source: Any, held: str) -> None:
    with pytest.raises(InputError) as refused:
        read_recording(source)
    assert held in str(refused.value)


def test_columns_of_pandas_that_no_text_names() -> None:
    """Numbers, as without a header; levels; the same name twice: these ended in errors of their own."""
    pandas = imported("pandas")
    by_number = {name: Column(source=str(k), unit=unit) for k, (name, unit) in enumerate(UNITS.items())}
    as_meant(read_recording(pandas.DataFrame(dict(enumerate(NAMED.values()))), layout=Layout(columns=by_number)))
    levels = {name: Column(source=f"motor.{name}") for name in UNITS}
    frame = pandas.DataFrame({("motor", name): values for name, values in NAMED.items()})
    as_meant(read_recording(frame, layout=Layout(columns=levels)))
    with pytest.raises(InputError, match="two columns are called 'time'"):
        read_recording(pandas.concat([_pandas(), _pandas()], axis=1))


def test_a_number_that_is_not_there_is_named_by_its_sample() -> None:
    speed = np.array(RPM, dtype=object)
    speed[3] = None
    with pytest.raises(InputError, match="sample 4: speed is nan"):
        read_recording(_pandas().assign(**{"speed [rpm]": speed}))
