"""Choices of Tables 11 to 16 (ours): levels of the friction, rule, fraction of the bound, size of w and cycles.

One seed. Tc and Ts are the levels of (3.99) [N m]; where none are named they are those of chapter 5. All 100 000
cycles of one choice take one to two minutes of a core, so only the choice that is taken has them, in the tables
themselves, and in Tables 13 to 16 one with larger first weights; the others have a hundredth and less of them, and the
nearest a tenth and a twentieth. Tables 13 and 14 are tried with the tightened bounds too: there the larger fractions
break down, with the printed ones they do not.
Morlet of Table 15 has a table of its own, ten seeds for each choice. With omega0 = 5 |c/d| max|phi'| soon reaches 1
from most starts, mostly in the first cycle; from there on the bounds have no meaning, the rates are zero, and the
error stays what it is: it grows with the first weights, and 50 cycles tell it. With omega0 = 1.75, which the text
does not give either, it learns like the others. First weights in [0, 1] are what the thesis calls usual (section 1).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import numpy as np

import rwn
from rwn.networks.rates import RateRule, Tightened
from rwn.studies.thesis import measured_friction as measured
from rwn.studies.thesis import structured_friction as structured
from rwn.studies.thesis.drive import FRICTION, Friction, chirp, friction_network, sine, speed_with_friction
from rwn.studies.thesis.experiment import Experiment, Outcome, Search, Settings
from rwn.studies.thesis.linear import thesis_rule
from rwn.studies.thesis.search import median, search

Values = list[float | None]
GOES_ON = "1 seed; the tables go on to 100 000 cycles with {}"
SIZES = (0.001, 0.1, 1.0)  # of the first weights

LEVELS = [
    Friction(coulomb=coulomb, static=static)
    for coulomb, static in ((0.044, 0.06), (0.044, 0.044), (0.02, 0.03), (0.02, 0.02), (0.01, 0.015), (0.01, 0.01))
]


def finite(value: float, status: str) -> float | None:
    """None for a run that diverged."""
    return None if status == "diverged" or not np.isfinite(value) else float(value)


def numbers_of(tables: tuple[str, str], sizes: Mapping[int, tuple[float, float]]) -> dict[str, float]:
    """The thesis's errors, trained of every size and then tested of every size."""
    return {f"{table} Nw {n}": pair[k] for k, table in enumerate(tables) for n, pair in sizes.items()}


