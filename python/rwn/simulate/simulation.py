"""Free-run simulation of a model over a recording's input."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.errors import InputError
from rwn.model.checks import LARGEST
from rwn.model.files import model_of
from rwn.model.model import Model
from rwn.model.recordings import read_recordings
from rwn.recording.delays import delayed
from rwn.recording.filters import as_filtered
from rwn.recording.layout import Layout
from rwn.recording.recording import table_of_signals
from rwn.recording.signals import MEASURED
from rwn.simulate.coefficient_state import nearest_state
from rwn.simulate.declared import check_declared, surely_passes
from rwn.simulate.nearest_angle import angles_to_try, nearest_angle
from rwn.simulate.recorded_run import run_of
from rwn.simulate.run import Run
from rwn.simulate.scales import scales_of_input, usual_scales
from rwn.simulate.simulator import Simulator
from rwn.values import Shown, Values

if TYPE_CHECKING:
    import pandas

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
BEYOND = (
    f"A signal passes {LARGEST:g} in SI, which no drive does: look for an effect or a parameter that is far too large, "
    "or an unstable model."
)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Simulation(Shown, Values):
    """`signals` name -> (n_t,), SI, at `time` (n_t,) [s] of the recording, as its sensors would show them.

    `status`: `ok`, `diverged` or `formula-failed`, from where on each signal is held; `advice`: what to do about it.
    `linear`: in m, m/s and N.
    """

    time: Array
    signals: Mapping[str, Array]
    status: str
    advice: str
    linear: bool = False

    def table(self) -> pandas.DataFrame | dict[str, Array]:
        """Time and signals (n_t,) as columns `speed [rad/s]` in SI, which `read_recording` takes.

        A dictionary of arrays where pandas is not installed.
        """
        found: pandas.DataFrame | dict[str, Array] = table_of_signals(self.time, self.signals, linear=self.linear)
        return found

    def __repr__(self) -> str:
        return f"<Simulation {self.status}: {', '.join(self.signals)}; {len(self.time)} samples>"


def simulate(model: Model | str | Path, recording: Any) -> Simulation:
    """Simulates `model` in free run: from the input signal of `recording` and the state at its first sample alone.

    Either may be a path; `recording` may be a table in Python too.

    That state is rest or what the first samples show, as the model's `[recording]` table says; no measured signal is
    used beyond these. Only the angle at which a shaft in motion begins, where no position tells it and the model has
    an effect of the angle, is the one that fits the recording best.

    Raises InputError where the model has no values to simulate with, or effects of a size that no such drive has.
    """
    model = model_of(model)
    (recording,) = read_recordings([recording], model, compared=False)
    if not model.parameters:
        raise InputError(
            "the model has no values", where=model.source or "model", expected="numerator and denominator",
            fix="write them under [motor], or find them with rwn identify",
        )  # fmt: skip
    run, simulator, vector = run_of(recording, model).following_nothing(), Simulator.of(model), model.vector
    active = [model.effect_table[name].index for name in model.effects]
    if active:
        _check_size(model, run, simulator, vector)
    if not model.drive.coefficients:
        vector = simulator.started(run, vector)
        if run.angle_unknown:
            turning = angles_to_try([model.effect_table[name] for name in model.effects], vector)
            vector = nearest_angle(simulator, run, vector, active, angles=turning)
    elif run.in_motion:
        vector = nearest_state(simulator, run, vector, active)
    output = simulator.simulate(run, vector, active)
    shown = {name: output.signals[name] for name in MEASURED if name in model.drive.outputs}
    usable = all(_believable(values).all() for values in shown.values())  # a sensor's law may overflow by itself
    status = output.status if usable or output.status != "ok" else "diverged"
    return Simulation(
        time=recording.time,
        signals={name: _as_logged(name, run, _held(values), model.recording) for name, values in shown.items()},
        status=status,
        advice=_core.simulation_advice(status) if status == output.status else BEYOND,
        linear=model.linear,
    )


def _check_size(model: Model, run: Run, simulator: Simulator, vector: Array) -> None:
    """Raises InputError where an effect is of a size that no drive of this motor has, under this input or a usual one.

    A usual input is simulated only where this one does not settle it.
    """
    drive = model.drive
    known = scales_of_input([run], drive, simulator, vector)
    if surely_passes(model, known):
        return
    told = f"under this input or {drive.usual_input(model.motor):.2g} {drive.input_unit}"
    check_declared(model, known, usual_scales(drive, simulator, vector), told=told)


def _believable(values: Array) -> Flags:
    """Where a signal (n,) is a number that a drive could show, and that can be read again from a file."""
    found: Flags = np.abs(values) <= LARGEST
    return found


def _held(values: Array) -> Array:
    """A signal (n,) held from where it is no such number."""
    bad = np.flatnonzero(~_believable(values))
    if not bad.size:
        return values
    first = int(bad[0])
    return np.where(np.arange(values.size) < first, values, values[first - 1] if first else 0.0)


def _as_logged(name: str, run: Run, values: Array, layout: Layout) -> Array:
    """A signal (n,) as the files of this layout show it."""
    tau, rows = layout.filters.get(name, 0.0), run.interpolated
    values = as_filtered(run.time, values, tau, ticks_per_row=run.ticks_per_row) if tau else values
    shown, time = (values, run.time) if rows is None else (rows.shown(values), rows.rows)
    return delayed(time, shown, layout.delays.get(name, 0.0))
