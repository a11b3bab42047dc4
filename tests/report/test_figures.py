"""Pictures as data: what is drawn of many samples."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, recorded
from rwn.name.initial_guesses.spectra import highest_by_chance
from rwn.report.figures import unknown_over_speed
from rwn.report.law_figures import _over_time
from rwn.report.plot import Plot, Trace
from rwn.report.plot_text import in_words
from rwn.report.plots import figure
from rwn.report.thinning import MOST_POINTS, thin_cloud, thin_line, worth_seeing
from rwn.simulate.unknown_inputs import UnknownInputs


@pytest.mark.parametrize(
    ("lacking", "linear", "label", "unit"),
    [("torque", False, "unknown torque", "N m"), ("torque", True, "unknown force", "N"),
     ("voltage", False, "unknown voltage", "V")],
)  # fmt: skip
def test_what_a_half_of_the_drive_lacks_is_drawn_over_speed(lacking: str, linear: bool, label: str, unit: str) -> None:
    time = np.linspace(0.0, 1.0, 400)
    speed, still = np.sin(9.0 * time), np.zeros(400)
    unknown = UnknownInputs(
        time=time, speed=speed, acceleration=np.gradient(speed, time), current=still, angle=still,
        torque=2.0 * speed, voltage=3.0 * speed, lacking=lacking,
    )  # fmt: skip
    drawn = unknown_over_speed(["run"], [unknown], linear=linear)
    assert (drawn.y_label, drawn.y_unit) == (label, unit)
    cloud = drawn.traces[0]
    assert cloud.y == pytest.approx((3.0 if lacking == "voltage" else 2.0) * cloud.x)


@pytest.mark.parametrize("length", [100, 20_001, 150_000])
def test_no_spike_is_lost(length: int) -> None:
    y = np.zeros(length)
    y[length // 2 + 1] = 100.0
    kept = thin_line([y, 0.0 * y])
    assert kept.size <= MOST_POINTS + 2
    assert y[kept].max() == 100.0
    assert (kept[0], kept[-1]) == (0, length - 1)


def test_the_stretch_that_is_looked_at_closely_keeps_more() -> None:
    y = np.sin(np.arange(100_000) / 50.0)
    plain, close = thin_line([y]), thin_line([y], whole=(40_000, 40_600))
    inside = (close >= 40_000) & (close < 40_600)
    assert inside.sum() == 600
    assert ((plain >= 40_000) & (plain < 40_600)).sum() < 20


def test_a_cloud_keeps_its_outermost_points() -> None:
    y = np.zeros(50_000)
    y[31_999] = -7.0
    kept = thin_cloud(y)
    assert kept.size < 1.2 * MOST_POINTS
    assert y[kept].min() == -7.0


def test_a_law_over_time_keeps_its_peaks() -> None:
    """An oscillation of many periods, which means of stretches would flatten; recordings do not run into each other."""
    t = np.arange(20_000) * 1e-3
    y = 1.83 * np.sin(40.0 * t)
    drawn = _over_time(np.concatenate([t, t]), np.concatenate([y, 0.5 * y]), [t.size, t.size])
    (gap,) = np.flatnonzero(np.isnan(drawn.y))
    assert drawn.x[gap] == t[-1]
    assert np.max(drawn.y[:gap]) == pytest.approx(1.83, rel=1e-3)
    assert np.max(drawn.y[gap + 1 :]) == pytest.approx(0.915, rel=1e-3)
    assert np.all(np.diff(drawn.x[:gap]) > 0.0)
    assert drawn.x.size <= MOST_POINTS + 10


def test_one_outlier_does_not_flatten_a_law() -> None:
    rng = np.random.default_rng(0)
    points = 4e-3 * rng.choice([-1.0, 1.0], 2000) + rng.normal(0, 3e-4, 2000)
    law = np.array([-4e-3, 4e-3])
    assert worth_seeing(np.clip(points, -5e-3, 5e-3), law) is None
    points[7] = -0.15
    low, high = worth_seeing(points, law) or (0.0, 0.0)
    assert -0.01 < low < -4.5e-3
    assert 4.5e-3 < high < 0.01


def test_points_without_a_line_have_their_range_and_nothing_has_none() -> None:
    points = np.append(np.linspace(-1.0, 1.0, 2000), 50.0)
    low, high = worth_seeing(points, np.array([np.nan])) or (0.0, 0.0)
    assert -1.5 < low < -0.9
    assert 0.9 < high < 1.5
    assert worth_seeing(np.array([np.nan]), np.array([1.0])) is None


def test_a_line_that_left_the_finite_numbers_is_drawn_and_said_as_one_without_values() -> None:
    """A model that runs away beside nothing that was recorded in the stretch that is looked at."""
    t = np.linspace(0.0, 1.0, 50)
    gone = Trace(name="simulated", role="corrected", x=t, y=np.full(50, np.nan))
    plot = Plot(
        slot="response", title="run", x_label="time", x_unit="s", y_label="speed", y_unit="rad/s", traces=(gone,),
        recording="run", zoom=(0.2, 0.4),
    )  # fmt: skip
    assert "simulated (line) without values" in in_words([plot])
    axes = [axis for name, axis in figure([plot])["layout"].items() if name.startswith("yaxis")]
    assert all(np.isfinite(axis.get("range", [0.0])).all() for axis in axes)


@pytest.mark.slow
def test_a_burst_of_a_recording_is_drawn_and_a_spike_is_said() -> None:
    run = recorded(1, lambda w, _: -0.004 * np.sign(w), 6000)
    speed = run.signals["speed"].copy()
    place = 4003
    speed[place : place + 3] += 500.0
    speed[1001] -= 500.0
    spiked = rwn.Recording(name="spiked", time=run.time, signals={**run.signals, "speed": speed})
    found = rwn.diagnose([spiked], rwn.Model(kind="dc", parameters=MOTOR), effort=0.1)  # what it is called is no matter
    drawn = next(p for p in found.curves if p.slot == "response").traces[0]
    assert np.max(drawn.y) == pytest.approx(np.max(speed))
    assert [(f.kind, f.count) for f in found.findings] == [("spikes", 1)]


def test_a_spectrum_of_noise_has_no_line_to_draw() -> None:
    """Lines of noise are exponential, here of 120 orders; a line is worth a picture beyond what they reach."""
    rng = np.random.default_rng(4)
    spectra = rng.exponential(0.02, size=(2000, 120))
    beyond = np.mean([share.max() > highest_by_chance(share) for share in spectra])
    assert 0.003 < beyond < 0.03
    spectra[:, 6] = 0.4
    assert all(share.max() > highest_by_chance(share) for share in spectra)
