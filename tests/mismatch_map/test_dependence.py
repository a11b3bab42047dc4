"""What the torque that the nominal model does not know depends on."""

from __future__ import annotations

from collections.abc import Callable, Collection

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, plant, shaking
from rwn.fit.nominal import nominal_of
from rwn.mismatch_map.dependence import CLEAR, Law, laws
from rwn.model.model import Model
from rwn.simulate.unknown_inputs import unknown_inputs

SHEET = Model(kind="dc", parameters=MOTOR, uncertainty={"viscous_friction": 0.3, "inertia": 0.1})
PEAK = 0.02  # N m
SIGNALS = [("speed",), ("speed", "current"), ("speed", "current", "position")]


def found(torque: Callable[[float, float], float], *, recorded: Collection[str] = ("speed",)) -> tuple[Law, ...]:
    """Of a motor with one more torque (of speed and angle), beside the refitted nominal model."""
    rng = np.random.default_rng(3)
    time = 1e-3 * np.arange(3000)
    voltage = 4.0 + shaking(rng, time)
    rows = plant(voltage, torque, parts=2)
    true = {"current": rows[:, 0], "speed": rows[:, 1], "position": rows[:, 2]}
    seen = {name: true[name] + rng.normal(0.0, 1e-3 * np.std(true[name]), time.size) for name in recorded}
    runs = [rwn.Recording(name="made.csv", time=time, signals={"voltage": voltage, **seen})]
    problem, nominal = nominal_of(runs, SHEET)
    unknown = [unknown_inputs(problem.drive, problem.simulator, run, nominal.vector) for run in problem.runs]
    return laws(problem, nominal, unknown)


@pytest.mark.parametrize("recorded", SIGNALS)
def test_a_drag_depends_on_the_speed_and_has_its_curve(recorded: tuple[str, ...]) -> None:
    law = found(lambda w, _: -PEAK * (w / 90.0) ** 3, recorded=recorded)[0]
    assert law.coordinate == "speed"
    assert law.unit == "rad/s"
    assert law.share > 0.9
    # beside a viscous friction and a constant, which the nominal model may take
    design = np.stack([np.ones(law.x.size), law.x, np.sign(law.x), law.x**3], axis=1)
    slope = np.linalg.lstsq(design, law.torque, rcond=None)[0][-1]
    assert slope == pytest.approx(-PEAK / 90.0**3, rel=0.1)


@pytest.mark.parametrize("recorded", SIGNALS)
def test_a_cog_depends_on_the_angle_with_its_order_and_size(recorded: tuple[str, ...]) -> None:
    law = found(lambda _, angle: PEAK * np.sin(7.0 * angle + 0.4), recorded=recorded)[0]
    assert (law.coordinate, law.periods) == ("angle", 7)
    assert law.share > 0.9
    assert law.amplitude == pytest.approx(PEAK, rel=0.1)


def test_a_motor_that_lacks_nothing_depends_on_nothing() -> None:
    assert [law.coordinate for law in found(lambda *_: 0.0) if law.share > CLEAR] == []


@pytest.mark.parametrize("coordinate", ["speed", "current"])
def test_the_curve_lies_on_the_points_that_it_is_drawn_over(coordinate: str) -> None:
    """Also over a state of which the nominal parameters explain a part, as a torque constant does of the current."""
    law = next(law for law in found(lambda w, _: -PEAK * (w / 90.0) ** 3) if law.coordinate == coordinate)
    on_curve = np.interp(law.state, law.x, law.torque)
    assert np.corrcoef(on_curve, law.left)[0, 1] > 0.5
    assert np.polyfit(on_curve, law.left, 1)[0] > 0.5
    assert law.amplitude == pytest.approx(np.sqrt(2.0) * np.std(law.torque)), "what is said of it is what is drawn"
