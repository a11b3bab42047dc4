"""The models that are fitted by hand: each term does what is written of it, and the figures of the page come out."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import rwn
from rwn.studies.machines import xl330
from rwn.studies.machines.hand_fit import HANDS, powered
from rwn.studies.machines.registry import MACHINES
from rwn.studies.machines.sliding_motor import Drive, slide

PAGE = Path(__file__).resolve().parents[2] / "docs" / "evidence.md"
MOTOR = {"gain": 50.0, "damping": 4.0}
TERMS: dict[str, dict[str, float]] = {
    "linear": {},
    "uneven": {"uneven": 1.5},
    "waves": {"cos3": 20.0, "sin3": -12.0},
    "offset and coasting": {"offset": 6.0, "coasting": 30.0},
    "filtered": {"lag": 0.02},
}


def integrated(p: dict[str, float], drive: Drive, parts: int = 20) -> NDArray[np.float64]:
    """The speed (n,) by the equation of the module, in steps of Euler twenty times as short."""
    w, q, seen, shown = 0.0, 0.0, 0.0, [0.0]
    for k, step in enumerate(np.diff(drive.time)):
        u, h = drive.given[k], step / parts
        for _ in range(parts):
            brake = p["damping"] + p.get("uneven", 0.0) * np.sign(w) + p["gain"] * abs(u) / p.get("coasting", np.inf)
            wave = p.get("cos3", 0.0) * np.cos(3.0 * q) + p.get("sin3", 0.0) * np.sin(3.0 * q)
            w += h * (p["gain"] * u - brake * w + p.get("offset", 0.0) + wave)
            q += h * w
            seen = w if "lag" not in p else seen + h / p["lag"] * (w - seen)
        shown.append(seen)
    return np.array(shown)


@pytest.mark.parametrize("term", TERMS)
def test_a_term_does_what_is_written_of_it(term: str) -> None:
    time = 2e-3 * np.arange(400)
    drive = Drive(time=time, given=np.where(time % 0.4 < 0.2, 3.0, -2.0))
    p = MOTOR | TERMS[term]
    speed = slide({name: np.array([value]) for name, value in p.items()}, drive)["speed"][:, 0]
    linear = slide({name: np.array([value]) for name, value in MOTOR.items()}, drive)["speed"][:, 0]
    assert np.std(speed - integrated(p, drive)) < 0.02 * np.std(speed)
    if term != "linear":
        assert np.std(speed - linear) > 0.04 * np.std(linear)


def test_a_voltage_under_which_it_stood_still_is_taken_away_where_less_turns_it_later() -> None:
    time = 0.01 * np.arange(200)
    speed = np.where(time < 1.0, 0.0, 10.0)
    late = rwn.Recording(name="late", time=time, signals={"voltage": np.where(time < 0.5, 6.0, 2.0), "speed": speed})
    taken = powered(late).signals["voltage"]
    assert not taken[:100].any()
    np.testing.assert_array_equal(taken[100:], late.signals["voltage"][100:])
    rising = replace(late, signals={**late.signals, "voltage": 4.0 * time})  # friction held it, nothing else
    np.testing.assert_array_equal(powered(rising).signals["voltage"], 4.0 * time)


@pytest.mark.parametrize("name", ["ced", "undc", pytest.param("frc", marks=pytest.mark.slow)])
def test_the_page_has_what_the_fits_by_hand_give(name: str, shared: Path) -> None:
    told: dict[tuple[str, str], float] = {}
    machine = ""
    for line in PAGE.read_text(encoding="utf-8").split(f"<!-- rwn evidence {name} -->")[1].splitlines():
        if line.startswith("<!--"):
            break
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == 10 and cells[7] not in ("by hand", "---"):
            machine = cells[0] or machine
            told[machine, cells[3]] = float(cells[7])
    found = HANDS[name](shared / "data" / MACHINES[name].folder)
    assert set(told) == set(found)
    for measure, value in found.items():
        assert told[measure] == pytest.approx(value, rel=0.02), measure  # a simplex ends a little elsewhere elsewhere


def test_friction_in_closed_loop_falls_with_speed_and_holds_a_load() -> None:
    level = {"friction_base": 0.1, "friction_viscous": 0.01, "friction_stribeck": 0.05, "dtheta_stribeck": 0.2}
    level |= {"alpha": 2.0}
    assert xl330.friction_level(level, 0.0, 0.0, 0.0) == pytest.approx(0.15)
    assert xl330.friction_level(level, 0.0, 0.0, 2.0) == pytest.approx(0.12, rel=1e-6)
    time = 0.02 * np.arange(120)
    goal = np.full(120, 0.3)
    servo = xl330.Servo(time=time, goal=goal, position=np.zeros(120), bus=np.full(120, 7.0), kp=100.0)
    motor = {"kt": 0.387, "R": 4.0, "armature": 0.0018, "q_offset": 0.0, "friction_viscous": 0.02}
    free, held = (xl330.closed_loop({**motor, "friction_base": f}, servo, xl330.AUTHORS_GAIN) for f in (0.0, 9.0))
    assert free.shape == (120,)
    assert free[0] == 0.0
    assert not held.any(), "more than the motor and gravity have"
    droop = xl330.MASS * xl330.GRAVITY * xl330.LENGTH * np.sin(free[-1])
    push = motor["kt"] * xl330.AUTHORS_GAIN * 100.0 * (0.3 - free[-1]) * xl330.SUPPLY / motor["R"]
    assert push == pytest.approx(droop, rel=0.02), "where the spring of the loop holds the weight"
