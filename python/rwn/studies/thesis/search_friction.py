"""Choices of Tables 11 to 16 (ours): fraction of the bound, size of w, friction's levels and cycles.

A tenth and a hundredth of the thesis's 100 000 cycles, one seed. Tables 13 and 14 are tried with the tightened
bounds too: there the larger fractions break down, with the printed ones they do not.
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

    tried = {
        f"fraction {fraction}, w {size}, {cycles} cycles": partial(values, fraction, size, settings.pick(cycles, 2))
        for size in (0.001, 0.1)
        for fraction in (0.002, 0.03, 0.1, 0.25, 0.5)
        for cycles in ((1000, 5000) if size == 0.001 and fraction in (0.03, 0.1, 0.25) else (1000,))
    }
    numbers = {f"T11 Nw {n}": ours for n, (ours, _) in measured.SIZES.items()}
    numbers |= {f"T12 Nw {n}": ours for n, (_, ours) in measured.SIZES.items()}
    title = "Tables 11 and 12: fraction, size of w and cycles (the experiment goes on to 100 000 with 0.1 and 0.001)"
    return search(title, numbers, tried, taken="", progress=lambda share: settings.progress(0.5 * share))


def tables_13_14(settings: Settings) -> Search:
    """The structured network."""
    u, test_u = sine(1.0, 1.0), chirp(0.75, 0.1, 4.0)
    y, test = speed_with_friction(u), speed_with_friction(test_u)

    def values(rule: RateRule, size: float) -> Values:
        learning, tested = [], []
        for wavelets in structured.SIZES:
            start = friction_network(y, wavelets, seed=0, size=size)
            cycles = settings.pick(500, 2)
            run = rwn.train_structured(start, u, y, learn=structured.NETWORK, rates=rule, cycles=cycles)
            learning.append(finite(run.mse_learning[-1], run.status))
            tested.append(finite(run.network.mse(test_u, test), run.status))
        return learning + tested

    rules: dict[str, RateRule] = {f"thesis {f}": thesis_rule(f) for f in (0.01, 0.1, 0.5, 0.9)}
    rules |= {f"tightened {f}": Tightened(fraction=f, shared=False) for f in (0.1, 0.5, 0.9)}
    tried = {
        f"{name}, w {size}": partial(values, rule, size) for name, rule in rules.items() for size in (0.001, 0.1)
    }
    numbers = {f"T13 Nw {n}": ours for n, (ours, _) in structured.SIZES.items()}
    numbers |= {f"T14 Nw {n}": ours for n, (_, ours) in structured.SIZES.items()}
    title = "Tables 13 and 14: rule, fraction and size of w, 500 cycles (the experiment goes on to 100 000)"
    return search(
        title, numbers, tried, taken="thesis 0.1, w 0.1", progress=lambda share: settings.progress(0.5 + 0.5 * share)
    )


def run(settings: Settings) -> Outcome:
    """Both."""
    return Outcome(rows=[], searches=[tables_11_12(settings), tables_13_14(settings)])


EXPERIMENT = Experiment(name="search-friction", title="Choices of Tables 11 to 14", run=run, minutes=2.5)
