"""A witness: the shaft by itself, driven by the recorded current; the winding and what feeds it play no part there.

What a torque or a load does shows there too. What stands for something electrical makes the shaft move as it did not.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rwn.decide.half import PARTS, Half, squares
from rwn.fit.budget import one_stage
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.name.multiple_shooting import FAR_OFF
from rwn.recording.layout import Layout
from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED
from rwn.simulate.run import Run

Array = NDArray[np.float64]

EQUATION = "mechanical"
MOST = 0.5  # share of the squared error, below which the shaft alone has little of it


@dataclass(frozen=True, kw_only=True)
class ShaftAlone:
    """Rms errors of the shaft alone and of the drive: of the speed [rad/s], or else of the position [rad]."""

    alone: float
    drive: float
    noise: float  # of what was recorded
    signal: str

    @property
    def moves_as_recorded(self) -> bool:
        """Whether the shaft alone follows the motion, and most of the error goes: then the winding lacks something."""
        return self.alone**2 < min(MOST * self.drive**2, FAR_OFF * self.noise**2)


def shaft_alone(this: Fit, problem: Problem, model: Model) -> ShaftAlone | None:
    """What an explanation leaves with and without its winding; None where the current does not tell the torque."""
    half = shaft_of(this, problem, model)
    if half is None:
        return None
    alone, drive = (float(np.sqrt(np.mean(of))) for of in (half.squares(), half.explained))
    signal = _motion_of(problem.whole)
    return ShaftAlone(alone=alone, drive=drive, noise=problem.noise[signal].deviation, signal=signal)


def shaft_of(this: Fit, problem: Problem, model: Model) -> Half | None:
    """The shaft of an explanation; None where the current was not recorded or does not tell the torque.

    That is so behind a filter, and where the flux depends on the current.
    """
    table, drive, whole = this.hypothesis.table, problem.drive, problem.in_free_run()
    if drive.mechanics is None or model.own_effects or "current" in problem.filters:
        return None
    hidden = (table[name].site == "flux" or table[name].filters == "current" for name in this.hypothesis.effects)
    if any(hidden) or not all(run.current.size and len(run.recorded) > 1 for run in whole.runs):
        return None
    motor = {**problem.prior.motor, **this.motor}
    torques = [np.asarray(drive.driving_torque(motor, run.bridged("current"), run.input)) for run in whole.runs]
    given = drive.mechanics.input
    recordings = [_driven(run, given, torque) for run, torque in zip(whole.runs, torques, strict=True)]
    shaft, signal = _shaft(model, this), _motion_of(whole.runs)
    beside = [name for name in this.added if table[name].mismatch == EQUATION or table[name].takes_time]
    offset = [name for name, effect in table.items() if effect.steady]  # as which one of the current shows

    def squares_of(without: str, known: Mapping[str, Mapping[str, float]]) -> Array:
        prepared = prepare(recordings, replace(shaft, effects={**shaft.effects, **known})).in_free_run()
        others = tuple(name for name in dict.fromkeys([*beside, *offset]) if name != without)
        starts = {name: values for name, values in this.starts(others).items() if name in this.added}
        begun = hypothesis(prepared.prior, others, prepared.scales, starts)
        return squares(prepared, fit(prepared, begun, share=one_stage(prepared.work) / PARTS), signal)

    return Half(
        name="shaft", judged=tuple(name for name in this.added if table[name].mismatch == EQUATION),
        explained=squares(whole, this, signal), squares_of=squares_of,
    )  # fmt: skip


def _motion_of(runs: Sequence[Run]) -> str:
    return "speed" if all("speed" in run.recorded for run in runs) else "position"


def _shaft(model: Model, this: Fit) -> Model:
    """The shaft of a motor as a drive by itself: what is not known of the torque is not known of what it moves."""
    drive = model.drive.mechanics
    assert drive is not None
    parameters = {p.name: model.parameters[p.name] for p in drive.parameters if p.name in model.parameters}
    doubt = model.drive.torque_spread(model.uncertainty)
    spread = {n: float(np.hypot(model.uncertainty.get(n, 0.0), doubt)) for n, value in parameters.items() if value}
    table = this.hypothesis.table
    return Model(
        kind=drive.kind, parameters=parameters, uncertainty={n: s for n, s in spread.items() if s > 0.0},
        effects={name: values for name, values in model.effects.items() if table[name].mismatch == EQUATION},
        load=model.load, recording=Layout(intersample="line", initial=model.recording.initial),
    )  # fmt: skip


def _driven(run: Run, given: str, torque: Array) -> Recording:
    """The recording of a run (n,), with the torque (n,) [N m] as its input, which is called `given`."""
    shown = {name: run.signal(name) for name in MEASURED if name != "current" and run.signal(name).size}
    missing = {name: lost for name, lost in run.missing.items() if name in shown}
    return Recording(name=run.name, time=run.time, signals={given: torque, **shown}, missing=missing)
