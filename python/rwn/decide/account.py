"""The account of a mismatch: which effects act, each with its probability and share, and what remains.

Whether an effect acts and whether that is all are two questions: what remains takes no name away.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rwn.decide.calibration import ACTS, calibration
from rwn.decide.elaboration import elaborated
from rwn.decide.evidence import CrossValidation, Evidence
from rwn.decide.witness import contradicted
from rwn.fit.fit import Fit
from rwn.fit.residuals import LEVEL, misfit, structured, variance
from rwn.model.model import Model
from rwn.name.backward import family
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.parallel import side_by_side
from rwn.simulate.run import Run

RIVAL = 0.05  # evidence against that of the leading explanation, from which a name is among those not told apart
SURE = 0.99  # more is not told by a calibration on some hundred trials
LARGEST_SET = 3  # names that are still an answer


@dataclass(frozen=True, kw_only=True)
class ActingEffect:
    """An effect of the leading explanation."""

    name: str
    probability: float  # that it acts
    together: float  # that it or one of its rivals acts
    share: float  # of the removable squared error, that goes with it and not without it
    evidence: Evidence
    rivals: tuple[str, ...] = ()  # that may act in its place
    against: str = ""  # the half of the drive that contradicts it by itself: "shaft", "winding" (witness.py)

    @property
    def stated(self) -> bool:
        """Whether it or a rival acts more likely than not."""
        return self.together > ACTS

    def undetermined(self) -> ActingEffect:
        """The effect as one that need not act: with an even chance at most."""
        share = min(ACTS / self.together, 1.0)
        return replace(self, probability=self.probability * share, together=self.together * share)

    def contradicted_by(self, half: str) -> ActingEffect:
        """The effect with the probability that is left (Bayes) when a half of the drive contradicts it.

        An effect that acts is contradicted by chance alone, with the probability LEVEL.
        """
        before = min(self.together, SURE)
        left = before / self.together * LEVEL / (1.0 - before * (1.0 - LEVEL))  # Bayes; what does not act does meet it
        return replace(self, probability=self.probability * left, together=self.together * left, against=half)


@dataclass(frozen=True, kw_only=True)
class Remainder:
    """What an explanation leaves."""

    share: float = 0.0  # of the removable squared error
    error: float = 1.0  # mean squared error, in units of the noise
    signals: tuple[str, ...] = ()  # in which it has structure: white noise has it in one of 100 such tests

    @property
    def misfit(self) -> float:
        """Share of that error that is no noise."""
        return misfit(self.error, self.signals)


@dataclass(frozen=True, kw_only=True)
class Account:
    """Every effect of the leading explanation, the one that removes most first."""

    effects: tuple[ActingEffect, ...]
    leading: RankedFit
    birge: float = 1.0  # how much wider than its own the intervals of the leading explanation are

    @property
    def stated(self) -> tuple[ActingEffect, ...]:
        """The effects that are stated."""
        return tuple(e for e in self.effects if e.stated)

    def undetermined(self, name: str) -> Account:
        """The account with one effect that need not act."""
        return replace(self, effects=tuple(e.undetermined() if e.name == name else e for e in self.effects))

    def without(self, names: Collection[str]) -> Account:
        """The account of the others."""
        return replace(self, effects=tuple(e for e in self.effects if e.name not in names))


def account(ranking: Ranking, heldout: Sequence[Run], model: Model) -> Account:
    """The account of the best explanation that has effects at all; without effects where none was found."""
    best = next((r for r in ranking.fits if r.added), ranking.nothing_missing)
    found = elaborated(ranking, best, lambda this: CrossValidation(ranking, this, heldout, model))
    leading, validation = found.leading, found.validation
    rivals = {name: _rivals(ranking, leading, name, found.odds) for name in leading.added}
    instead = {name: {*rivals[name], *family(name)} - {name} for name in leading.added}
    evidence = side_by_side(lambda name: validation.evidence(name, instead[name]), leading.added)
    rows = [_acting(name, e, rivals[name]) for name, e in zip(leading.added, evidence, strict=True)]
    against = contradicted(leading.final, ranking.problem, model)
    rows = [row.contradicted_by(against[row.name]) if row.name in against else row for row in rows]
    return Account(effects=tuple(sorted(rows, key=lambda row: -row.share)), leading=leading, birge=validation.birge)


def _acting(name: str, found: Evidence, rivals: Mapping[str, float]) -> ActingEffect:
    """`rivals` share the probability by the evidence for each against this one."""
    together = calibration().probability(found)
    return ActingEffect(
        name=name,
        probability=together / (1.0 + sum(rivals.values())),
        together=together,
        share=float(np.clip(found.share, 0.0, 1.0)),
        evidence=found,
        rivals=tuple(rivals),
    )


def _rivals(
    ranking: Ranking, leading: RankedFit, name: str, known: Mapping[tuple[str, str], float]
) -> dict[str, float]:
    """The names that explain nearly as much in the place of this one, with the evidence for each against it.

    `known`: what is known already of a rival against a name.
    """
    others = set(leading.added) - {name}
    alike = [r for r in ranking.fits if len(r.added) == len(leading.added) and others < set(r.added)]
    found = {}
    for r in alike:
        (rival,) = set(r.added) - others
        if rival != name:
            found[rival] = known.get((name, rival), float(np.exp(r.score - leading.score)))
    near = sorted(((rival, odds) for rival, odds in found.items() if odds > RIVAL), key=lambda row: -row[1])
    return dict(near[: LARGEST_SET - 1])


def remainder(ranking: Ranking, this: Fit) -> Remainder:
    """What a fit leaves of the recordings that it was fitted to."""
    problem = ranking.weighted
    left, nothing = variance(problem, this), variance(problem, ranking.nothing_missing.final)
    share = (left - 1.0) / (nothing - 1.0) if left > 1.0 and nothing > left else float(left > 1.0)
    return Remainder(share=share, error=left, signals=structured(problem, this))
