"""BAM XL330: a Dynamixel servo that swings a pendulum; the authors' six friction models run side by side."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rwn.model.model import Model
from rwn.recording.recording import Recording
from rwn.report.diagnosis import Diagnosis
from rwn.studies.machines.machine import Error, Machine, Outcome, Say, data_file, judged, nominal_model

Array = NDArray[np.float64]
PWM_LIMIT = 885.0  # counts of full duty
OFFSET = 0.03  # [rad] position that the sensor shows where the pendulum hangs, as the authors fitted it (M1: 0.0309)
FITTED = ("10h28m10", "10h28m32")  # kp = 100: sin_sin, sin_time_square; in lift_and_drop the motor is switched off
HELDOUT = ("10h29m14", "10h29m29", "10h29m37")  # kp = 400
MODELS = tuple(f"m{k}" for k in range(1, 7))
SUBSTEP = 5e-4  # [s] of the authors' models
MEASURE = "position in closed loop, kp = 400, mean absolute, {} [mrad]"
AUTHORS_LAW, LOGGED_LAW = "the authors' control law", "the law of the logged duty"
GRAVITY = 9.80665
MASS, LENGTH = 0.49, 0.1  # of the pendulum
AUTHORS_GAIN, SUPPLY = 0.00246, 7.4  # duty per kp and rad, and bus voltage [V], as the authors have them


def run(folder: Path, say: Say) -> tuple[Outcome, ...]:
    """kp = 100 is fitted, kp = 400 judges, in closed loop: at kp = 400 the voltage alone tips the pendulum over."""
    model = nominal_model("xl330")
    fitted, heldout = (
        [read_log(log(folder, k)) for k in keys] for keys in (FITTED, HELDOUT)
    )
    outcome = judged("BAM XL330", "Coulomb and viscous friction", model, fitted, [heldout[-1]], say)
    say("BAM XL330: the servo in closed loop, the authors' models side by side")
    servos = [read_servo(log(folder, k)) for k in HELDOUT]
    theirs = {
        name: json.loads(data_file(folder, f"xl330_{name}.json").read_text(encoding="utf-8")) for name in MODELS
    }
    notes, errors = [], []
    for law, gain in laws(folder).items():
        scores = {name: closed_loop_error(values, servos, gain) for name, values in theirs.items()}
        best = min(scores, key=lambda name: scores[name])
        error = _error(outcome.found, model, servos, law, gain)
        errors.append(replace(error, published=f"{scores[best]:.1f} ({best.upper()})"))
        notes.append(
            f"the authors' parameters under {law}, kp = 400 [mrad]: "
            + ", ".join(f"{name.upper()} {value:.1f}" for name, value in scores.items())
        )
    return (replace(outcome, errors=tuple(errors), notes=tuple(notes)),)


def laws(folder: Path) -> dict[str, float]:
    """Duty per kp and rad of the control laws under which a model is judged: as published, and as logged."""
    return {AUTHORS_LAW: AUTHORS_GAIN, LOGGED_LAW: logged_gain(folder)}


def log(folder: Path, key: str) -> Path:
    """The file of a run."""
    return data_file(folder, f"2026-01-15_{key}.json")


def logged_gain(folder: Path) -> float:
    """What the fitted runs say of the servo's own proportional law (see `servo_gain`)."""
    return float(np.median([servo_gain(log(folder, k)) for k in FITTED]))


def read_log(path: Path) -> Recording:
    """Voltage at the bridge (duty times bus voltage) and position of a log."""
    content = json.loads(path.read_text(encoding="utf-8"))
    rows = content["entries"]
    time, position, load, bus = (
        np.array([row[key] for row in rows], dtype=float) for key in ("timestamp", "position", "load", "input_volts")
    )
    load = np.where(load > 32767, load - 65536, load)
    voltage = load / PWM_LIMIT * bus
    name = f"{content['trajectory']} kp={content['kp']}"
    return Recording(name=name, time=time - time[0], signals={"voltage": voltage, "position": position - OFFSET})


@dataclass(frozen=True, kw_only=True)
class Servo:
    """What the servo was asked to do and did; arrays (n,), SI."""

    time: Array
    goal: Array
    position: Array  # as the sensor shows it
    bus: Array  # bus voltage
    kp: float


def read_servo(path: Path) -> Servo:
    """Goal and position of a log."""
    content = json.loads(path.read_text(encoding="utf-8"))
    columns = ("timestamp", "goal_position", "position", "input_volts")
    time, goal, position, bus = (np.array([row[key] for row in content["entries"]], dtype=float) for key in columns)
    return Servo(time=time - time[0], goal=goal, position=position, bus=bus, kp=float(content["kp"]))


def servo_gain(path: Path) -> float:
    """Duty per kp and position error [1/rad], by least squares where the duty is not at its limit."""
    servo, content = read_servo(path), json.loads(path.read_text(encoding="utf-8"))
    load = np.array([row["load"] for row in content["entries"]], dtype=float)
    duty = np.where(load > 32767, load - 65536, load) / PWM_LIMIT
    error = servo.kp * (servo.goal - servo.position)
    free = np.abs(duty) < 0.98
    return float(duty[free] @ error[free] / (error[free] @ error[free]))


