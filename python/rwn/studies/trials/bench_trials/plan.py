"""What the bench trials of one seed are about, spread evenly over the count."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from rwn.studies.trials.effects import BACKGROUND, EFFECTS, NAMED
from rwn.studies.trials.judges import JUDGES
from rwn.studies.trials.plan import SPLITS, Deck, compatible, split_of, spread

Rng = np.random.Generator

NAMED_ALONE, NAMED_ABOVE, BACKGROUND_ALONE, NOTHING = "named", "named-above-background", "background", "nothing"
MODES = {NAMED_ALONE: 0.375, NAMED_ABOVE: 0.375, BACKGROUND_ALONE: 0.125, NOTHING: 0.125}
NUMBERS = {"1": 0.45, "2": 0.35, "3": 0.2}  # of named effects
JUDGED_BY = {"plant": 2 / 3, "mujoco": 1 / 3}
NOMINALS = {"offset": 0.6, "masked": 0.2, "plain": 0.2}  # how the model file came about
HELDOUT = {"given": 0.5, "kept": 0.5}  # whether the diagnosis gets the held-out recordings
VISIBILITIES = (4.0, 10.0, 30.0)
BENEATH, ALONE = (2.0, 4.0), (4.0, 10.0)  # visibility of a background
STREAM = 11  # apart from the trials of the same seed without a bench

# What development seeds never see: no constant and no calibration can have learned it.
TEST_ONLY = frozenset(
    {"iron-hysteresis", "friction-wave", "torque-constant-warming", "load-spring", "sensor-eccentricity"}
)
# A second resonance is one only where there is a first; alone it is a shaft with a small load.
NEEDS = {"second-resonance": frozenset({"shaft-compliance", "backlash"})}
# A drive that reports what it applies would report what these do to the voltage as well.
ACTUATORS = frozenset(name for name, effect in (EFFECTS | BACKGROUND).items() if effect.equation == "actuator")


@dataclass(frozen=True, kw_only=True)
class BenchPlan:
    """`effects` with the visibility of each alone; `background` without a name, "" where there is none."""

    seed: int
    index: int
    mode: str
    effects: tuple[str, ...] = ()
    visibilities: tuple[float, ...] = ()
    background: str = ""
    background_visibility: float = 1.0
    nominal: str = "plain"
    judge: str = "plant"
    heldout_given: bool = False

    @property
    def name(self) -> str:
        return f"trial_{self.index + 1:04d}"

    @property
    def most(self) -> float:
        """The visibility of the clearest thing that acts."""
        return max((*self.visibilities, self.background_visibility))


def backgrounds(seed: int) -> tuple[str, ...]:
    """The kinds that trials of this seed may hold."""
    test = split_of(seed) == "test"
    return tuple(name for name in BACKGROUND if test or name not in TEST_ONLY)


def plans(seed: int, count: int, *, judge: str | None = None) -> list[BenchPlan]:
    """The bench trials of `seed`; `judge` holds the truth of all of them where it is given."""
    rng = np.random.default_rng([SPLITS.index(split_of(seed)), seed, STREAM])
    modes = spread(rng, MODES, count)
    named = sum(mode in (NAMED_ALONE, NAMED_ABOVE) for mode in modes)
    numbers = iter(spread(rng, NUMBERS, named))
    judges = spread(rng, JUDGED_BY if judge is None else {judge: 1.0}, count)
    nominals = spread(rng, NOMINALS, count)
    heldout = spread(rng, HELDOUT, count)
    casting = {name: _Casting(rng, name, seed) for name in JUDGED_BY}
    out = []
    for index, mode in enumerate(modes):
        size = int(next(numbers)) if mode in (NAMED_ALONE, NAMED_ABOVE) else 0
        plan = BenchPlan(
            seed=seed, index=index, mode=mode, nominal=nominals[index], judge=judges[index],
            heldout_given=heldout[index] == "given",
        )  # fmt: skip
        out.append(casting[plan.judge].cast(plan, size))
    return out


def redealt(plan: BenchPlan, turn: int) -> BenchPlan:
    """The same trial with others of its kind: for those that no bench shows as planned."""
    rng = np.random.default_rng([SPLITS.index(split_of(plan.seed)), plan.seed, STREAM, plan.index, turn])
    return _Casting(rng, plan.judge, plan.seed).cast(plan, len(plan.effects))


class _Casting:
    """Deals effects and backgrounds that a judge knows, every one as often as any other."""

    def __init__(self, rng: Rng, judge: str, seed: int) -> None:
        knows = JUDGES[judge].knows
        self._rng = rng
        self._named = [name for name in NAMED if knows(name)]
        self._unnamed = [name for name in backgrounds(seed) if knows(name)]
        self._first, self._beneath = Deck(rng, len(self._named)), Deck(rng, len(self._unnamed))
        self._levels = Deck(rng, len(VISIBILITIES))

    def cast(self, plan: BenchPlan, size: int) -> BenchPlan:
        covered = plan.mode in (NAMED_ABOVE, BACKGROUND_ALONE)
        effects = self._company(size, covered=covered)
        levels = tuple(VISIBILITIES[self._levels.deal()] for _ in effects)
        plan = replace(plan, effects=effects, visibilities=levels, background="", background_visibility=1.0)
        if not covered:
            return plan
        low, high = BENEATH if plan.mode == NAMED_ABOVE else ALONE
        visibility = float(np.exp(self._rng.uniform(np.log(low), np.log(high))))
        return replace(plan, background=self._background(effects), background_visibility=visibility)

    def _company(self, size: int, *, covered: bool) -> tuple[str, ...]:
        """So many effects that may act together, and above some background if they have to."""
        while size:
            first = self._named[self._first.deal()]
            others = [name for name in self._named if name != first]
            choices = [(first, *rest) for rest in combinations(others, size - 1) if together((first, *rest))]
            if covered:
                choices = [effects for effects in choices if self._fitting(effects)]
            if choices:
                return choices[int(self._rng.integers(len(choices)))]
        return ()

    def _fitting(self, effects: tuple[str, ...]) -> set[str]:
        return {name for name in self._unnamed if beneath(name, effects)}

    def _background(self, effects: tuple[str, ...]) -> str:
        fitting = self._fitting(effects)
        while True:
            name = self._unnamed[self._beneath.deal()]
            if name in fitting:
                return name


def together(names: Iterable[str]) -> bool:
    """Whether these named effects may act at once."""
    return all(compatible(EFFECTS[a], EFFECTS[b]) for a, b in combinations(names, 2))


def beneath(name: str, effects: tuple[str, ...]) -> bool:
    """Whether this background may lie beneath these effects."""
    if name in NEEDS:
        return bool(NEEDS[name] & set(effects))
    if name == "supply-sag" and ACTUATORS & set(effects):
        return False
    return all(compatible(BACKGROUND[name], EFFECTS[effect]) for effect in effects)
