"""The main job: refit, locate, name, model, show."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rwn import curves, evidence
from rwn._core import __version__
from rwn.correct import corrected_model, found_effects, nominal_fit
from rwn.diagnosis import Alternative, Diagnosis, HeldoutRow, Location, Verdict
from rwn.effects import table
from rwn.evidence import Hypothesis, Statistics
from rwn.experiments import separated_by
from rwn.heldout import Contender, heldout_rows
from rwn.locate import Unknown, regions, unknown_inputs
from rwn.model import Model
from rwn.output_error import Target
from rwn.prepare import Setup, noise_levels, prepare, proof_target
from rwn.recording import Recording
from rwn.refuse import PROVED, removed_certainly, without_what_hurts
from rwn.search import Fitted, Search
from rwn.temper import tempered

Array = NDArray[np.float64]
Progress = Callable[[str, float], None]

REMOVED = 0.85  # share of the removable squared error that a name has to remove
PARTLY = 0.75  # the same where held-out recordings prove it: real machines have small effects beside the large one
MATERIAL = 0.015  # smallest relative gain in squared error that is called physics
WORTH = 0.2  # share of what is left that another effect has to remove
MOST_EFFECTS = 3


@dataclass(frozen=True, kw_only=True)
class Explanation:
    """What the search came to: every hypothesis with its probability, best first."""

    setup: Setup
    nominal: Fitted
    hypotheses: tuple[Hypothesis, ...]
    left: Statistics  # residual of the best
    before: Statistics  # residual of the refitted nominal


def diagnose(
    recordings: Sequence[Recording],
    model: Model,
    *,
    heldout: Sequence[Recording] = (),
    seed: int = 0,
    jobs: int | None = None,
    progress: Progress | None = None,
) -> Diagnosis:
    """What physics the model leaves out of these recordings, proved on recordings that were not fitted.

    Args:
        recordings: runs to judge the model from, SI, time first.
        model: the nominal model with its declared uncertainty.
        heldout: runs used for proof alone; without them nothing is proved, and a warning says so.
        seed: of the block bootstrap; the result depends on input and seed alone.
        jobs: threads (default: all processors); the result does not depend on it.
        progress: called with what is being done and how far it is, 0 to 1.

    Returns:
        The verdict, located region, named effects with intervals, corrected model and the curves that show it.
    """
    began = time.perf_counter()
    say = progress or _silent
    say("refitting the nominal model", 0.0)
    setup = prepare(recordings, model)
    found = explain(setup, jobs=jobs or os.cpu_count() or 1, progress=say)
    say("proving it on held-out data", 0.85)
    proof = [proof_target(r, model) for r in heldout]
    chosen = _choose(found)
    if proof:
        chosen = without_what_hurts(
            found.hypotheses, chosen, lambda h: _prove(found, h, proof, model, seed)
        )
    rows = _prove(found, chosen, proof, model, seed)
    verdict = verdict_of(found, chosen, proved=removed_certainly(rows) > PROVED)
    if chosen.fitted.added and (verdict != "missing-physics" or _hurts(rows)):
        # a name that is not given is not shown, proved or written to corrected.toml either
        chosen = next(h for h in found.hypotheses if not h.fitted.added)
        verdict = verdict if verdict == "unexplained" else _without_a_name(found)
        rows = _prove(found, chosen, proof, model, seed)
    say("drawing", 0.95)
    before = found.nominal.candidate.active
    unknown = [unknown_inputs(found.setup.whole, found.nominal.vector, t, before) for t in found.setup.whole.targets]
    return _report(found, chosen, verdict, rows, unknown, model, seed, time.perf_counter() - began)


def _without_a_name(found: Explanation) -> Verdict:
    """The verdict where held-out recordings refuse every name."""
    return "adequate" if found.before.at_the_floor else "unexplained"


def _silent(what: str, done: float) -> None:
    """Progress that nobody asked for."""


def explain(
    setup: Setup, *, jobs: int = 1, progress: Progress, names: Sequence[str] | None = None
) -> Explanation:
    """Fits the nominal model, every single effect, and what still helps beside the best ones."""
    search = Search(problem=setup.problem, nominal=setup.nominal, scales=setup.scales, jobs=jobs)
    search = _with_noise(search, search.fit_nominal())
    nominal = search.fit_nominal()
    within = tempered(search, nominal)
    if within is not search:
        search, nominal = within, within.fit_nominal()
    wanted = [n for n in names or table() if _applies(n, setup)]
    progress("trying every effect", 0.1)
    fits = search.explain(nominal, wanted)
    if setup.problem.kind == "axis":  # the rule on a machine axis: gravity, or an offset of the drive
        offset = next(f for f in search.explain(nominal, ["constant-load"]))
        fits = _distinct([*fits, *search.explain(offset, wanted)])
    search, nominal, fits = _reweighted(search, nominal, fits)
    before = evidence.statistics(search.problem, nominal)
    best = min([nominal, *fits], key=lambda f: f.cost)
    left = evidence.statistics(search.problem, best)
    layer = fits[:3]
    for size in range(2, MOST_EFFECTS + 1):
        if left.at_the_floor or not layer:
            break
        progress(f"trying {size} effects at once", 0.1 + 0.25 * size)
        more = [f for base in layer for f in search.explain(base, wanted, keep=1)]
        more = _distinct(more)
        gained = left.variance - min(f.cost for f in more) / left.count if more else 0.0
        if gained < WORTH * left.variance:
            break
        fits += more
        best = min(fits, key=lambda f: f.cost)
        left = evidence.statistics(search.problem, best)
        layer = sorted(more, key=lambda f: f.cost)[:2]
    search, nominal, fits = _reweighted(search, nominal, fits)
    best = min([nominal, *fits], key=lambda f: f.cost)
    left = evidence.statistics(search.problem, best)
    hypotheses = evidence.weigh([nominal, *fits], left, rivals=len(wanted), prior=_prior(setup))
    return Explanation(
        setup=replace(setup, problem=search.problem, whole=replace(setup.whole, noise=search.problem.noise)),
        nominal=nominal,
        hypotheses=tuple(hypotheses),
        left=left,
        before=before,
    )


def _applies(name: str, setup: Setup) -> bool:
    """Whether an effect can be told at all from these signals and this model."""
    effect = table()[name]
    axis = setup.problem.kind == "axis"
    if axis and effect.site in ("voltage", "flux"):
        return False
    if setup.problem.kind == "lti" and effect.site not in ("actuator", "sensor"):
        return False
    if name == "sensor-rectification" and not _may_be_rectified(setup):
        return False
    if any(p.lattice for p in effect.parameters):
        return False  # read off the values, not fitted
    if any(p.cyclic for p in effect.parameters) and not any(p.order for p in effect.parameters):
        return _revolutions(setup) > 0.75  # what comes back once a revolution has to have come back
    if name == "viscous-friction":
        return setup.nominal.uncertainty.get("viscous_friction", 0.0) == 0.0
    signals = {s for t in setup.problem.targets for s in t.recorded}
    return not (effect.site == "sensor" and "speed" not in signals)


def _may_be_rectified(setup: Setup) -> bool:
    """A sensor that does not see the direction never shows a negative speed."""
    speeds = [t.speed for t in setup.problem.targets if t.speed.size]
    return all(np.percentile(s, 2.0) > -0.05 * np.max(np.abs(s)) for s in speeds)


def _revolutions(setup: Setup) -> float:
    """The longest travel of a recording in revolutions (metres on a linear axis)."""
    spans = [float(np.ptp(t.angle)) for t in setup.problem.targets if t.angle.size]
    return max(spans, default=np.inf) * setup.problem.angle_per_position / (2.0 * np.pi)


def _prior(setup: Setup) -> dict[str, float]:
    """Log prior odds that differ from uniform: a steady load is rare on a bench motor, common on a machine axis."""
    return {"constant-load": np.log(len(table())) + 1.0 if setup.problem.kind == "axis" else -3.0}


def _with_noise(search: Search, fitted: Fitted) -> Search:
    problem = search.problem
    levels = noise_levels(problem.targets, problem.residuals(fitted.vector, fitted.candidate.active))
    return replace(search, problem=replace(problem, noise=levels))


def _reweighted(search: Search, nominal: Fitted, fits: list[Fitted]) -> tuple[Search, Fitted, list[Fitted]]:
    """The same fits under the noise levels that the best one leaves, where they differ."""
    best = min([nominal, *fits], key=lambda f: f.cost)
    other = tempered(_with_noise(search, best), best)
    change = max(abs(np.log(v / search.problem.noise[s])) for s, v in other.problem.noise.items())
    change = max(change, abs(np.log(other.problem.colour / search.problem.colour)) / 30.0)
    if change < 0.03:
        return search, nominal, fits
    kept = fits[:12]
    again = [other.refit(f, other.problem) for f in [nominal, *kept]]
    return other, again[0], sorted(again[1:], key=lambda f: f.cost)


def _distinct(fits: list[Fitted]) -> list[Fitted]:
    """Each set of effects once."""
    seen: dict[frozenset[str], Fitted] = {}
    for f in sorted(fits, key=lambda f: f.cost):
        seen.setdefault(frozenset(f.added), f)
    return list(seen.values())


def _choose(found: Explanation) -> Hypothesis:
    """The most probable explanation; the nominal model where the gain is not material."""
    first = found.hypotheses[0]
    nominal = next(h for h in found.hypotheses if not h.fitted.added)
    gain = 1.0 - first.fitted.minimum.chi2 / nominal.fitted.minimum.chi2
    return nominal if gain < MATERIAL else first


def verdict_of(found: Explanation, chosen: Hypothesis, *, proved: bool = False) -> Verdict:
    """Found, nothing missing, or something without a name. `proved`: by held-out recordings, so that less is asked."""
    nominal = next(h for h in found.hypotheses if not h.fitted.added)
    count = max(found.left.count, 1)
    before, after = nominal.fitted.minimum.chi2 / count, chosen.fitted.minimum.chi2 / count
    left_over = not found.left.at_the_floor
    if not chosen.fitted.added:
        return "unexplained" if left_over and after > 1.0 + 2.0 * MATERIAL else "adequate"
    removed = 1.0 - max(after - 1.0, 0.0) / max(before - 1.0, 1e-12)
    enough = PARTLY if proved else REMOVED
    return "unexplained" if left_over and removed < enough else "missing-physics"


def _prove(
    found: Explanation, chosen: Hypothesis, proof: Sequence[Target], model: Model, seed: int
) -> tuple[HeldoutRow, ...]:
    setup = found.setup
    given = Search(problem=setup.problem, nominal=setup.nominal, scales=setup.scales).fit_start()
    nominal = Contender(vector=given.vector, active=tuple(given.active))
    refitted = Contender(vector=found.nominal.vector, active=tuple(found.nominal.candidate.active))
    corrected = None
    if chosen.fitted.added:
        corrected = Contender(vector=chosen.fitted.vector, active=tuple(chosen.fitted.candidate.active))
    units = {
        "current": "A",
        "speed": "m/s" if model.linear else "rad/s",
        "position": "m" if model.linear else "rad",
    }
    return heldout_rows(setup.whole, proof, nominal, refitted, corrected, units=units, seed=seed)


def _hurts(rows: Sequence[HeldoutRow]) -> bool:
    """Whether the correction makes held-out simulation certainly worse."""
    main = [r for r in rows if r.region == "all" and r.gain_interval is not None]
    if any(r.corrected is not None and not np.isfinite(r.corrected) for r in main):
        return True  # it runs away
    return bool(main) and all(r.gain_interval[1] < 0.0 for r in main if r.gain_interval)


def ambiguous(found: Explanation, chosen: Hypothesis) -> tuple[Hypothesis, ...]:
    """The explanations that these recordings do not tell from the chosen one, itself first."""
    same = [
        h
        for h in found.hypotheses
        if h.fitted.added
        and len(h.fitted.added) == len(chosen.fitted.added)
        and h.probability > 0.05 * chosen.probability
    ]
    others = [h for h in same if h is not chosen]
    return (chosen, *others)[:4]


def _report(
    found: Explanation,
    chosen: Hypothesis,
    verdict: Verdict,
    rows: tuple[HeldoutRow, ...],
    unknown: list[Unknown],
    model: Model,
    seed: int,
    elapsed: float,
) -> Diagnosis:
    named = verdict == "missing-physics"
    same = ambiguous(found, chosen) if named else ()
    effects = found_effects(found, chosen) if chosen.fitted.added and named else ()
    names = tuple(dict.fromkeys([e.name for e in effects[:1]] + [_lead(h, chosen) for h in same[1:]]))
    equation = effects[0].equation if effects else ""
    where = regions(unknown, linear=model.linear)
    nominal = next(h for h in found.hypotheses if not h.fitted.added)
    return Diagnosis(
        verdict=verdict,
        equation=equation,
        effects=effects,
        set=names,
        alternatives=tuple(
            Alternative(
                effects=h.fitted.added,
                probability=h.probability,
                separated_by=separated_by((*chosen.fitted.added, *h.fitted.added)),
            )
            for h in found.hypotheses[:6]
            if h is not chosen and h.fitted.added and h.probability > 1e-3
        ),
        location=Location(equation=equation, regions=where, description=curves.describe(where)),
        nominal_fit=nominal_fit(found, chosen, model),
        heldout=rows,
        curves=curves.plots(found, chosen, unknown, linear=model.linear),
        warnings=_warnings(found, chosen, verdict, proved=bool(rows)),
        next_experiment=separated_by(names) if len(names) > 1 else "",
        adequate_probability=nominal.probability,
        seed=seed,
        version=__version__,
        elapsed=elapsed,
        corrected=corrected_model(chosen.fitted, model),
    )


def _lead(h: Hypothesis, chosen: Hypothesis) -> str:
    """The name by which an explanation differs from the chosen one."""
    own = [n for n in h.fitted.added if n not in chosen.fitted.added]
    return own[0] if own else h.fitted.added[0]


def _warnings(found: Explanation, chosen: Hypothesis, verdict: Verdict, *, proved: bool) -> tuple[str, ...]:
    texts = []
    if verdict == "missing-physics" and not proved:
        texts.append("no held-out recording was given: that the corrected model simulates better is not proved")
    if verdict == "missing-physics" and not found.left.at_the_floor:
        texts.append(
            f"something smaller is left over: the residual of the corrected model is coloured "
            f"({found.left.effective:.0f} independent samples of {found.left.count})"
        )
    for u, value in zip(chosen.fitted.candidate.unknowns, chosen.fitted.minimum.values, strict=True):
        if u.prior is not None and u.prior > 0.0 and u.prior_std > 0.0 and "." not in u.name:
            off = abs(np.log(value / u.prior)) / u.prior_std if value > 0.0 else np.inf
            if off > 3.0:
                texts.append(f"{u.name} had to move by {off:.1f} times its declared uncertainty")
    return tuple(texts)