def closed_loop_error(values: Mapping[str, float], servos: Sequence[Servo], gain: float) -> float:
    """Mean absolute position error [mrad] of a friction model that follows the goals of the logs."""
    errors = [np.abs(closed_loop(values, servo, gain) - servo.position) for servo in servos]
    return 1e3 * float(np.mean(np.concatenate(errors)))


def _error(found: Diagnosis, model: Model, servos: Sequence[Servo], law: str, gain: float) -> Error:
    refitted = {name: p.refitted.value for name, p in found.nominal_fit.parameters.items() if "." not in name}
    known = replace(model, parameters={**model.parameters, **refitted}, uncertainty={})
    rows = [closed_loop_error(_values(m), servos, gain) for m in (model, known)]
    corrected = closed_loop_error(_values(found.corrected), servos, gain) if found.corrected.effects else None
    return Error(measure=MEASURE.format(law), nominal=rows[0], refitted=rows[1], corrected=corrected)


def _values(model: Model) -> dict[str, float]:
    """A model of rwn in the authors' terms: what of it they have terms for."""
    p, e = model.parameters, model.effects
    dry = next((v["coulomb_torque"] for v in e.values() if "coulomb_torque" in v), p.get("coulomb_friction", 0.0))
    cogging = e.get("cogging-torque", {})
    return {
        "kt": p["torque_constant"], "ke": p["back_emf_constant"], "R": p["resistance"],
        "armature": p["inertia"] - MASS * LENGTH**2, "cogging": cogging.get("amplitude", 0.0),
        "cogging_order": cogging.get("periods_per_rev", 0.0), "cogging_phase": cogging.get("phase", 0.0),
        "friction_viscous": p["viscous_friction"], "friction_base": dry, "q_offset": OFFSET,
        "load_friction_base": e.get("load-dependent-friction", {}).get("friction_ratio", 0.0),
    }  # fmt: skip


def closed_loop(values: Mapping[str, float], servo: Servo, gain: float) -> Array:
    """Position (n,) as the sensor would show it, by the authors' stepping scheme (Duclusaud, Passault: BAM, M1 to M6).

    Friction opposes motion up to a level (`friction_level`): the torque that would stop the shaft within the step is
    cut at that level. The duty is `gain` kp (goal - position), cut at 1.
    """
    inertia = values["armature"] + MASS * LENGTH**2
    offset, back_emf = values["q_offset"], values.get("ke", values["kt"])
    ripple = [values.get(name, 0.0) for name in ("cogging", "cogging_order", "cogging_phase")]
    q, w = float(servo.position[0]) - offset, 0.0
    shown = np.empty(servo.time.size)
    shown[0] = q + offset
    for k, span in enumerate(np.diff(servo.time).tolist()):
        steps = max(1, round(span / SUBSTEP))
        h = span / steps
        bus = SUPPLY if gain == AUTHORS_GAIN else float(servo.bus[k])
        for _ in range(steps):
            duty = min(1.0, max(-1.0, gain * servo.kp * (float(servo.goal[k]) - q - offset)))
            motor = values["kt"] * (duty * bus - back_emf * w) / values["R"]
            external = -MASS * GRAVITY * LENGTH * math.sin(q)
            motor -= ripple[0] * math.sin(ripple[1] * q + ripple[2])
            stop = inertia / h * w + motor + external
            limit = friction_level(values, motor, external, w)
            w += (motor + external - math.copysign(min(abs(stop), limit), stop)) / inertia * h
            q += w * h
        shown[k + 1] = q + offset
    return shown


def friction_level(values: Mapping[str, float], motor: float, external: float, speed: float) -> float:
    """Largest friction torque of a model M1 .. M6; terms that a model does not have are zero."""
    get = values.get
    sticking = 0.0
    if "dtheta_stribeck" in values:
        sticking = math.exp(-((abs(speed) / values["dtheta_stribeck"]) ** values["alpha"]))
    level = values["friction_base"] + sticking * get("friction_stribeck", 0.0)
    level += (get("load_friction_base", 0.0) + sticking * get("load_friction_stribeck", 0.0)) * abs(external - motor)
    level += abs(external * get("load_friction_external", 0.0) - motor * get("load_friction_motor", 0.0))
    level += sticking * abs(
        external * get("load_friction_external_stribeck", 0.0) - motor * get("load_friction_motor_stribeck", 0.0)
    )
    if external * motor <= 0.0:
        square = get("load_friction_external_quad", 0.0) * external**2 if abs(external) < abs(motor) else 0.0
        square += get("load_friction_motor_quad", 0.0) * motor**2 if abs(external) > abs(motor) else 0.0
        level += sticking * square
    return level + values["friction_viscous"] * abs(speed)


MACHINE = Machine(name="xl330", folder="bam_xl330", source="Rhoban/bam", run=run)
