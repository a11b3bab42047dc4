"""What the thesis leaves open of the offline experiments, for the searches: reading of (2.20), patterns and start."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from rwn.networks.arrays import Array
from rwn.networks.initialisation import DyadicGrid, Heuristic, LeastSquares, LinearStart, SmallRandom
from rwn.studies.thesis.functions import grid, miso, siso
from rwn.studies.thesis.offline import MATLAB, PRINTED, SQUARED, Task

WAYS: dict[str, type[DyadicGrid] | type[Heuristic]] = {"dyadic grid": DyadicGrid, "heuristic": Heuristic}
READINGS = {"mu (1 - gamma)": MATLAB, "mu": PRINTED}
TWICE = {"2 mu, the gradient of (2.21)": SQUARED}


def one_input(points: int, start: LinearStart) -> Task:
    """(2.25) at so many points."""
    x = np.linspace(-10, 10, points)[:, None]
    return Task(x, siso(x), x, siso(x), start)


def two_inputs(low: float, points: int, size: float, function: Callable[[Array], Array] = miso) -> Task:
    """(2.26) on a square of side 1."""
    x = grid(low, low + 1, points)
    y = function(x)[:, None]
    return Task(x, y, x, y, SmallRandom(scale=size))


ONE_INPUT: dict[str, Task] = {
    "201 points, b, a least squares, w 0.1": one_input(201, LeastSquares(scale=0.1)),
    "201 points, b, a least squares, w 1": one_input(201, LeastSquares(scale=1.0)),
    "201 points, all random 0.1": one_input(201, SmallRandom(scale=0.1)),
    "51 points, b, a least squares, w 0.1": one_input(51, LeastSquares(scale=0.1)),
}
ONE_INPUT_TAKEN = "mu (1 - gamma), 201 points, b, a least squares, w 0.1, dyadic grid"  # by the experiments
TWO_INPUTS: dict[str, Task] = {
    "[0, 1]^2, 21 x 21, w 0.1": two_inputs(0.0, 21, 0.1),
    "[0, 1]^2, 21 x 21, w 0.3": two_inputs(0.0, 21, 0.3),
    "[0, 1]^2, 21 x 21, w 1": two_inputs(0.0, 21, 1.0),
    "[0, 1]^2, 11 x 11, w 0.1": two_inputs(0.0, 11, 0.1),
    "[-0.5, 0.5]^2, 11 x 11, w 0.1": two_inputs(-0.5, 11, 0.1),
}


def one_input_choices(
    values: Callable[[str, Task, str], list[float | None]],
) -> dict[str, Callable[[], list[float | None]]]:
    """What is tried of an experiment with one input; `values`: its numbers by way to start, patterns and reading."""
    return {
        f"{reading}, {name}, {way}": partial(values, way, task, value)
        for way in WAYS
        for reading, value in READINGS.items()
        for name, task in ONE_INPUT.items()
    }
