"""Numbers under [recording] that no bench can mean: one line that names the model file and the key."""

from __future__ import annotations

import numpy as np
import pytest

from bad_input import MODEL, Refuse, csv_text, run_rows
from rwn.errors import InputError
from rwn.identify import identify
from rwn.model.model import Model
from rwn.model.recordings import check_recording
from rwn.recording.layout import Layout
from rwn.recording.recording import Recording


@pytest.mark.parametrize("kind", ["delays", "filters"])
@pytest.mark.parametrize("value", ["6", '"5 s"', "-5", "1e300", "nan", "8" * 401, "0.05"])
def test_a_sensor_is_not_slower_than_a_tenth_of_a_recording(kind: str, value: str, refuse: Refuse) -> None:
    line = refuse(csv_text(rows=run_rows(200)), MODEL + f"[recording]\n{kind}.speed = {value}\n")
    assert kind in line.partition(": ")[2]
    assert ".toml" in line


@pytest.mark.parametrize("key", ["decimate", "initial_samples"])
@pytest.mark.parametrize("value", ["8" * 401, str(2**63), "1e21", "0", "-5"])
def test_counts_of_rows_are_counts_of_rows(key: str, value: str, refuse: Refuse) -> None:
    line = refuse(csv_text(), MODEL + f"[recording]\n{key} = {value}\n")
    assert "[recording" in line
    assert len(line) < 400


MOTOR = {
    "resistance": 0.8, "inductance": 1.5e-3, "torque_constant": 0.1, "back_emf_constant": 0.1, "inertia": 3e-4,
    "viscous_friction": 7e-5,
}  # fmt: skip


def _run(rows: int) -> Recording:
    t = np.arange(rows) * 1e-3
    signals = {"voltage": 5.0 * np.sin(60.0 * t), "speed": 40.0 * np.sin(60.0 * t - 0.7)}
    return Recording(name="run", time=t, signals=signals)


def test_what_a_diagnosis_may_find_in_a_short_run_is_read_again() -> None:
    """Up to 40 rows of delay, whatever share of a run that is; a tenth of a long one."""
    for rows, most in ((200, 0.040), (1001, 0.1)):
        for delays, filters in (({"speed": most}, {}), ({"speed": -most}, {}), ({}, {"speed": most})):
            model = Model(kind="dc", parameters=MOTOR, recording=Layout(delays=delays, filters=filters))
            assert check_recording(_run(rows), model).name == "run"
            large = {name: 1.01 * value for name, value in delays.items()}
            slow = {name: 1.01 * value for name, value in filters.items()}
            with pytest.raises(InputError, match="where run lasts"):
                check_recording(
                    _run(rows), Model(kind="dc", parameters=MOTOR, recording=Layout(delays=large, filters=slow))
                )


def test_the_largest_delay_of_the_shortest_run_can_be_fitted() -> None:
    model = Model(
        kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1}, recording=Layout(delays={"speed": 0.0392})
    )
    assert np.isfinite(identify(_run(50), model).residual_over_noise)
