"""What a blind trial is recorded on: motor, command, speed loop and sensors."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rwn.studies.trials.aim import UnsuitableError
from rwn.studies.trials.bench import Experiment, Noise, Setup, encoder
from rwn.studies.trials.excitations import CLOSED_LOOP, KINDS, OPEN_LOOP
from rwn.studies.trials.motors import MOTORS, plant_of
from rwn.studies.trials.plan import Plan
from rwn.studies.trials.plant import simulate
from rwn.studies.trials.scene import draw_scene
from rwn.studies.trials.trial import make_trial, must_move


def test_recording_is_the_plant_and_its_noise() -> None:
    trial = make_trial(Plan(3, 1, "null", (), 1.0))
    noise, recording = trial.answer["noise"], trial.train[0]
    clean = simulate(trial.answer["plant"], recording.voltage, rate=trial.answer["sample_rate_Hz"])
    rms = float(np.sqrt(np.mean((recording.speed - clean.sensed_speed) ** 2)))
    assert rms == pytest.approx(noise["speed_rms"], rel=0.2)


@pytest.mark.parametrize("kind", KINDS)
def test_excitation_has_peak_one_and_moves(kind: str) -> None:
    shape = (OPEN_LOOP | CLOSED_LOOP)[kind](np.random.default_rng(1), 3000, 40.0)
    assert shape.shape == (3000,)
    assert np.max(np.abs(shape)) == pytest.approx(1.0)
    assert np.std(shape) > 0.1


@pytest.mark.parametrize("motor", MOTORS, ids=lambda motor: motor.name)
def test_speed_loop_settles_on_its_reference(motor: Any) -> None:
    rate = 2000.0
    setup = Setup(motor, rate, ("V", "w"))
    experiment = Experiment("cl_steps", int(100 * motor.time_constant * rate), 0.5 * motor.voltage, (1, 2))
    trace = setup.run(experiment, plant_of(motor.nominal(dry=True)))
    wanted = setup.shape(experiment) * 0.4 * motor.voltage / motor.torque_constant
    closed = motor.torque_constant * motor.time_constant / setup.loop[0]  # s
    changes = np.flatnonzero(np.diff(wanted))
    ends = changes[1:][np.diff(changes) > 4.5 * closed * rate]
    assert ends.size > 2
    off = np.abs(trace.speed[ends] - wanted[ends]) / np.max(np.abs(wanted))
    assert np.median(off) < 0.01
    assert np.max(off) < 0.1  # after a large step, on which the voltage is at its ceiling for long
    assert np.max(np.abs(trace.voltage)) <= 1.15 * experiment.amplitude * (1 + 1e-6)


def test_encoder_speed_has_the_declared_error() -> None:
    rng = np.random.default_rng(2)
    speed = 80.0 + 30.0 * np.cumsum(rng.standard_normal(20_000)) / 100.0
    position = np.cumsum(speed) / 1000.0
    _, seen = encoder(position, 2048, 1000.0)
    exact = np.gradient(position) * 1000.0
    rms = float(np.sqrt(np.mean((seen - exact)[1:-1] ** 2)))
    assert rms == pytest.approx(Noise.of_encoder(2048, 1000.0, 0.0).speed, rel=0.05)


def test_a_machine_that_cannot_be_is_drawn_again() -> None:
    """Two effects may leave no inertia on the motor side (trial 45 of seed 10013)."""
    scene, _ = draw_scene(np.random.default_rng(1), (0, 1, 1), [])
    nothing_left = scene.plant([]) | {"load_inertia": 2.0 * scene.true["inertia"]}
    with pytest.raises(UnsuitableError, match="no such machine"):
        scene.run(scene.train, nothing_left)


def test_held_out_runs_move() -> None:
    """One of trial 22 of seed 10014 stood still in its dry friction."""
    scene, _ = draw_scene(np.random.default_rng(1), (0, 1, 1), [])
    moving = scene.run(scene.heldout, scene.plant([]))
    must_move(moving)
    stuck = scene.run(scene.heldout, scene.plant([]) | {"coulomb_plus": 1e3, "coulomb_minus": 1e3})
    with pytest.raises(UnsuitableError, match="never moves"):
        must_move([*moving, *stuck])
