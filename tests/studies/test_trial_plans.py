"""What the trials of a seed are about."""

from __future__ import annotations

from rwn.studies.trials.conceal import SINGLE
from rwn.studies.trials.effects import EFFECTS, NAMED, UNNAMED
from rwn.studies.trials.plan import SHARES, plans, redealt


def test_rivals_are_effects() -> None:
    assert {rival for effect in EFFECTS.values() for rival in effect.rivals} <= set(EFFECTS)


def test_there_are_unnamed_kinds_enough() -> None:
    assert len(UNNAMED) >= 6
    assert not set(UNNAMED) & set(NAMED)


def test_plans_cover_modes_and_effects_evenly() -> None:
    planned = plans(5, 300)
    for mode, share in SHARES.items():
        assert abs(sum(p.mode == mode for p in planned) - 300 * share) <= 1
    counts = [sum(p.effects == (name,) for p in planned if p.mode in SINGLE) for name in NAMED]
    assert max(counts) - min(counts) <= 1
    assert planned == plans(5, 300)
    assert planned != plans(6, 300)


def test_effects_that_no_bench_shows_are_dealt_again() -> None:
    for plan in plans(5, 60):
        other = redealt(plan, 12)
        assert other == redealt(plan, 12)
        assert (other.mode, other.visibility, other.name) == (plan.mode, plan.visibility, plan.name)
        assert len(other.effects) == len(plan.effects)
        assert (other.effects != plan.effects) == bool(plan.effects)
