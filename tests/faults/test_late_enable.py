"""A power stage that was enabled after the recording began."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import rwn
from made_up_motor import AXIS, slow_axis
from made_up_motor import SMALL as MOTOR
from rwn.faults import late_enable
from rwn.faults.fault import Fault, without
from rwn.faults.late_enable import LateEnable, _best_held, late_beside, late_enables, powered, retimed
from rwn.fit.fit import fit, fit_nominal
from rwn.fit.hypothesis import hypothesis
from rwn.fit.preparation import prepare
from rwn.model.model import Model
from rwn.search.search import _asked_again

MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "viscous_friction": 0.1})
STEPS = np.repeat(3.0 * np.random.default_rng(8).uniform(-1.0, 1.0, 60), 50)


def _run(
    voltage: np.ndarray, off: int, *, friction: float = 0.0, effects: Mapping[str, Mapping[str, float]] | None = None
) -> rwn.Recording:
    """Noisy speed of a drive whose power comes `off` samples after the recording begins."""
    time = 1e-3 * np.arange(voltage.size)
    truth = Model(kind="dc", parameters=MOTOR, effects=effects or {"coulomb-friction": {"coulomb_torque": friction}})
    acting = np.where(np.arange(voltage.size) < off, 0.0, voltage)
    speed = rwn.simulate(truth, rwn.Recording(name="run", time=time, signals={"voltage": acting})).signals["speed"]
    noisy = speed + 0.1 * np.random.default_rng(9).standard_normal(time.size)
    return rwn.Recording(name="run", time=time, signals={"voltage": voltage, "speed": noisy})


@pytest.mark.parametrize("friction", [0.0, 0.01])
def test_a_late_enable_is_found_to_the_sample_or_two(friction: float) -> None:
    recording = _run(STEPS, 130, friction=friction)
    (late,) = late_enables([recording], MODEL)
    assert abs(late.samples - 130) <= 2
    (made,) = powered([recording], [late], MODEL)
    assert not np.any(made.signals["voltage"][: late.samples - 1])
    assert np.array_equal(made.signals["voltage"][late.samples :], STEPS[late.samples :])


def test_a_late_enable_between_two_rows_is_found_to_a_tenth_of_their_time() -> None:
    fine = _run(STEPS, 263)
    rows = slice(0, None, 5)
    signals = {name: fine.signals[name][rows] for name in ("voltage", "speed")}
    (late,) = late_enables([rwn.Recording(name="run", time=fine.time[rows], signals=signals)], MODEL)
    assert late.time == pytest.approx(0.263, abs=5e-4)
    assert late.samples == 53


def test_an_explanation_with_a_delay_moves_a_late_enable() -> None:
    """A delay that the other recording shows made it seem later than it was."""
    delay = 8
    on, off = (_run(np.concatenate([np.zeros(delay), STEPS[:-delay]]), begins) for begins in (0, 130 + delay))
    recordings = [replace(r, signals={**r.signals, "voltage": STEPS}) for r in (on, off)]
    late = LateEnable(place=1, recording="run", samples=138, time=0.138)
    problem = prepare(powered(recordings, [late], MODEL), MODEL)
    starts = {"input-delay": {"delay": 7e-3}}
    delayed = fit(problem, hypothesis(problem.prior, ("input-delay",), problem.scales, starts))
    (moved,) = retimed([late], recordings, MODEL, problem, delayed)
    assert moved.time == pytest.approx(0.130, abs=1e-3)
    assert retimed([moved], recordings, MODEL, problem, delayed) == (moved,)


def test_a_fit_that_bent_the_position_to_a_wrong_instant_does_not_keep_it_there() -> None:
    """The shaft stood at the 0 that was recorded; a fit with power from 2 ms too late on begins it elsewhere."""
    recording = _run(STEPS, 130)
    acting = np.where(np.arange(STEPS.size) < 130, 0.0, STEPS)
    turned = rwn.simulate(Model(kind="dc", parameters=MOTOR), replace(recording, signals={"voltage": acting}))
    counts = np.rint(turned.signals["position"] / 1e-3) * 1e-3
    recordings = [replace(recording, signals={**recording.signals, "position": counts})]
    wrong = LateEnable(place=0, recording="run", samples=132, time=0.132)
    problem = prepare(powered(recordings, [wrong], MODEL), MODEL)
    (moved,) = retimed([wrong], recordings, MODEL, problem, fit_nominal(problem))
    assert moved.time == pytest.approx(0.130, abs=5e-4)  # of 1 ms rows; the bent motor is still in it


def test_a_late_enable_is_timed_beneath_a_late_channel_that_cuts_the_recording() -> None:
    recording = _run(STEPS, 130)
    speed = np.concatenate([np.zeros(3), np.array(recording.signals["speed"])[:-3]])
    recordings = [replace(recording, signals={**recording.signals, "speed": speed})]
    shift = Fault(name="time-shift", signals=("speed",), meaning="3 samples late", delay=3, step=1e-3)
    wrong = LateEnable(place=0, recording="run", samples=140, time=0.140)
    problem = prepare(without(powered(recordings, [wrong], MODEL), shift), MODEL)
    assert problem.whole[0].time.size == STEPS.size - 3
    (moved,) = retimed([wrong], without(recordings, shift), MODEL, problem, fit_nominal(problem))
    assert moved.time == pytest.approx(0.130, abs=1e-3)


def test_noise_that_is_not_white_ends_no_standstill() -> None:
    recording = _run(STEPS, 400)
    rng, noise = np.random.default_rng(3), np.zeros(STEPS.size)
    for k in range(1, noise.size):
        noise[k] = 0.95 * noise[k - 1] + 0.1 * rng.standard_normal()
    signals = {**recording.signals, "speed": recording.signals["speed"] + 3.0 * noise}
    (late,) = late_enables([replace(recording, signals=signals)], MODEL)
    assert abs(late.samples - 400) <= 2


def test_a_first_sample_far_off_is_no_motion() -> None:
    recording = _run(STEPS, 130)
    speed = np.array(recording.signals["speed"])
    speed[0] = 0.9  # nine deviations of what is seen from row to row
    off = replace(recording, signals={**recording.signals, "speed": speed})
    (late,) = late_enables([off], MODEL)
    assert abs(late.samples - 130) <= 2


def test_a_speed_sensor_with_a_bias_stands_still_too() -> None:
    """It reads 2 rad/s whatever the voltage does: no motion goes on like that."""
    recording = _run(STEPS, 130)
    biased = replace(recording, signals={**recording.signals, "speed": np.array(recording.signals["speed"]) + 2.0})
    (late,) = late_enables([biased], MODEL)
    assert abs(late.samples - 130) <= 2


def test_friction_that_holds_a_drive_whose_sensor_has_a_bias_is_no_late_enable() -> None:
    """What reads -2.7 rad/s is taken to turn, and no friction holds what turns."""
    run = _run(3.0 * np.sin(2 * np.pi * 1.5 * 1e-3 * np.arange(3000)), 0, friction=0.02)
    biased = replace(run, signals={**run.signals, "speed": np.array(run.signals["speed"]) - 2.7})
    known = Model(kind="dc", parameters={**MOTOR, "coulomb_friction": 0.02}, uncertainty={"coulomb_friction": 0.3})
    assert late_enables([biased], known) == ()


def test_an_even_motion_under_an_even_voltage_is_no_late_enable() -> None:
    steps = np.concatenate([np.full(200, 2.0), STEPS])
    running = _run(np.concatenate([np.full(1000, 2.0), steps]), 0)
    later = slice(1000, None)
    signals = {name: np.array(x)[later] for name, x in running.signals.items()}
    assert late_enables([rwn.Recording(name="run", time=running.time[later], signals=signals)], MODEL) == ()


def test_a_first_current_far_off_is_no_motion_of_a_shaft_whose_speed_is_zero() -> None:
    acting = np.where(np.arange(STEPS.size) < 130, 0.0, STEPS)
    time = 1e-3 * np.arange(STEPS.size)
    out = rwn.simulate(MODEL, rwn.Recording(name="run", time=time, signals={"voltage": acting})).signals
    current = out["current"] + 0.01 * np.random.default_rng(4).standard_normal(time.size)
    current[0] = 0.09
    signals = {"voltage": STEPS, "speed": np.round(out["speed"], 1), "current": current}
    (late,) = late_enables([rwn.Recording(name="run", time=time, signals=signals)], MODEL)
    assert abs(late.samples - 130) <= 2


def test_what_is_missing_later_hides_no_late_enable() -> None:
    late = _run(STEPS, 130)
    speed = np.array(late.signals["speed"])
    speed[1000:2000] += 50.0  # such as a load for a while
    (found,) = late_enables([replace(late, signals={**late.signals, "speed": speed})], MODEL)
    assert abs(found.samples - 130) <= 2


def test_two_recordings_of_one_name_are_told_apart() -> None:
    recordings = [_run(STEPS, 0), _run(STEPS, 130)]
    (late,) = late_enables(recordings, MODEL)
    on, off = powered(recordings, [late], MODEL)
    assert np.array_equal(on.signals["voltage"], STEPS)
    assert not np.any(off.signals["voltage"][: late.samples - 1])


def test_a_drive_that_is_on_from_the_beginning_has_none() -> None:
    assert late_enables([_run(STEPS, 0)], MODEL) == ()


def test_friction_that_holds_until_the_voltage_has_risen_is_no_late_enable() -> None:
    ramp = np.linspace(0.0, 3.0, 3000)
    assert late_enables([_run(ramp, 0, friction=0.02)], MODEL) == ()


def test_detents_may_hold_a_drive_as_friction_does() -> None:
    recording = slow_axis(cogging=0.09, periods=24.0)
    held = _best_held(prepare([recording], AXIS).in_windows(), [0.4])
    assert "cogging-torque" in held.added
    assert late_enables([recording], AXIS) == ()


def test_a_drive_that_later_moves_under_less_was_held_by_no_friction() -> None:
    """Its voltage still rises when it is enabled: friction that held it until then would hold it again."""
    rising = 3.0 * np.sin(2.0 * np.pi * np.arange(3000) / 1500.0)
    (late,) = late_enables([_run(rising, 130, friction=0.02)], MODEL)
    assert abs(late.samples - 130) <= 3


def test_a_recording_that_was_not_fitted_stands_still_where_the_explanation_would_move() -> None:
    problem = prepare([_run(STEPS, 0)], MODEL)
    (late,) = late_beside([_run(STEPS, 130), _run(STEPS, 0)], MODEL, problem, fit_nominal(problem))
    assert late.place == 0
    assert abs(late.samples - 130) <= 2


def test_a_late_enable_of_what_was_not_fitted_is_said() -> None:
    on, off = _run(STEPS[:800], 0), _run(STEPS[800:1600], 130)
    done = rwn.diagnose([on], MODEL, heldout=[replace(off, name="kept back")], effort=0.1)
    (said,) = (f for f in done.findings if f.kind == "late-enable")
    assert said.recording == "kept back"
    assert abs(said.count - 130) <= 2


def test_a_friction_that_is_a_little_more_than_fitted_is_no_late_enable() -> None:
    """A slow ramp moves the drive where its voltage overcomes friction, which is 5 % more on that day."""
    problem = prepare([_run(STEPS, 0, friction=0.02)], MODEL)
    names = ("coulomb-friction",)
    start = {"coulomb-friction": {"coulomb_torque": 0.02}}
    dry = fit(problem, hypothesis(problem.prior, names, problem.scales, start))
    ramp = _run(np.linspace(0.0, 3.0, 3000), 0, friction=0.021)
    assert late_beside([ramp], MODEL, problem, dry) == ()
    (late,) = late_beside([_run(np.linspace(0.0, 3.0, 3000), 800, friction=0.02)], MODEL, problem, dry)
    assert abs(late.samples - 800) <= 2


def test_an_input_that_is_late_throughout_is_a_delay() -> None:
    """A voltage that steps once from 0, and a drive that answers late: either would do; a delay says more."""
    step = np.where(np.arange(3000) < 100, 0.0, 3.0)
    late = np.where(np.arange(3000) < 160, 0.0, 3.0)
    recording = _run(late, 0)
    recording = rwn.Recording(name="run", time=recording.time, signals={**recording.signals, "voltage": step})
    assert late_enables([recording], MODEL) == ()


def test_a_delay_beside_friction_is_no_late_enable() -> None:
    """Neither holds alone what the two recordings show, and a late enable in each would."""
    ramp, step = np.linspace(0.0, 3.0, 3000), np.where(np.arange(3000) < 50, 0.0, 3.0)
    recordings = []
    for given in (ramp, step):
        acting = np.concatenate([np.zeros(40), given[:-40]])
        made = _run(acting, 0, friction=0.02)
        recordings.append(rwn.Recording(name="run", time=made.time, signals={**made.signals, "voltage": given}))
    assert late_enables(recordings, MODEL) == ()


def test_a_drive_that_never_got_power_stands_still_to_the_end() -> None:
    recordings = [_run(STEPS, 0), _run(STEPS, STEPS.size)]
    (late,) = late_enables(recordings, MODEL)
    assert late.place == 1
    assert late.samples > 0.9 * STEPS.size


def test_what_bends_the_motion_that_follows_does_not_move_a_late_enable() -> None:
    """Cogging that the nominal model lacks: to turn as far it would have to begin at another time."""
    teeth = {"cogging-torque": {"amplitude": 0.05, "periods_per_rev": 7.0, "phase": 0.0}}
    swinging = 3.0 * np.abs(np.sin(2.0 * np.pi * np.arange(3000) / 1500.0))
    (late,) = late_enables([_run(swinging, 130, effects=teeth)], MODEL)
    assert late.time == pytest.approx(0.130, abs=4e-4)


def test_a_late_enable_that_the_nominal_model_did_not_show_is_found_beside_an_explanation() -> None:
    recordings = [_run(STEPS, 0), _run(STEPS, 130)]
    explanation: Any = SimpleNamespace(fit=fit_nominal(prepare(recordings[:1], MODEL)))
    left: Any = SimpleNamespace(at_the_floor=False)
    ranking: Any = SimpleNamespace(problem=prepare(recordings, MODEL), fits=[explanation], left=left)
    (late,) = _asked_again(recordings, MODEL, (), MODEL, (), ranking).late
    assert (late.place, late.samples) == (1, pytest.approx(130, abs=2))
    known = LateEnable(place=1, recording="run", samples=130, time=0.130)
    assert len(_asked_again(recordings, MODEL, (known,), MODEL, (), ranking).late) == 1


def test_what_friction_makes_of_the_first_samples_is_not_weighed_against_all_that_holds_a_drive(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The nominal model would have moved a sample or two before; that takes seconds and could say nothing."""
    weighed: list[Any] = []
    monkeypatch.setattr(late_enable, "_worthwhile", lambda found, *_: weighed.append(found) or ())
    voltage = np.concatenate([np.zeros(60), STEPS])
    assert late_enables([_run(voltage, 61, friction=0.03)], MODEL) == ()
    assert not weighed
    late_enables([_run(voltage, 100)], MODEL)
    assert len(weighed) == 1
