"""Choices of Tables 11 to 14 (ours): rule, fraction of the bound, size of w and cycles.

One seed. All 100 000 cycles of one choice take 5 and 10 minutes of a core, so only the choice that is taken has them,
in the tables themselves; here every choice has a hundredth and less of them, and the nearest have a tenth and a
twentieth. Tables 13 and 14 are tried with the tightened bounds too: there the larger fractions break down, with the
printed ones they do not.
"""

from __future__ import annotations

from functools import partial

import numpy as np

import rwn
from rwn.networks.rates import RateRule, Tightened
from rwn.studies.thesis import measured_friction as measured
from rwn.studies.thesis import structured_friction as structured
from rwn.studies.thesis.drive import chirp, friction_network, sine, speed_with_friction
from rwn.studies.thesis.experiment import Experiment, Outcome, Search, Settings
from rwn.studies.thesis.linear import thesis_rule
from rwn.studies.thesis.search import search

Values = list[float | None]
GOES_ON = "1 seed; the tables go on to 100 000 cycles with {}"


def finite(value: float, status: str) -> float | None:
    """None for a run that diverged."""
    return None if status == "diverged" or not np.isfinite(value) else float(value)


def larger(net: rwn.RecurrentNetwork, times: float) -> rwn.RecurrentNetwork:
    """The same with larger w."""
    return rwn.RecurrentNetwork(b=net.b, a=net.a, w=times * net.w, m=net.m, d=net.d, c=net.c)


def tables_11_12(settings: Settings) -> Search:
    """The recurrent network and its measured torque."""
    speed, test = (speed_with_friction(u) for u in (sine(1.0, 1.0), chirp(0.75, 0.1, 4.0)))
    torque, wanted = measured.torque(speed), measured.torque(test)

    def values(fraction: float, size: float, cycles: int) -> Values:
        learning, tested = [], []
        for wavelets in measured.SIZES:
            start = larger(measured.start(speed, wavelets, 0), size / 1e-3)
            run = rwn.train_recurrent(start, speed, torque, rates=thesis_rule(fraction), cycles=cycles)
            learning.append(finite(run.mse_learning[-1], run.status))
            tested.append(finite(run.network.mse(test, wanted), run.status))
        return learning + tested

    grid = [(f, size, 1000) for size in (0.001, 0.1) for f in (0.002, 0.03, 0.1, 0.25, 0.5)]
    near = [(f, 0.001, 10_000) for f in (0.03, measured.FRACTION, 0.25)]
    tried = {
        f"fraction {f}, w {size}, {settings.pick(cycles, 2)} cycles": partial(values, f, size, settings.pick(cycles, 2))
        for f, size, cycles in (*grid, *near)
    }
    numbers = {f"T11 Nw {n}": ours for n, (ours, _) in measured.SIZES.items()}
    numbers |= {f"T12 Nw {n}": ours for n, (_, ours) in measured.SIZES.items()}
    return search(
        "Tables 11 and 12: fraction, size of w and cycles",
        numbers,
        tried,
        taken="",
        count=GOES_ON.format("0.1, w 0.001"),
        progress=lambda share: settings.progress(0.5 * share),
    )


def tables_13_14(settings: Settings) -> Search:
    """The structured network."""
    u, test_u = sine(1.0, 1.0), chirp(0.75, 0.1, 4.0)
    y, test = speed_with_friction(u), speed_with_friction(test_u)

    def values(rule: RateRule, size: float, cycles: int) -> Values:
        learning, tested = [], []
        for wavelets in structured.SIZES:
            start = friction_network(y, wavelets, seed=0, size=size)
            run = rwn.train_structured(start, u, y, learn=structured.NETWORK, rates=rule, cycles=cycles)
            learning.append(finite(run.mse_learning[-1], run.status))
            tested.append(finite(run.network.mse(test_u, test), run.status))
        return learning + tested

    rules: dict[str, RateRule] = {f"thesis {f}": thesis_rule(f) for f in (0.01, 0.1, 0.5, 0.9)}
    rules |= {f"tightened {f}": Tightened(fraction=f, shared=False) for f in (0.1, 0.5, 0.9)}
    grid = [(name, size, 500) for name in rules for size in (0.001, 0.1)]
    near = [(name, size, 5000) for name in ("thesis 0.1", "thesis 0.5") for size in (0.001, 0.1)]
    tried = {
        f"{name}, w {size}, {settings.pick(cycles, 2)} cycles": partial(
            values, rules[name], size, settings.pick(cycles, 2)
        )
        for name, size, cycles in (*grid, *near)
    }
    numbers = {f"T13 Nw {n}": ours for n, (ours, _) in structured.SIZES.items()}
    numbers |= {f"T14 Nw {n}": ours for n, (_, ours) in structured.SIZES.items()}
    return search(
        "Tables 13 and 14: rule, fraction, size of w and cycles",
        numbers,
        tried,
        taken="",
        count=GOES_ON.format("thesis 0.1, w 0.1"),
        progress=lambda share: settings.progress(0.5 + 0.5 * share),
    )


def run(settings: Settings) -> Outcome:
    """Both."""
    return Outcome(rows=[], searches=[tables_11_12(settings), tables_13_14(settings)])


EXPERIMENT = Experiment(name="search-friction", title="Choices of Tables 11 to 14", run=run, minutes=4.5)
