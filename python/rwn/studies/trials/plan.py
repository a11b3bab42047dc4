"""What the trials of one seed are about: mode, effects and visibility, spread evenly over the count.

Seeds below `FIRST_TEST_SEED` are for development, the others for tests: nobody tunes on a test by accident.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from rwn.studies.trials.effects import EFFECTS, NAMED, UNNAMED, Effect

FIRST_TEST_SEED = 10_000
SPLITS = ("development", "test")
VISIBILITIES = (2.0, 4.0, 10.0, 30.0)
SHARES = {"plain": 0.22, "masked": 0.18, "offset": 0.26, "double": 0.12, "novel": 0.11, "null": 0.11}


def split_of(seed: int) -> str:
    return "test" if seed >= FIRST_TEST_SEED else "development"


@dataclass(frozen=True)
class Plan:
    seed: int
    index: int
    mode: str
    effects: tuple[str, ...]
    visibility: float

    @property
    def name(self) -> str:
        return f"trial_{self.index + 1:04d}"


def compatible(a: Effect, b: Effect) -> bool:
    """Two effects that may act together and can in principle be distinguished."""
    friction = {"presliding-hysteresis"}
    both_dry = all(e.replaces_coulomb or e.name in friction for e in (a, b))
    rivals = b.name in a.rivals or a.name in b.rivals
    strengths = a.scale is not None and b.scale is not None
    return strengths and not rivals and not both_dry and not (a.two_mass and b.two_mass)


def spread(rng: np.random.Generator, shares: Mapping[str, float], count: int) -> list[str]:
    """Each name its share of `count`, the largest remainders rounded up, in random order."""
    exact = {name: share * count for name, share in shares.items()}
    whole = {name: int(value) for name, value in exact.items()}
    rest = sorted(exact, key=lambda name: whole[name] - exact[name])[: count - sum(whole.values())]
    names = [name for name in shares for _ in range(whole[name] + (name in rest))]
    return [str(name) for name in rng.permutation(names)]


class Deck:
    """Deals a shuffled set again and again."""

    def __init__(self, rng: np.random.Generator, size: int) -> None:
        self._rng, self._size = rng, size
        self._left: list[int] = []

    def deal(self) -> int:
        if not self._left:
            self._left = [int(k) for k in self._rng.permutation(self._size)]
        return self._left.pop()


def redealt(plan: Plan, turn: int) -> Plan:
    """The same trial with other effects of its kind: for those that no bench shows as planned."""
    rng = np.random.default_rng([SPLITS.index(split_of(plan.seed)), plan.seed, plan.index, turn, 1])
    singles: list[tuple[str, ...]] = [(name,) for name in (UNNAMED if plan.mode == "novel" else NAMED)]
    choices = {0: [], 1: singles, 2: _pairs()}[len(plan.effects)]
    among = [effects for effects in choices if effects != plan.effects]
    return replace(plan, effects=among[int(rng.integers(len(among)))]) if among else plan


def _pairs() -> list[tuple[str, ...]]:
    return [(a, b) for a, b in combinations(NAMED, 2) if compatible(EFFECTS[a], EFFECTS[b])]


def plans(seed: int, count: int) -> list[Plan]:
    """The trials of `seed`; the first ones do not depend on how many follow only in kind, not in order."""
    rng = np.random.default_rng([SPLITS.index(split_of(seed)), seed])
    pairs = _pairs()
    named, unnamed, paired = Deck(rng, len(NAMED)), Deck(rng, len(UNNAMED)), Deck(rng, len(pairs))
    levels = {mode: Deck(rng, len(VISIBILITIES)) for mode in SHARES}
    out = []
    for index, mode in enumerate(spread(rng, SHARES, count)):
        level = VISIBILITIES[levels[mode].deal()]
        effects: tuple[str, ...] = ()
        if mode == "double":
            effects = pairs[paired.deal()]
        elif mode == "novel":
            effects = (UNNAMED[unnamed.deal()],)
        elif mode != "null":
            effects = (NAMED[named.deal()],)
        # Below 4 an unnamed effect or one of two is not distinguishable from its nearest names.
        weakest = 4.0 if mode in ("double", "novel") else 2.0
        out.append(Plan(seed, index, mode, effects, 1.0 if mode == "null" else max(level, weakest)))
    return out
