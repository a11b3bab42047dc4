"""What an unknown torque depends on: a wavelet network over each state, judged on samples that it was not fitted to.

The networks stand beside the nominal equations, so they are made orthogonal to them (arXiv 2511.01321): what a change
of inertia, friction or torque constant would explain is taken out of the error and of every wavelet first. A motor's
speed error is explained through its linear answer to a torque, so that no measurement is differentiated; of an axis,
the torque that inverse dynamics leave over.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.networks.wavelets import Wavelet, dyadic_places
from rwn.simulate.linear_response import speed_filter
from rwn.simulate.unknown_inputs import UnknownInputs

Array = NDArray[np.float64]

WAVELETS = 15
CLEAR = 0.25  # least share of the error's energy for which a dependence is put into words
ORDERS = np.arange(1, 61)
CURVE, CLOUD, FEWEST = 60, 400, 20  # points of a drawn curve and of what it is drawn through, and samples behind each
DRAWN = 20_000  # samples of a picture; of longer recordings as many means of consecutive samples
COORDINATES = {"speed": "rad/s", "acceleration": "rad/s^2", "current": "A", "time": "s"}


@dataclass(frozen=True, kw_only=True)
class Law:
    """The unknown torque as a function of one state."""

    coordinate: str
    unit: str
    share: float  # of the error's energy on samples that were not fitted
    amplitude: float  # sqrt(2) rms of `torque`, each of whose points stands for as many samples, or of the sine
    periods: int  # per revolution; 0 where the state is not the angle
    x: Array  # (n,) values of the state along the curve, in `unit`
    torque: Array  # (n,) [N m or N]; without what the nominal parameters may explain, as `left`
    state: Array  # (m,) of the recordings, in `unit`
    left: Array  # (m,) unknown torque there that no change of the nominal parameters explains; means of many samples


@dataclass(frozen=True, kw_only=True)
class _Error:
    """What is to be explained, recordings end to end, and how it answers a torque."""

    states: dict[str, Array]
    value: Array  # (n,)
    answer: Callable[[Array], Array]  # torque columns (n, k) to what they do to the error
    regressors: Array  # (n, 5) torques of the nominal parameters
    answers: Array  # (n, 5) what these do to the error

    def beyond_nominal(self, torque: Array) -> Array:
        """What no change of the nominal parameters makes of a torque (n,)."""
        scale = np.maximum(np.linalg.norm(self.regressors, axis=0), 1e-300)
        weights = np.linalg.lstsq(self.regressors / scale, torque)[0]
        left: Array = torque - self.regressors / scale @ weights
        return left


def laws(
    problem: Problem, this: Fit, inputs: Sequence[UnknownInputs], *, linear: bool = False
) -> tuple[Law, ...]:
    """The dependence on each state, the one that explains most first; states that explain nothing are left out."""
    error = _error(problem, this, inputs)
    found = [_over(name, error, linear) for name in COORDINATES if np.ptp(error.states[name]) > 0.0]
    if np.ptp(error.states["angle"]) > 2.0 * np.pi:
        found.append(_over_angle(error))
    return tuple(sorted((law for law in found if law.share > 0.02), key=lambda law: -law.share))


def _error(problem: Problem, this: Fit, inputs: Sequence[UnknownInputs]) -> _Error:
    from scipy.signal import lfilter  # late: the command line starts without it

    thin = 1 + sum(u.time.size for u in inputs) // DRAWN
    names = (*COORDINATES, "angle", "torque")
    states = {name: np.concatenate([_means(getattr(u, name), thin) for u in inputs]) for name in names}
    ends = np.cumsum([u.time.size // thin for u in inputs])[:-1]
    by_filter = problem.drive.winding and all(r.speed.size for r in problem.runs)

    def answer(columns: Array) -> Array:
        if not by_filter:
            return columns
        parts = []
        for run, part in zip(problem.runs, np.split(columns, ends), strict=True):
            a, b = speed_filter(problem.drive, this.vector, thin * run.sample_time)
            parts.append(lfilter([0.0, b], [1.0, -a], part, axis=0))
        return np.concatenate(parts)

    value, current = states["torque"], states["current"]
    if by_filter:
        residuals = problem.residuals(this.vector, this.active)
        value = np.concatenate([_means(r["speed"], thin) for r in residuals])
        # the recorded current drives the unknown torque too: beside it nothing of that would be left
        simulated = (problem.simulate(r, this.vector, this.active).signals["current"] for r in problem.runs)
        current = np.concatenate([_means(i, thin) for i in simulated])
    speed = states["speed"]
    regressors = np.stack([speed, np.sign(speed), states["acceleration"], current, np.ones(speed.size)], axis=1)
    return _Error(states=states, value=value, answer=answer, regressors=regressors, answers=answer(regressors))


def _means(values: Array, count: int) -> Array:
    """Means of every `count` consecutive values."""
    whole = values.size - values.size % count
    means: Array = values[:whole].reshape(-1, count).mean(axis=1) if count > 1 else values
    return means


def _over(name: str, error: _Error, linear: bool) -> Law:
    low, high = np.percentile(error.states[name], [0.5, 99.5])
    x = np.clip((error.states[name] - low) / max(high - low, 1e-300), 0.0, 1.0)
    basis = _wavelets(x)
    share, weights = _fitted(error.answer(basis), error)
    made = error.beyond_nominal(basis @ weights)
    along, curve = _means_over(error.states[name], made, CURVE)
    state, left = _means_over(error.states[name], error.beyond_nominal(error.states["torque"]), CLOUD)
    unit = COORDINATES[name].replace("rad", "m") if linear else COORDINATES[name]
    return Law(
        coordinate=name, unit=unit, share=share, periods=0, amplitude=float(np.sqrt(2.0) * np.std(curve)),
        x=along, torque=curve, state=state, left=left,
    )  # fmt: skip


def _means_over(x: Array, y: Array, most: int) -> tuple[Array, Array]:
    """Means of x (n,) and y (n,) in at most so many parts of the samples, in the order of x; none holds few."""
    parts = np.array_split(np.argsort(x, kind="stable"), max(1, min(most, x.size // FEWEST)))
    return np.array([x[p].mean() for p in parts]), np.array([y[p].mean() for p in parts])


def _over_angle(error: _Error) -> Law:
    angle = error.states["angle"]
    within = np.mod(angle, 2.0 * np.pi)
    state, left = _means_over(within, error.beyond_nominal(error.states["torque"]), CLOUD)

    def pair_of(order: int) -> Array:
        return error.answer(np.stack([np.cos(order * angle), np.sin(order * angle)], axis=1))

    explained = []
    for pair in (pair_of(int(n)) for n in ORDERS):
        gram = pair.T @ pair + 1e-9 * np.trace(pair.T @ pair) * np.eye(2) + 1e-300 * np.eye(2)
        load = pair.T @ error.value
        explained.append(float(load @ np.linalg.solve(gram, load)))
    best = int(np.argmax(explained))
    order = int(ORDERS[best])
    share, weights = _fitted(pair_of(order), error)
    grid = np.linspace(0.0, 2.0 * np.pi, 400)
    curve = np.stack([np.cos(order * grid), np.sin(order * grid)], axis=1) @ weights
    return Law(
        coordinate="angle", unit="rad", share=share, periods=order, x=grid, torque=curve,
        amplitude=float(np.hypot(*weights)), state=state, left=left,
    )  # fmt: skip


def _wavelets(x: Array) -> Array:
    """Outputs (n, wavelets) of single wavelets over [0, 1]."""
    hat = Wavelet("mexican-hat")
    return np.stack([hat.value((x - m) / d) for m, d in dyadic_places(WAVELETS)], axis=1)


def _fitted(basis: Array, error: _Error) -> tuple[float, Array]:
    """Share explained by a fit to every other block, on the blocks between; weights of the fit to all."""
    value, nominal = error.value, error.answers
    blocks = (np.arange(value.size) * 20 // value.size) % 2 == 0
    left = energy = 0.0
    for part in (blocks, ~blocks):
        weights, (beta, gamma) = _orthogonal(basis[part], value[part], nominal[part])
        rest = value[~part] - nominal[~part] @ gamma
        made = (basis[~part] - nominal[~part] @ beta) @ weights
        left += float(np.sum((rest - made) ** 2))
        energy += float(np.sum(rest**2))
    return 1.0 - left / max(energy, 1e-300), _orthogonal(basis, value, nominal)[0]


def _orthogonal(basis: Array, value: Array, nominal: Array) -> tuple[Array, tuple[Array, Array]]:
    """Weights of the wavelets beside the nominal regressors (Frisch, Waugh), and what those take of both."""
    scale = np.maximum(np.linalg.norm(nominal, axis=0), 1e-300)
    gram = (nominal / scale).T @ (nominal / scale) + 1e-9 * np.eye(nominal.shape[1])
    both = np.linalg.solve(gram, (nominal / scale).T @ np.column_stack([basis, value])) / scale[:, None]
    beta, gamma = both[:, :-1], both[:, -1]
    own = basis - nominal @ beta
    normal = own.T @ own
    ridge = 1e-4 * np.trace(normal) / normal.shape[0] + 1e-300
    weights: Array = np.linalg.solve(normal + ridge * np.eye(normal.shape[0]), own.T @ (value - nominal @ gamma))
    return weights, (beta, gamma)
