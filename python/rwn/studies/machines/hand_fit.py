"""The best physical fit that we can make by hand with scipy, machine by machine: what a diagnosis has to stand beside.

Each machine has a short list of the physics that is obvious in its recordings, with a first guess of each number. What
is fitted and what judges is as in the diagnosis.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rwn.model.files import read_model
from rwn.recording.inspection import inspected
from rwn.recording.recording import Recording, read_recording
from rwn.studies.machines import ced, emps, fra233, frc, hall, laas, odrive, undc, xl330
from rwn.studies.machines.machine import cut, data_file, nominal_model
from rwn.studies.machines.sliding_motor import Drive, slide

Array = NDArray[np.float64]
Guess = Mapping[str, float]
Errors = Mapping[tuple[str, str], float]  # (machine, measure) -> error, as the diagnosis states it

STILL = 0.02  # of the largest speed: below it a shaft stands
DIFFERENCE = 1e-4  # of a parameter's guess, for the Jacobian


# ---- a motor with dry friction, fitted by simulation -----------------------------------------------------------------


def fitted(guess: Guess, runs: Sequence[Recording], *, given: str, seen: str) -> dict[str, float]:
    """The parameters that simulate the runs best, each signal in units of its own size."""
    from scipy.optimize import least_squares

    sizes = np.array([abs(v) or 1.0 for v in guess.values()])
    (runs, _) = inspected(runs)
    drives = [_drive(run, given) for run in runs]

    def errors(x: Array) -> Array:
        """(samples, k) of k parameter sets (parameters, k)."""
        p = dict(zip(guess, sizes[:, None] * x, strict=True))
        parts = []
        for run, drive in zip(runs, drives, strict=True):
            signal = seen if seen in run.signals else "position"
            known, measured = _known(run, signal), run.signals[signal]
            size = np.linalg.norm(measured[known] - np.mean(measured[known]))  # each run counts alike
            parts.append((slide(p, drive)[signal] - measured[:, None])[known] / size)
        return np.concatenate(parts)

    def slopes(x: Array) -> Array:
        near = errors(x[:, None] + DIFFERENCE * np.eye(x.size, x.size + 1, 1))
        out: Array = (near[:, 1:] - near[:, :1]) / DIFFERENCE
        return out

    start = np.array(list(guess.values())) / sizes
    low = [-np.inf if name[:3] in ("cos", "sin", "off", "une") else 0.0 for name in guess]
    found = least_squares(lambda x: errors(x[:, None])[:, 0], start, slopes, bounds=(low, np.inf), x_scale=1.0)
    return dict(zip(guess, sizes * found.x, strict=True))


def shown(p: Guess, run: Recording, *, given: str) -> dict[str, Array]:
    """Speed and position (n,) of a fitted motor in a recording."""
    one = {name: np.array([value]) for name, value in p.items()}
    return {name: values[:, 0] for name, values in slide(one, _drive(run, given)).items()}


def rms(run: Recording, signal: str, simulated: Array) -> float:
    """Of the samples that measure something."""
    (checked,), _ = inspected([run])
    return float(np.sqrt(np.mean((simulated - run.signals[signal])[_known(checked, signal)] ** 2)))


def _drive(run: Recording, given: str) -> Drive:
    """Its input, and the speed that it begins with."""
    speed = run.signals["speed"] if "speed" in run.signals else np.gradient(run.signals["position"], run.time)
    begins = float(speed[0]) if abs(speed[0]) > STILL * np.max(np.abs(speed)) else 0.0
    angle = float(run.signals["position"][0]) if "position" in run.signals else 0.0
    return Drive(time=run.time - run.time[0], given=np.array(run.signals[given]), speed=begins, angle=angle)


def powered(run: Recording) -> Recording:
    """Without the voltage under which it stood still, though it turned under less later: it was enabled late."""
    speed, voltage = np.abs(run.signals["speed"]), np.array(run.signals["voltage"])
    moves = int(np.argmax(speed > STILL * np.max(speed)))
    if moves > 2 and np.max(np.abs(voltage[: 3 * moves // 4])) > np.max(np.abs(voltage[3 * moves // 4 : moves + 1])):
        voltage[:moves] = 0.0
    return replace(run, signals={**run.signals, "voltage": voltage})


def _known(run: Recording, signal: str) -> NDArray[np.bool_]:
    return ~run.missing.get(signal, np.zeros(run.time.size, dtype=bool))


# ---- the machines ----------------------------------------------------------------------------------------------------


def _fra233(folder: Path) -> Errors:
    """Coulomb friction, an offset, and what acts late; no voltage until the bridge is enabled."""
    layout = nominal_model("fra233").recording
    runs = {
        name: powered(read_recording(data_file(folder, f"{name}_1.mat"), layout=layout))
        for name in (*fra233.FITTED, *fra233.HELDOUT)
    }
    guess = {"gain": 1400.0, "damping": 68.0, "dry": 850.0, "offset": 0.0, "delay": 1e-3}
    p = fitted(guess, [runs[name] for name in fra233.FITTED], given="voltage", seen="speed")
    return {
        ("FRA233", f"speed, {name} run [rad/s]"): rms(
            runs[name], "speed", shown(p, runs[name], given="voltage")["speed"]
        )
        for name in fra233.HELDOUT
    }


def _frc(folder: Path) -> Errors:
    """kS, kV, kA, a delay, and the filter of the velocity."""
    found = {}
    guess = {"gain": 20.0, "damping": 2.4, "dry": 15.0, "delay": 0.05, "lag": 0.02}
    for file, words, columns, unit in frc.MECHANISMS:
        runs = {t: frc.read_sysid(data_file(folder, file), t, columns, unit) for t in (*frc.FITTED, *frc.HELDOUT)}
        p = fitted(guess, [runs[t] for t in frc.FITTED], given="torque", seen="speed")
        for t in frc.HELDOUT:
            found[words, f"speed, {t} [rad/s]"] = rms(runs[t], "speed", shown(p, runs[t], given="torque")["speed"])
    return found


def _hall(folder: Path) -> Errors:
    """Coulomb friction, a bridge that lets the motor coast between its pulses, and a speed that comes late."""
    train, test = hall.parts(folder)
    guess = {"gain": 200.0, "damping": 1.0, "dry": 100.0, "coasting": 220.0, "delay": 2e-3}
    p = fitted(guess, [train], given="voltage", seen="speed")
    return {
        ("Hall BLDC", "speed, last rows [rad/s]"): rms(test, "speed", shown(p, test, given="voltage")["speed"])
    }


def _undc(folder: Path) -> Errors:
    """Coulomb friction, and a bridge that lets the motor coast between its pulses."""
    guess = {"gain": 80.0, "damping": 0.6, "dry": 24.0, "coasting": 14.0, "delay": 0.01}
    p = fitted(guess, [undc.read_run(folder, *run) for run in undc.FITTED], given="voltage", seen="speed")
    found = {}
    for name, columns, signal in undc.HELDOUT:
        run = undc.read_run(folder, name, columns, signal)
        error = rms(run, signal, shown(p, run, given="voltage")[signal])
        found["UNDC", f"{signal}, {name} [{undc.UNITS[signal]}]"] = float(np.rad2deg(error))
    return found


def _laas(folder: Path) -> Errors:
    """Coulomb friction; the current by the winding's own balance, whose coefficients the fitted rows give."""
    train, test = laas.parts(folder)
    guess = {"gain": 7000.0, "damping": 130.0, "dry": 400.0, "offset": 0.0, "delay": 1e-3}
    p = fitted(guess, [train], given="voltage", seen="speed")
    speeds = [shown(p, run, given="voltage")["speed"] for run in (train, test)]
    columns = [
        np.column_stack([r.signals["voltage"], w, np.ones(w.size)]) for r, w in zip((train, test), speeds, strict=True)
    ]
    weights = np.linalg.lstsq(columns[0], train.signals["current"], rcond=None)[0]
    return {
        ("LAAS", "speed, later rows [rad/s]"): rms(test, "speed", speeds[1]),
        ("LAAS", "current, later rows [A]"): rms(test, "current", columns[1] @ weights),
    }