def tables_11_12(settings: Settings) -> Search:
    """The recurrent network and its measured torque."""

    def values(fraction: float, size: float, cycles: int, friction: Friction = FRICTION) -> Values:
        speed, test = measured.recordings(friction)
        torque, wanted = measured.torque(speed, friction), measured.torque(test, friction)
        learning, tested = [], []
        for wavelets in measured.SIZES:
            start = measured.start(speed, wavelets, 0, friction=friction, size=size)
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
    cycles = settings.pick(3000, 2)
    tried |= {
        f"Tc {f.coulomb}, Ts {f.static}, fraction {measured.FRACTION}, w 0.001, {cycles} cycles": partial(
            values, measured.FRACTION, 0.001, cycles, f
        )
        for f in LEVELS
    }
    return search(
        "Tables 11 and 12: levels of the friction, fraction, size of w and cycles",
        numbers_of(("T11", "T12"), measured.SIZES),
        tried,
        taken="",
        count=GOES_ON.format("Tc 0.01, Ts 0.01, 0.1, w 0.001"),
        progress=lambda share: settings.progress(0.2 * share),
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
    grid = [(name, size, 500) for name in rules for size in SIZES]
    near = [(name, size, 5000) for name in ("thesis 0.1", "thesis 0.5") for size in SIZES]
    near += [("thesis 0.1", 1.0, 100_000)]
    tried = {
        f"{name}, w {size}, {settings.pick(cycles, 2)} cycles": partial(
            values, rules[name], size, settings.pick(cycles, 2)
        )
        for name, size, cycles in (*grid, *near)
    }
    return search(
        "Tables 13 and 14: rule, fraction, size of w and cycles",
        numbers_of(("T13", "T14"), structured.SIZES),
        tried,
        taken="",
        count=GOES_ON.format("thesis 0.1, w 0.1"),
        progress=lambda share: settings.progress(0.2 + 0.4 * share),
    )


def tables_15_16(settings: Settings) -> Search:
    """The structured network with every wavelet, omega0 of Morlet in two columns."""
    u, test_u = sine(1.0, 1.0), sine(0.75, 1.0)
    y, test = speed_with_friction(u), speed_with_friction(test_u)
    wavelets = {name: rwn.Wavelet(name) for name in structured.WAVELETS}
    wavelets |= {"morlet, omega0 1.75": rwn.Wavelet("morlet", 1.75)}
    thesis = {name: structured.WAVELETS[name.partition(",")[0]] for name in wavelets}

    def values(rule: RateRule, size: float, cycles: int) -> Values:
        learning, tested = [], []
        for name, wavelet in wavelets.items():
            start = friction_network(y, 15, seed=0, size=size, wavelet=wavelet)
            run = rwn.train_structured(start, u, y, learn=structured.NETWORK, rates=rule, cycles=cycles)
            learning.append(finite(run.mse_learning[-1], run.status))
            if thesis[name][1] is not None:
                tested.append(finite(run.network.mse(test_u, test), run.status))
        return learning + tested

    grid = [(f, size, 500) for f in (0.01, 0.1, 0.5, 0.9) for size in SIZES]
    near = [*((f, size, 5000) for f in (0.1, 0.5) for size in SIZES), (0.1, 1.0, 100_000)]
    tried = {
        f"thesis {f}, w {size}, {settings.pick(cycles, 2)} cycles": partial(
            values, thesis_rule(f), size, settings.pick(cycles, 2)
        )
        for f, size, cycles in (*grid, *near)
    }
    numbers = {f"T15 {name}": pair[0] for name, pair in thesis.items()}
    numbers |= {f"T16 {name}": pair[1] for name, pair in thesis.items() if pair[1] is not None}
    return search(
        "Tables 15 and 16: fraction, size of w, omega0 of Morlet and cycles",
        numbers,
        tried,
        taken="",
        count=GOES_ON.format("thesis 0.1, w 0.1"),
        progress=lambda share: settings.progress(0.6 + 0.38 * share),
    )


def morlet(settings: Settings) -> Search:
    """Morlet of Table 15 under first weights and fractions, omega0 in two columns."""
    u = sine(1.0, 1.0)
    y = speed_with_friction(u)
    cycles, seeds = settings.pick(50, 2), settings.pick(10, 1)

    def error(omega0: float, size: float, positive: bool, fraction: float, seed: int) -> float:
        start = friction_network(y, 15, seed=seed, size=size, wavelet=rwn.Wavelet("morlet", omega0))
        start = replace(start, w=np.abs(start.w)) if positive else start
        run = rwn.train_structured(
            start, u, y, learn=structured.NETWORK, rates=thesis_rule(fraction), cycles=cycles
        )
        return np.inf if run.status == "diverged" else float(run.mse_learning[-1])

    def values(size: float, positive: bool, fraction: float) -> Values:
        return [
            median([error(omega0, size, positive, fraction, seed) for seed in range(seeds)]) for omega0 in (5.0, 1.75)
        ]

    starts = {f"w in +-{size}": (size, False) for size in (0.001, 0.1, 0.3, 0.5, 1.0)}
    starts |= {"w in [0, 0.1]": (0.1, True), "w in [0, 1]": (1.0, True)}
    tried = {
        f"{name}, fraction {f}": partial(values, *start, f) for name, start in starts.items() for f in (0.1, 0.5, 0.9)
    }
    thesis = structured.WAVELETS["morlet"][0]
    return search(
        "Table 15, Morlet: first weights, fraction and omega0",
        {"omega0 5": thesis, "omega0 1.75": thesis},
        tried,
        taken="w in +-0.1, fraction 0.1",
        count=f"{cycles} cycles, {seeds} seeds",
        progress=lambda share: settings.progress(0.98 + 0.02 * share),
    )


def run(settings: Settings) -> Outcome:
    """All four."""
    kinds = (tables_11_12, tables_13_14, tables_15_16, morlet)
    return Outcome(rows=[], searches=[kind(settings) for kind in kinds])


EXPERIMENT = Experiment(name="search-friction", title="Choices of Tables 11 to 16", run=run, minutes=7.0)
