"""The main job: undo mistakes, refit, locate, name, model, show."""

from __future__ import annotations

import os
import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rwn import _core
from rwn._core import __version__
from rwn.correct import excitation
from rwn.correct.corrected_model import corrected_model, found_effects, nominal_fit
from rwn.correct.next_experiment import separated_by
from rwn.decide.decision import Conclusion, conclude
from rwn.decide.verdict import is_certain, rests_on_what_was_declared, whole
from rwn.faults.fault import Mistake, without
from rwn.faults.resolve import explained
from rwn.fit.preparation import proof_target
from rwn.fit.prior_weight import farthest
from rwn.fit.residuals import Hypothesis
from rwn.locate.dependence import laws
from rwn.locate.unknown_inputs import regions, unknown_inputs
from rwn.model.model import Model
from rwn.model.vocabulary import table
from rwn.name.forward import Explanation, Progress
from rwn.parallel import crew
from rwn.prove.proof import LEFT_OUT
from rwn.recording.recording import Recording
from rwn.report import figures as curves
from rwn.report.diagnosis import Alternative, Beneath, Diagnosis, Estimate, FoundEffect, HeldoutRow, Location, Verdict

QUANTISATION = "sensor-quantization"


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
        heldout: runs used for proof alone; without them every recording is judged by fits that did not see it.
        seed: of the block bootstrap; the result depends on input and seed alone.
        jobs: threads (default: all processors); the result does not depend on it.
        progress: called with what is being done and how far it is, 0 to 1.

    Returns:
        The verdict, located region, named effects with intervals, corrected model and the curves that show it.
    """
    began = time.perf_counter()
    say = progress or _silent
    with crew(jobs or os.cpu_count() or 1):
        made, found = explained(recordings, model, say=say)
        say("proving it on data that were not fitted", 0.85)
        for mistake in made:
            heldout = without(heldout, mistake)
        end = conclude(found, [proof_target(r, model) for r in heldout], model, seed=seed, say=say)
        say("drawing", 0.95)
        return _report(end, made, seed, time.perf_counter() - began)


def _silent(what: str, done: float) -> None:
    """Progress that nobody asked for."""


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


def _report(end: Conclusion, made: Sequence[Mistake], seed: int, elapsed: float) -> Diagnosis:
    found, chosen, verdict, rows, model = end.found, end.chosen, end.verdict, end.rows, end.model
    before = found.nominal.candidate.active
    unknown = [unknown_inputs(found.setup.whole, found.nominal.vector, t, before) for t in found.setup.whole.targets]
    named = verdict == "missing-physics"
    same = ambiguous(found, chosen) if named else ()
    physics = found_effects(found, chosen) if chosen.fitted.added and named else ()
    share = whole(found, chosen, certain=is_certain(rows), another=end.another)
    physics = tuple(replace(e, probability=share * e.probability) for e in physics)
    steps = _coarse_speed(found)
    if steps and verdict in ("adequate", "missing-physics"):
        physics, verdict = (*physics, steps), "missing-physics"
    names = tuple(dict.fromkeys([e.name for e in physics[:1]] + [_lead(h, chosen) for h in same[1:]]))
    effects = (*(m.found() for m in made), *physics)
    beneath = Beneath(verdict=verdict, set=names) if made else None
    if made:
        verdict, names = "recording-mistake", (made[0].name, *made[0].also)
    equation = effects[0].equation if effects else ""
    where = regions(unknown, linear=model.linear)
    torque_unknown = verdict != "adequate" and model.kind != "lti"  # a transfer function has none
    depends = laws(found.setup.whole, found.nominal, unknown, linear=model.linear) if torque_unknown else ()
    place = curves.describe(where, depends, linear=model.linear)
    return Diagnosis(
        verdict=verdict,
        equation=equation,
        effects=effects,
        set=names,
        beneath=beneath,
        alternatives=tuple(
            Alternative(
                effects=h.fitted.added,
                probability=h.probability,
                separated_by=separated_by((*chosen.fitted.added, *h.fitted.added)),
            )
            for h in found.hypotheses[:6]
            if h is not chosen and h.fitted.added and h.probability > 1e-3
        ),
        location=Location(equation=equation, regions=where, description=place),
        nominal_fit=nominal_fit(found, chosen, model),
        heldout=rows,
        curves=(*curves.plots(found, chosen, unknown, depends, linear=model.linear), *end.curves),
        warnings=(*_warnings(found, chosen, verdict, rows), *end.warnings),
        next_experiment=_next_experiment(found, verdict, names),
        adequate_probability=found.nothing_missing.probability,
        whole=share if named else 1.0,
        seed=seed,
        version=__version__,
        elapsed=elapsed,
        stand_in=end.stand_in,
        corrected=corrected_model(chosen.final, model),
    )


def _lead(h: Hypothesis, chosen: Hypothesis) -> str:
    """The name by which an explanation differs from the chosen one."""
    own = [n for n in h.fitted.added if n not in chosen.fitted.added]
    return own[0] if own else h.fitted.added[0]


def _coarse_speed(found: Explanation) -> FoundEffect | None:
    """A speed signal that is rounded to steps, read off its values."""
    steps = found.speed_steps
    if not steps:
        return None
    effect, step = table()[QUANTISATION], float(np.median(steps))
    unit, interval = effect.parameters[0].unit, (min(steps) * 0.9999, max(steps) * 1.0001)
    resolution = Estimate(value=step, unit=unit, interval=interval)
    return FoundEffect(
        name=QUANTISATION, equation=effect.mismatch, probability=0.99, formula=effect.equation, meaning=effect.meaning,
        parameters={effect.parameters[0].name: resolution},
    )  # fmt: skip


def _next_experiment(found: Explanation, verdict: Verdict, names: Sequence[str]) -> str:
    if verdict == "insufficient-excitation":
        return excitation.advice(found.setup.whole.targets)
    return separated_by(names) if len(names) > 1 else ""


def _does_not_run(found: Explanation) -> list[str]:
    """What keeps the model as given from being simulated at all."""
    start = found.nominal.candidate
    runs = [found.setup.whole.simulate(t, start.vector, start.active).status for t in found.setup.whole.targets]
    failed = dict.fromkeys(status for status in runs if status != "ok")
    return [f"the model as given does not run ({status}): {_core.simulation_advice(status)}" for status in failed]


def _warnings(
    found: Explanation, chosen: Hypothesis, verdict: Verdict, rows: Sequence[HeldoutRow]
) -> tuple[str, ...]:
    texts = _does_not_run(found)
    if chosen.fitted.added and rows and all(LEFT_OUT in r.recording for r in rows):
        texts.append(
            "no held-out recording was given: the proof is by cross-validation, each part simulated by fits without it"
        )
    if verdict == "missing-physics" and not found.left.at_the_floor:
        texts.append(
            f"something smaller is left over: the residual of the corrected model is coloured "
            f"({found.left.effective:.0f} independent samples of {found.left.count})"
        )
    for signal, share in found.weighted.persistence.items():
        texts.append(
            f"what is left of the {signal} lasts (its correlation from sample to sample is {share:.2f}): the corrected "
            "model was fitted to what is new in it"
        )
    if found.cut_short:
        texts.append(
            "more effects at once were not tried, since the search had cost what it may: recordings of fewer samples, "
            "without the parts that say little, leave room for them"
        )
    if rests_on_what_was_declared(found, chosen):
        texts.append(
            "without it the nominal model fits as well, "
            f"{farthest(found.nothing_missing.fitted):.0f} declared uncertainties off: the name rests on these"
        )
    for f in found.strained[:1]:
        texts.append(
            f"{' + '.join(f.added)} fits better, but {', '.join(f.limits_met)} ran into a limit: there the law bends "
            "towards one that it is not, and it is not named"
        )
    for u, value in zip(chosen.final.candidate.unknowns, chosen.final.minimum.values, strict=True):
        if u.prior is not None and u.prior > 0.0 and u.prior_std > 0.0 and "." not in u.name:
            off = abs(np.log(value / u.prior)) / u.prior_std if value > 0.0 else np.inf
            if off > 3.0:
                moved = f"had to move by {off:.1f} times its declared uncertainty" if value > 0.0 else "went to zero"
                texts.append(f"{u.name} {moved}")
    return tuple(texts)
