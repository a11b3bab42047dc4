"""A witness: the shaft by itself, driven by the recorded current; the winding and what feeds it play no part there.

What a torque or a load does shows there too. What stands for something electrical makes the shaft move as it did not.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rwn.fit.budget import one_stage
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.residuals import loss_gained
from rwn.model.model import Model
from rwn.model.vocabulary import Effect
from rwn.recording.columns import Layout
from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED
from rwn.simulate.run import Run

Array = NDArray[np.float64]

LEVEL = 0.01  # chance that an effect which acts is contradicted
CERTAIN = 2.33  # deviations that a normal variable exceeds with that chance
ON_THE_SHAFT = frozenset({"torque", "load"})
PARTS = 16  # of the work of a stage, for each fit
MOST = 0.5  # share of the squared error, below which the shaft alone has little of it
_NONE: Mapping[str, Mapping[str, float]] = MappingProxyType({})


@dataclass(frozen=True, kw_only=True)
class ShaftAlone:
    """Rms errors of the shaft alone and of the drive: of the speed [rad/s], or else of the position [rad]."""

    alone: float
    drive: float
    signal: str

    @property
    def moves_as_recorded(self) -> bool:
        """Whether most of the squared error goes without the winding, which then is what lacks something."""
        return self.alone**2 < MOST * self.drive**2


def shaft_alone(this: Fit, problem: Problem, model: Model) -> ShaftAlone | None:
    """What an explanation leaves with and without its winding; None where the current does not tell the torque."""
    witness = _witness(this, problem, model)
    if witness is None:
        return None
    alone, drive = (float(np.sqrt(np.mean(of))) for of in (witness.squares(), witness.explained))
    signal = "speed" if all("speed" in run.recorded for run in problem.whole) else "position"
    return ShaftAlone(alone=alone, drive=drive, signal=signal)


def contradicted(this: Fit, problem: Problem, model: Model) -> tuple[str, ...]:
    """The effects of an explanation that act on the shaft, and that the shaft alone contradicts.

    Without such an effect it is as near to the recorded motion as the whole explanation with it, and with it, as it was
    found, surely farther. The rest of the shaft is fitted both times. None where the current was not recorded or does
    not tell the torque: behind a filter, or where the flux depends on it.
    """
    on_the_shaft = [name for name in this.added if this.hypothesis.table[name].site in ON_THE_SHAFT]
    witness = _witness(this, problem, model) if on_the_shaft else None
    if witness is None:
        return ()

    def refuted(name: str) -> bool:
        without = witness.squares(without=name)
        if not float(np.mean(without)) <= float(np.mean(witness.explained)):
            return False
        return loss_gained(without, witness.squares(without=name, known={name: this.values_of(name)})) > CERTAIN

    return tuple(name for name in on_the_shaft if refuted(name))


@dataclass(frozen=True, kw_only=True)
class _Witness:
    """The shaft of a drive with the recordings of what drove it, and what an explanation of the drive has of it."""

    recordings: Sequence[Recording]
    shaft: Model
    beside: Sequence[str]  # effects of the explanation that the shaft has too
    offset: Sequence[str]  # as which one of the current shows
    this: Fit
    explained: Array  # squared errors of the explanation, of every sample of the motion

    def squares(self, *, without: str = "", known: Mapping[str, Mapping[str, float]] = _NONE) -> Array:
        """Squared error of every sample of the motion, with all effects but one fitted, and some `known`."""
        problem = prepare(self.recordings, replace(self.shaft, effects={**self.shaft.effects, **known}))
        others = tuple(name for name in dict.fromkeys([*self.beside, *self.offset]) if name != without)
        starts = {name: values for name, values in self.this.starts(others).items() if name in self.this.added}
        begun = hypothesis(problem.prior, others, problem.scales, starts)
        return _squares(problem, fit(problem, begun, share=one_stage(problem.work) / PARTS))


def _witness(this: Fit, problem: Problem, model: Model) -> _Witness | None:
    """None where the current was not recorded, or does not tell the torque."""
    table, drive, whole = this.hypothesis.table, problem.drive, problem.in_free_run()
    if drive.mechanics is None or model.own_effects or "current" in problem.filters:
        return None
    hidden = (table[name].site == "flux" or table[name].filters == "current" for name in this.hypothesis.effects)
    if any(hidden) or not all(run.current.size and len(run.recorded) > 1 for run in whole.runs):
        return None
    motor = {**problem.prior.motor, **this.motor}
    torques = [np.asarray(drive.driving_torque(motor, _bridged(run), run.input)) for run in whole.runs]
    return _Witness(
        recordings=[_driven(run, torque) for run, torque in zip(whole.runs, torques, strict=True)],
        shaft=_shaft(model, this),
        beside=[n for n in this.added if table[n].site in ON_THE_SHAFT or _delays_the_speed(table[n])],
        offset=[name for name, effect in table.items() if effect.offset],
        this=this,
        explained=_squares(whole, this),
    )


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
        effects={name: values for name, values in model.effects.items() if table[name].site in ON_THE_SHAFT},
        load=model.load, recording=Layout(intersample="line", initial=model.recording.initial),
    )  # fmt: skip


def _driven(run: Run, torque: Array) -> Recording:
    """The recording of a run (n,), with the torque (n,) [N m] as its input."""
    shown = {name: run.signal(name) for name in MEASURED if name != "current" and run.signal(name).size}
    missing = {name: lost for name, lost in run.missing.items() if name in shown}
    return Recording(name=run.name, time=run.time, signals={"torque": torque, **shown}, missing=missing)


def _bridged(run: Run) -> Array:
    """The current (n,) [A], on a line between the samples that were measured."""
    lost = run.missing.get("current")
    if lost is None or lost.all():
        return run.current
    return np.interp(run.time, run.time[~lost], run.current[~lost])


def _delays_the_speed(effect: Effect) -> bool:
    return effect.site == "sensor" and any(p.unit == "s" for p in effect.parameters)


def _squares(problem: Problem, this: Fit) -> Array:
    """Squared error of every sample of the speed, of the position where there is none; 0 where it is not compared."""
    left = problem.residuals(this.vector, this.active)
    return np.concatenate([np.square(of["speed"] if "speed" in of else of["position"]) for of in left])
