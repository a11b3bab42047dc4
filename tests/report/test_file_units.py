"""What a diagnosis says of errors is in the units that the user's files have."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import made_up
import rwn
from made_up_motor import MOTOR, recorded
from rwn.report.file_units import in_file_units

RPM = 2.0 * np.pi / 60.0
RUN = rwn.Recording(name="run", time=np.arange(3.0), signals={"voltage": np.zeros(3)})


def test_errors_and_pictures_are_in_the_units_of_their_file() -> None:
    found = made_up.found()
    (row, *_) = [row for row in found.heldout if row.signal == "speed"]
    (speed,) = [p for p in found.curves if p.slot == "response"][:1]
    (run, *_) = [replace(RUN, name=name, units={"speed": "rpm"}) for name in (row.recording, speed.recording)]
    made = in_file_units(found, [run, replace(run, name=speed.recording)])
    (now, *_) = [row for row in made.heldout if row.signal == "speed"]
    assert (now.unit, now.gain, now.gain_interval) == ("rpm", row.gain, row.gain_interval)
    assert [now.nominal, now.refitted] == pytest.approx([row.nominal / RPM, row.refitted / RPM])
    assert now.noise_floor == pytest.approx(row.noise_floor / RPM)
    drawn = made.curves[found.curves.index(speed)]
    assert drawn.y_unit == "rpm"
    np.testing.assert_allclose(drawn.traces[0].y, speed.traces[0].y / RPM)
    others = [row for row in found.heldout if row.signal != "speed"]
    assert [row for row in made.heldout if row.signal != "speed"] == others


def test_a_file_in_si_changes_nothing() -> None:
    found = made_up.found()
    for units in ({}, {"speed": "rad/s", "position": "rad"}, {"speed": ""}):
        assert in_file_units(found, [replace(RUN, units=units)]) == found


def test_a_diagnosis_states_the_error_that_a_simulation_states() -> None:
    """Of the same file, in the same unit."""
    run = recorded(5, lambda speed, _: -0.02 * np.sign(speed), samples=1200)
    fitted, judged = replace(run, name="a", units={"speed": "rpm"}), recorded(6, lambda w, _: -0.02 * np.sign(w))
    model = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1})
    found = rwn.diagnose([fitted], model, heldout=[replace(judged, name="b", units={"speed": "rpm"})])
    (row,) = [r for r in found.heldout if (r.signal, r.region) == ("speed", "all")]
    off = rwn.simulate(model, judged).signals["speed"] - judged.signals["speed"]
    assert row.unit == "rpm"
    assert row.nominal == pytest.approx(np.sqrt(np.mean(off**2)) / RPM, rel=0.02)
