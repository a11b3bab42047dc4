"""Every trainer and rate rule on one linear case, side by side: the parameters after each pass over the recording."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import rwn
from rwn.networks.arrays import Array
from rwn.networks.rates import ImpulseResponse, Normalised, RateRule, Thesis
from rwn.networks.trainers import GuardedDescent, RecursiveGaussNewton, StructuredLevenbergMarquardt
from rwn.studies.thesis.drive import linear_network
from rwn.studies.thesis.experiment import Row
from rwn.studies.thesis.linear import Case, thesis_rule

Path = Callable[[Case, int], Array]  # v1..v5 after 0, 1, 2 ... passes (passes + 1, 5)


@dataclass(frozen=True)
class Trained:
    """A per-sample training with a rule."""

    rule: RateRule
    follow_state: bool = False

    def __call__(self, case: Case, cycles: int) -> Array:
        u, y = case.recording()
        run = rwn.train_structured(
            case.network(),
            u,
            y,
            learn=case.learn,
            rates=self.rule,
            cycles=cycles,
            follow_state=self.follow_state,
        )
        return from_start(case, run)


def from_start(case: Case, run: rwn.OnlineTraining[rwn.StructuredNetwork]) -> Array:
    """The path of a training; NaN after a pass that diverged."""
    end = np.full((1 if run.status in ("diverged", "unstable") else 0, 5), np.nan)
    return np.vstack([case.network().v, run.linear.reshape(-1, 5), end])


@dataclass(frozen=True)
class Guarded:
    """The guarded trainer; a pass that was undone counts too."""

    trainer: GuardedDescent

    def __call__(self, case: Case, cycles: int) -> Array:
        u, y = case.recording()
        return self.trainer.train(case.network(), u, y, learn=case.learn).linear[: cycles + 1]


def recursive(case: Case, cycles: int) -> Array:
    """Recursive Gauss-Newton."""
    u, y = case.recording()
    fit = RecursiveGaussNewton(cycles=min(cycles, 10)).train(case.network(), u, y, learn=case.learn)
    return from_start(case, fit.training)


def batch(case: Case, cycles: int) -> Array:
    """Levenberg-Marquardt, one accepted iteration a pass."""
    u, y = case.recording()
    path = [case.network().v]
    for count in range(1, min(cycles, 20) + 1):
        trainer = StructuredLevenbergMarquardt(gauge=False, iterations=count)
        fit = trainer.fit(case.network(), u, y, learn=case.learn)
        path.append(fit.network.v)
        if fit.status == "converged":
            break
    return np.vstack(path)


METHODS: dict[str, Path] = {
    "thesis, running maxima, 0.5": Trained(thesis_rule(0.5)),
    "thesis, running maxima, 0.01": Trained(thesis_rule(0.01)),
    "thesis, pre-pass, 0.01": Trained(Thesis(fraction=0.01, maxima="pre-pass", shared=False)),
    "impulse response, (1 - rho)/4": Trained(ImpulseResponse()),
    "normalised, state follows, 0.5": Trained(Normalised(), follow_state=True),
    "guarded, impulse response": Guarded(GuardedDescent()),
    "guarded, normalised, state follows": Guarded(GuardedDescent(rates=Normalised(), follow_state=True)),
    "recursive Gauss-Newton": recursive,
    "Levenberg-Marquardt": batch,
}


def passes_to_one_percent(case: Case, path: Array) -> int | None:
    """Passes after which every parameter stays within 1 %; None if it never does or the run diverged."""
    true = linear_network(viscous_friction=case.viscous).v
    index = [int(group[1]) - 1 for group in case.learn]
    inside = (np.abs(path[:, index] / true[index] - 1) < 0.01).all(axis=1)
    outside = np.flatnonzero(~inside)
    last = int(outside[-1]) if len(outside) else -1
    return last + 1 if last + 1 < len(path) else None


def compare_methods(where: str, cases: list[Case], cycles: int) -> list[Row]:
    """One row per trainer and rule: passes to 1 % from the worst start, and from each."""
    rows = []
    for name, method in METHODS.items():
        paths = [method(case, cycles) for case in cases]
        passes = [passes_to_one_percent(case, path) for case, path in zip(cases, paths, strict=True)]
        there = [p for p in passes if p is not None]
        each = [
            str(p) if p is not None else "never" if np.isfinite(path).all() else "diverged"
            for p, path in zip(passes, paths, strict=True)
        ]
        safe = name.startswith("guarded")
        rows.append(
            Row(
                where=where,
                case=f"passes to 1 %, worst of {len(cases)} starts, {name}",
                ours=max(there) if len(there) == len(cases) else None,
                missing="not from every start",
                count=f"from each: {', '.join(each)}; at most {cycles}",
                judge="wanted" if safe else "none",
                wanted=float(cycles) if safe else None,
            )
        )
    return rows
