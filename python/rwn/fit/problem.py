"""The problem of a fit: runs, the noise that their errors are weighed by, and what is known of the drive beforehand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.fit.hypothesis import Hypothesis, hypothesis
from rwn.fit.prior import Prior
from rwn.model.drives.drive import Drive
from rwn.model.initial_state import INITIAL_POSITION
from rwn.model.vocabulary import motor_index, motor_parameters
from rwn.parallel import side_by_side
from rwn.recording.noise import Noise
from rwn.simulate.level import nearest_levels
from rwn.simulate.nearest_angle import angles_to_try, nearest_angle
from rwn.simulate.own_unknowns import LevelShare
from rwn.simulate.run import Run
from rwn.simulate.simulator import NormalEquations, Output, Simulator
from rwn.simulate.unknown_inputs import UnknownInputs, unknown_inputs
from rwn.simulate.windows import windowed

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Problem:
    """The error of simulation over several runs, weighted by the noise of each signal (output error)."""

    drive: Drive
    simulator: Simulator
    runs: tuple[Run, ...]  # what is fitted: free runs, or windows of them
    whole: tuple[Run, ...]  # the free run over each recording, as recorded
    noise: Mapping[str, Noise]  # of each recorded signal
    prior: Prior
    scales: Mapping[str, float]  # quantities that parameters are measured against
    filters: Mapping[str, float] = field(default_factory=dict)  # digital ones [s] by signal, undone in the runs
    # partial autocorrelations of the noise of signals in which it lasts
    coloured: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    inflation: float = 1.0  # variance times correlation time of what the best fit leaves: so many samples count as one

    @property
    def work(self) -> _core.Work:
        """Meter of what all simulations have cost."""
        return self.simulator.work

    @property
    def samples(self) -> int:
        """Of all recorded signals."""
        return sum(r.signal(s).size for r in self.runs for s in r.recorded)

    def share_kept(self, signal: str, time_constant: float) -> float:
        """phi of a first-order filter of a signal: of what it showed a sample ago, how much it shows still."""
        return float(np.exp(-self._step(signal) / time_constant))

    def time_kept(self, signal: str, share: float) -> float:
        """The time constant [s] of a first-order filter of which that is the share kept."""
        return -self._step(signal) / float(np.log(share))

    def _step(self, signal: str) -> float:
        return float(np.median([r.sample_time for r in self.runs if r.signal(signal).size]))

    def metered(self) -> Problem:
        """The same problem with a meter of its own."""
        return replace(self, simulator=replace(self.simulator, work=_core.Work()))

    def in_free_run(self) -> Problem:
        """The same over whole recordings as they were recorded."""
        return replace(self, runs=self.whole)

    def in_windows(self) -> Problem:
        """The same in short windows, each from the recorded motion."""
        return replace(self, runs=tuple(map(windowed, self.runs)))

    def on(self, runs: Sequence[Run]) -> Problem:
        """The same on other recordings, simulated from their input alone."""
        return replace(self, runs=tuple(r.following_nothing() for r in runs))

    @cached_property
    def recorded_motion(self) -> tuple[UnknownInputs, ...]:
        """The motion along each whole recording, with what the nominal model leaves over at its given values."""
        vector = self.as_given().vector
        return tuple(unknown_inputs(self.drive, self.simulator, run, vector) for run in self.whole)

    def as_given(self) -> Hypothesis:
        """The nominal model at its given values."""
        return hypothesis(self.prior, (), self.scales)

    def started(self, run: Run, vector: Array, active: Sequence[int]) -> Array:
        """The parameter vector (all,) with the start and the levels of this run filled in.

        An angle that nothing tells, of a run that was not fitted, is the one at which it fits best, as is the level of
        what differs from recording to recording.
        """
        begun = self.simulator.started(run, vector)
        levels = (*(() if run.levels else self.prior.levels), *run.own_levels)
        if levels:
            begun = nearest_levels(self.simulator, run, begun, active, levels, noise=self.noise)
        if not run.angle_unknown or motor_index(INITIAL_POSITION) in {u.parameter for u in run.start_unknowns}:
            return begun
        effects = [effect for effect in self.prior.table.values() if effect.index in active]
        angles = angles_to_try(effects, begun)
        return nearest_angle(self.simulator, run, begun, active, angles=angles, noise=self.noise)

    def simulate(self, run: Run, vector: Array, active: Sequence[int], by: Sequence[int] = ()) -> Output:
        """One run: signals (n,) in SI, with derivatives (n, p) by the parameters `by`."""
        return self.simulator.simulate(run, self.started(run, vector, active), active, by)

    def residuals(self, vector: Array, active: Sequence[int]) -> list[dict[str, Array]]:
        """Recorded minus simulated (n,) per run and signal, in SI, unweighted; 0 where they are not compared."""

        def one(run: Run) -> dict[str, Array]:
            out = self.simulate(run, vector, active).signals
            left = {s: run.signal(s) - out[s] for s in run.recorded}
            for signal in left:
                left[signal][run.not_compared(signal)] = 0.0
            return left

        return side_by_side(one, self.runs)

    def error(self, vector: Array, active: Sequence[int]) -> float:
        """Weighted squared error at a parameter vector (all,); infinite where a run diverged."""
        return self.normal(vector, active, ()).chi2

    def normal(self, vector: Array, active: Sequence[int], by: Sequence[int]) -> NormalEquations:
        """Normal equations (p, p), (p,) by the parameters `by`, summed over the runs."""
        chi2, count, gradient, curvature = 0.0, 0, np.zeros(len(by)), np.zeros((len(by), len(by)))
        for one in side_by_side(lambda r: self.normal_of(r, vector, active, by), self.runs):
            if not one.finite or not np.isfinite(one.curvature).all():
                return NormalEquations(
                    chi2=np.inf, gradient=gradient, curvature=curvature, finite=False, count=max(count, 1)
                )
            chi2, count = chi2 + one.chi2, count + one.count
            gradient, curvature = gradient + one.gradient, curvature + one.curvature
        return NormalEquations(chi2=chi2, gradient=gradient, curvature=curvature, count=count)

    def normal_of(self, run: Run, vector: Array, active: Sequence[int], by: Sequence[int]) -> NormalEquations:
        """Normal equations (p, p), (p,) of one run, of what is unknown of it alone at its place in `by`."""
        core, begun = _core.parameter_count(), self.started(run, vector, active)
        adds_to, levels = dict(run.start_unknowns), self._levels(run, vector, active)
        # what is unknown of other runs changes nothing here
        here = [levels[k].parameters if k in levels else (adds_to.get(k, k),) for k in by]
        wanted = sorted({p for parameters in here for p in parameters if p < core})
        found = self.normal_at(run, begun, active, wanted)
        if (wanted == list(by) and not levels) or not (found.finite and np.isfinite(found.curvature).all()):
            return found
        column = {k: j for j, k in enumerate(wanted)}
        factor = np.ones(core)
        for place, level in levels.items():
            if not level.adds:
                factor[list(level.parameters)] *= np.exp(level.share * vector[place])
        chosen = np.zeros((len(wanted), len(by)))
        for j, (k, parameters) in enumerate(zip(by, here, strict=True)):
            for p in parameters:
                if p in column:
                    by_level = levels[k].share * (1.0 if levels[k].adds else begun[p]) if k in levels else factor[p]
                    chosen[column[p], j] = by_level
        return replace(found, gradient=chosen.T @ found.gradient, curvature=chosen.T @ found.curvature @ chosen)

    def _levels(self, run: Run, vector: Array, active: Sequence[int]) -> dict[int, LevelShare]:
        """The levels of a run by their places, each of those of its parameters that act."""
        if not run.levels:
            return {}
        switched = (e for e in self.prior.table.values() if e.index in active)
        acting = {e.first + k for e in switched for k in range(len(e.every))} | set(range(len(motor_parameters())))
        known = [level for level in run.levels if level.place < vector.size]
        return {u.place: u._replace(parameters=tuple(p for p in u.parameters if p in acting)) for u in known}

    def normal_at(self, run: Run, vector: Array, active: Sequence[int], by: Sequence[int]) -> NormalEquations:
        """Normal equations (p, p), (p,) of one run whose start is part of `vector` (all,)."""
        return self.simulator.normal_equations(run, vector, active, by, noise=self.noise)
