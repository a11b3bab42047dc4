"""Several starts (seeds) of a training that takes all of the thesis's cycles."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeVar

from rwn.networks.online_training import OnlineTraining
from rwn.networks.recurrent_network import RecurrentNetwork
from rwn.networks.structured_network import StructuredNetwork
from rwn.studies.thesis.experiment import Settings

Network = TypeVar("Network", RecurrentNetwork, StructuredNetwork)


def from_starts(
    train: Callable[[int], OnlineTraining[Network]], settings: Settings, begin: float, end: float
) -> list[OnlineTraining[Network]]:
    """`train(seed)` for the seeds of the settings, 0 and up; reports progress from share `begin` to `end`.

    The rates and parameters by cycle, which figures show of the first, are let go of the others: 10 MB each.
    """
    trained = []
    for seed in range(settings.seeds):
        one = train(seed)
        if seed > 0:
            one = replace(one, rates=one.rates[-1:].copy(), linear=one.linear[-1:].copy())
        trained.append(one)
        settings.progress(begin + (end - begin) * (seed + 1) / settings.seeds)
    return trained


def in_words(runs: Sequence[OnlineTraining[Network]]) -> str:
    """`100000 cycles, 20 seeds, 1 of them diverged`."""
    cycles, diverged = max(len(r.mse_learning) for r in runs), sum(r.status == "diverged" for r in runs)
    words = f"{cycles} cycles, {len(runs)} seed{'s' * (len(runs) > 1)}"
    return f"{words}, {diverged} of them diverged" if diverged and len(runs) > 1 else words
