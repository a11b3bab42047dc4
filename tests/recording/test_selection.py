"""The keys of [recording] that say what of a file is judged, and under which names."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from rwn.errors import InputError
from rwn.model.files import read_model, write_model
from rwn.recording.recording import Recording, read_recording

TIME = 1.0 + np.arange(400) * 0.01
VOLTAGE = np.repeat([1.0, 3.0, -2.0, 0.5], 100) + np.tile([0.0, 1.0], 200)
SPEED = np.sin(TIME)
MOTOR = '[motor]\nkind = "axis"\ninertia = 1.0\nviscous_friction = 0.1\n[recording]\n'


def _read(folder: Path, keys: str, header: str = "time [s],torque [N m],speed [rad/s]") -> Recording:
    rows = "".join(f"{t:.9g},{u:.9g},{w:.9g}\n" for t, u, w in zip(TIME, VOLTAGE, SPEED, strict=True))
    (folder / "run.csv").write_text(f"{header}\n{rows}")
    (folder / "motor.toml").write_text(MOTOR + keys)
    model = read_model(folder / "motor.toml")
    write_model(model, folder / "again.toml")
    assert read_model(folder / "again.toml") == model
    return read_recording(folder / "run.csv", layout=model.recording)


def test_a_stretch_is_cut_out_in_the_files_own_time(tmp_path: Path) -> None:
    read = _read(tmp_path, 'from = 2.0\nto = "3500 ms"\n')
    assert read.time[0] == pytest.approx(2.0)
    assert read.time[-1] == pytest.approx(3.5)
    np.testing.assert_allclose(read.signals["speed"], SPEED[100:251], rtol=1e-8)


def test_what_is_measured_is_thinned_and_the_input_keeps_its_effect(tmp_path: Path) -> None:
    read = _read(tmp_path, "decimate = 4\n")
    np.testing.assert_allclose(read.time, TIME[::4])
    np.testing.assert_allclose(read.signals["speed"], SPEED[::4], rtol=1e-8)
    np.testing.assert_allclose(read.signals["torque"], VOLTAGE.reshape(-1, 4).mean(axis=1))


def test_the_last_rows_that_fill_no_step_are_averaged_alone(tmp_path: Path) -> None:
    read = _read(tmp_path, "decimate = 8\nfrom = 1.0\nto = 4.985\n")
    assert read.signals["torque"][-1] == pytest.approx(VOLTAGE[392:399].mean())


@pytest.mark.parametrize("keys", ["decimate = 9\n", "from = 1.0\nto = 1.441\n"])
def test_what_leaves_too_few_rows_is_named(keys: str, tmp_path: Path) -> None:
    """'Record longer' would not mend it."""
    with pytest.raises(InputError, match=r"from, to and decimate leave 45 of 400 samples.*fix: widen from and to"):
        _read(tmp_path, keys)


def test_a_column_is_renamed_with_its_own_unit(tmp_path: Path) -> None:
    read = _read(tmp_path, 'rename = { "w mot" = "speed", M = "torque" }\n', "time [s],M [mN m],w mot [rpm]")
    np.testing.assert_allclose(read.signals["speed"], SPEED * np.pi / 30.0, rtol=1e-8)
    np.testing.assert_allclose(read.signals["torque"], 1e-3 * VOLTAGE)


def test_rows_outside_do_not_matter(tmp_path: Path) -> None:
    _read(tmp_path, "")
    lines = (tmp_path / "run.csv").read_text().splitlines()
    lines[5] = "1.04,nan,0.1"  # before the stretch
    (tmp_path / "run.csv").write_text("\n".join(lines))
    layout = read_model(tmp_path / "motor.toml").recording
    with pytest.raises(InputError, match="line 6"):
        read_recording(tmp_path / "run.csv", layout=layout)
    (tmp_path / "motor.toml").write_text(MOTOR + "from = 2.0\ndecimate = 2\n")
    assert len(read_recording(tmp_path / "run.csv", layout=read_model(tmp_path / "motor.toml").recording)) == 150


def test_a_fault_is_named_by_its_line_after_cutting_and_thinning(tmp_path: Path) -> None:
    _read(tmp_path, "from = 2.0\ndecimate = 2\n")
    lines = (tmp_path / "run.csv").read_text().splitlines()
    lines[1 + 200] = "3.0,1.0,nan"
    (tmp_path / "run.csv").write_text("\n".join(lines))
    with pytest.raises(InputError, match="line 202: speed is nan"):
        read_recording(tmp_path / "run.csv", layout=read_model(tmp_path / "motor.toml").recording)


@pytest.mark.parametrize(
    ("keys", "held"),
    [
        ('rename = { w = "sped" }\n', "unknown signal 'sped'"),
        ('rename = { w = "speed" }\ncolumns.speed = { source = "v" }\n', "'speed' is mapped and renamed to"),
        ('from = "soon"\n', "'soon'"),
        ("from = nan\n", "nan"),
        ("decimate = 1.5\n", "[recording.decimate]"),
        ("form = 1.0\n", "did you mean 'from'"),
    ],
)
def test_keys_that_make_no_sense_are_refused(keys: str, held: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as refused:
        _read(tmp_path, keys)
    assert held in str(refused.value)