def _emps(folder: Path) -> Errors:
    """Friction that differs by direction: the force by least squares, the free run by simulation."""
    layout = read_model(emps.NOMINAL).recording
    train, pulses = (read_recording(data_file(folder, f"{n}.mat"), layout=layout) for n in emps.FILES)

    def columns(run: Recording) -> tuple[Array, Array]:
        _, w, a, force = emps.filtered(run)
        return np.column_stack([a, w, np.sign(w), np.abs(w), np.ones(w.size)]), force

    x = np.linalg.lstsq(*columns(train), rcond=None)[0]
    there, force = columns(pulses)
    mass, viscous, dry, uneven, offset = x
    guess = {
        "gain": 1.0 / mass, "damping": viscous / mass, "dry": dry / mass, "uneven": uneven / mass,
        "offset": -offset / mass,
    }  # fmt: skip
    p = fitted(guess, [train], given="force", seen="position")
    free = shown(p, pulses, given="force")["position"] - pulses.signals["position"]
    return {
        ("EMPS", "driving force, PULSES [%]"): 100.0 * float(np.linalg.norm(force - there @ x) / np.linalg.norm(force)),
        ("EMPS", emps.FREE_RUN): 1e3 * float(np.sqrt(np.mean(free[emps.OFFICIAL :] ** 2))),
    }


