"""Rows off their clock: no length between them comes back, so that their steps lie between those of a grid."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.model.model import Model
from rwn.recording.layout import Layout
from rwn.recording.speed_measurement import BACKWARD, CENTRAL, FORWARD, INSTANTANEOUS, SpeedMeasurement
from rwn.simulate.run import Run
from rwn.simulate.simulator import _as_difference

STEP, ROWS, PARTS = 1e-3, 400, 3
LAWS = {
    "linear": {},
    "coulomb-friction": {"coulomb_torque": 0.01},
    "shaft-compliance": {"stiffness": 2.0, "damping": 1e-3, "load_inertia": 1e-5, "load_viscous_share": 0.3},
    "brush-voltage-drop": {"voltage_drop": 0.5, "transition_current": 0.2},
}
# linear pieces are exact but for the interpolation (1e-9 of a matrix a step), what is nonlinear is integrated
EXACT = {"linear": 1e-8, "coulomb-friction": 1e-8, "shaft-compliance": 1e-8, "brush-voltage-drop": 1e-4}


@pytest.mark.parametrize("law", LAWS)
def test_parts_of_an_interval_lead_where_the_whole_does(law: str) -> None:
    rng = np.random.default_rng(11)
    time = np.concatenate([[0.0], np.cumsum(STEP * rng.uniform(0.5, 1.5, ROWS - 1))])
    inner = np.sort(rng.uniform(0.1, 0.9, (ROWS - 1, PARTS - 1)), axis=1)
    parts = time[:-1, None] + np.diff(time)[:, None] * np.column_stack([np.zeros(ROWS - 1), inner])
    fine = np.append(parts.ravel(), time[-1])
    voltage = np.repeat(rng.uniform(-10.0, 10.0, ROWS // 20), 20)
    held = np.append(np.repeat(voltage[:-1], PARTS), voltage[-1])
    model = Model(kind="dc", parameters=MOTOR, effects={} if law == "linear" else {law: LAWS[law]})

    def run(at: np.ndarray, given: np.ndarray) -> dict[str, np.ndarray]:
        done = rwn.simulate(model, rwn.Recording(name="rows", time=at, signals={"voltage": given}))
        assert done.status == "ok"
        return dict(done.signals)

    whole, pieces = run(time, voltage), run(fine, held)
    for name in ("current", "speed", "position"):
        of, by = whole[name], pieces[name][::PARTS]
        assert np.max(np.abs(of - by)) < EXACT[law] * np.max(np.abs(by)), name


@pytest.mark.parametrize(
    ("way", "left_out"), [(BACKWARD, [0, 30]), (FORWARD, [29, 58]), (CENTRAL, [0, 29, 30, 58]), (INSTANTANEOUS, [])]
)
def test_a_difference_over_a_lost_row_is_not_compared(way: SpeedMeasurement, left_out: list[int]) -> None:
    """The drive divided by its own period; the logger lost the 31st row of 60."""
    time = STEP * np.delete(np.arange(60), 30)
    run = Run(name="lost", time=time, input=0.0 * time, speed=time, speed_measured=way)
    assert np.flatnonzero(run.not_compared("speed")).tolist() == left_out
    assert not run.not_compared("current").any()


@pytest.mark.parametrize("way", [BACKWARD, FORWARD, CENTRAL])
def test_a_difference_over_a_lost_row_is_simulated_as_the_drive_took_it(way: SpeedMeasurement) -> None:
    time = STEP * np.arange(60)
    kept = np.arange(60) != 30
    voltage = np.where(time < 0.02, 0.0, 8.0)
    model = Model(kind="dc", parameters=MOTOR, recording=Layout(initial="rest", speed_rows=(way.before, way.after)))

    def speed(rows: np.ndarray) -> np.ndarray:
        rest = {"voltage": voltage[rows], "speed": 0.0 * time[rows]}
        return rwn.simulate(model, rwn.Recording(name="lost", time=time[rows], signals=rest)).signals["speed"]

    whole, lost = speed(np.full(60, True))[kept], speed(kept)
    assert np.ptp(whole) > 0.0
    np.testing.assert_allclose(lost[1:-1], whole[1:-1], atol=0.01 * np.ptp(np.diff(whole)))


@pytest.mark.parametrize("way", [BACKWARD, CENTRAL])
def test_a_simulation_that_ran_away_is_no_error_where_a_row_was_lost(way: SpeedMeasurement) -> None:
    time = STEP * np.delete(np.arange(60), 30)
    run = Run(name="lost", time=time, input=0.0 * time, speed=0.0 * time, speed_measured=way)
    away = np.where(time < 0.03, 0.0, 1e303)
    assert np.isfinite(_as_difference(run, 1e-6 * away, away)).all()
