"""Learning rates sample by sample over the first training cycle, as the thesis draws them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

import rwn
from rwn.networks.arrays import Array
from rwn.studies.thesis.drive import T
from rwn.studies.thesis.experiment import Figure, Panel, curve

SHAPES = {"m = mu c": 3, "d": 4}  # groups of the recurrent network whose rates the thesis draws
Training = Callable[[int], Array]  # rates (1, groups) of one cycle that stops after n samples


def first_cycle_panel(train: Training, samples: int, groups: dict[str, int], title: str = "") -> Panel:
    """Rates of some groups (label, index) over the first cycle. The rates after n samples are those at the end
    of a cycle that stops there, so the cycle is begun once for every point of the curve."""
    ends = np.unique(np.geomspace(20, samples, 60).astype(int))
    rates = np.vstack([train(int(n)) for n in ends])
    name = "first cycle" if not title else f"{title}, first cycle"
    return Panel(
        xlabel="time [s]",
        ylabel="rate",
        title=name,
        curves=[curve(rates[:, k], T * ends, label=f"mu {label}") for label, k in groups.items()],
        log_y=True,
    )


def rates_figure(
    number: int, title: str, run: rwn.OnlineTraining[rwn.RecurrentNetwork], first: Panel
) -> Figure:
    """Rates of translation and dilation in the first cycle, and at the end of every one."""
    lines = [curve(run.rates[:, k], label=f"mu {label}") for label, k in SHAPES.items()]
    cycles = Panel(xlabel="cycle", ylabel="rate", title="end of each cycle", curves=lines, log_y=True)
    return Figure(number=number, title=title, panels=[first, cycles])
