"""What a diagnosis says of errors is in the units that the user's files have."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import made_up
import rwn
from made_up_motor import MOTOR, recorded
from rwn.mismatch_map.regions import Region
from rwn.report.file_units import in_file_units, regions_in_file_units
from rwn.report.text import located

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


def test_what_is_over_speed_is_over_that_of_the_files() -> None:
    """Clouds, marks and the stretch that is shown; what is over time or angle stays."""
    found = made_up.found()
    made = in_file_units(found, [replace(RUN, units={"speed": "rpm"})])
    over = [k for k, plot in enumerate(found.curves) if plot.x_label == "speed"]
    assert over
    assert any(found.curves[k].marks for k in over)
    for k, plot in enumerate(found.curves):
        now, factor = made.curves[k], RPM if k in over else 1.0
        assert now.x_unit == ("rpm" if k in over else plot.x_unit)
        for trace, before in zip(now.traces, plot.traces, strict=True):
            np.testing.assert_allclose(trace.x, before.x / factor)
        assert [m.low for m in now.marks] == pytest.approx([m.low / factor for m in plot.marks])


def test_a_region_of_speed_is_in_the_unit_of_the_files() -> None:
    """An angle within a revolution and a time are no signals of a file."""
    speed = Region(coordinate="speed", low=RPM, high=20.0 * RPM, unit="rad/s", share=0.6, samples_share=0.2)
    angle = replace(speed, coordinate="angle", unit="rad")
    now, other = regions_in_file_units([speed, angle], {"speed": "rpm", "position": "deg"}, linear=False)
    assert (now.low, now.high, now.unit) == pytest.approx((1.0, 20.0, "rpm"))
    assert other == angle
    assert "from 1.00 rpm to 20.0 rpm" in located([now], [], linear=False)


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