def _odrive(folder: Path) -> Errors:
    """Inertia, friction, and the harmonics that its users state, by least squares on the current itself."""
    first, second = (odrive.read_revolution(data_file(folder, f"nocomp_{k}.npy")) for k in (0, 1))
    seen = second.signals["torque"]
    left = seen - odrive.predicted(first, second, list(odrive.HARMONICS))
    return {("ODrive", odrive.CURRENT): 100.0 * float(np.linalg.norm(left) / np.linalg.norm(seen))}


def _xl330(folder: Path) -> Errors:
    """Load-dependent friction in closed loop (the authors' law M3), by simplex: its steps are not smooth."""
    from scipy.optimize import minimize

    fit, judge = ([xl330.read_servo(xl330.log(folder, k)) for k in keys] for keys in (xl330.FITTED, xl330.HELDOUT))
    gain = xl330.logged_gain(folder)
    guess = {"kt": 0.387, "friction_base": 0.009, "friction_viscous": 0.0037, "load_friction_base": 0.24}
    fixed = {"R": 4.0, "armature": 0.0018, "q_offset": xl330.OFFSET}

    def values(x: Array) -> dict[str, float]:
        return {**fixed, **{name: v * float(s) for (name, v), s in zip(guess.items(), x, strict=True)}}

    def error(x: Array) -> float:
        return xl330.closed_loop_error(values(np.abs(x)), fit, gain)

    best = minimize(error, np.ones(len(guess)), method="Nelder-Mead", options={"maxfev": 60})
    found = values(np.abs(best.x))
    return {
        ("BAM XL330", xl330.MEASURE.format(law)): xl330.closed_loop_error(found, judge, duty)
        for law, duty in xl330.laws(folder).items()
    }


def _ced(folder: Path) -> Errors:
    """A linear model of third order whose sensor sees |w|^e; on the test its state is fitted to the first samples."""
    found = {}
    for whole, _, _ in ced.records(folder):
        train, test = cut(whole, 0, ced.TRAINED), cut(whole, ced.TRAINED)
        for window in ced.WINDOWS:
            measure = ced.MEASURE.format(window)
            found[f"CED, {whole.name}", measure] = _rectified(train, test, window)
    return found


def _rectified(train: Recording, test: Recording, window: int) -> float:
    from scipy.optimize import least_squares
    from scipy.signal import lfilter

    def seen(run: Recording, law: Array, state: Array) -> Array:
        poles = np.poly([law[3], law[4] + 1j * law[5], law[4] - 1j * law[5]]).real
        linear = lfilter(np.concatenate([[0.0], law[:3]]), poles, run.signals["voltage"], zi=state)[0]
        out: Array = np.abs(linear) ** law[6]
        return out

    def misfit(x: Array) -> Array:
        return seen(train, x[:7], x[7:]) - train.signals["speed"]

    tries = [
        least_squares(misfit, [gain, gain, 0.0, 0.95, 0.85, 0.45, 1.3, 0.1, 0.1, 0.1], x_scale="jac")
        for gain in (0.02, -0.02, 0.1)
    ]
    law = min(tries, key=lambda t: t.cost).x[:7]
    states = [
        least_squares(lambda s: (seen(test, law, s) - test.signals["speed"])[:window], first)
        for first in np.vstack([np.eye(3), -np.eye(3)])
    ]
    left = seen(test, law, min(states, key=lambda s: s.cost).x) - test.signals["speed"]
    return float(np.sqrt(np.mean(left[window:] ** 2)))


HANDS: dict[str, Callable[[Path], Errors]] = {
    "emps": _emps, "ced": _ced, "fra233": _fra233, "xl330": _xl330, "frc": _frc, "odrive": _odrive, "laas": _laas,
    "undc": _undc, "hall": _hall,
}  # fmt: skip
