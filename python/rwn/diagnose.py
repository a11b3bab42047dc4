"""The main job: undo mistakes, refit, locate, name, model, show."""

from __future__ import annotations

import os
import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rwn import _core, curves, excitation, mistakes
from rwn._core import __version__
from rwn.correct import corrected_model, found_effects, nominal_fit
from rwn.diagnosis import Alternative, Diagnosis, Estimate, FoundEffect, HeldoutRow, Location, Verdict
from rwn.effects import table
from rwn.evidence import Hypothesis
from rwn.experiments import separated_by
from rwn.explain import Explanation, Progress, explain
from rwn.locate import regions, unknown_inputs
from rwn.mistakes import Mistake
from rwn.model import Model
from rwn.prepare import prepare, proof_target
from rwn.proof import LEFT_OUT, proved
from rwn.recording import Recording
from rwn.refuse import heldout_error, removed_certainly, without_what_hurts
from rwn.stand_in import picture, proved_stand_in
from rwn.unknown_law import laws
from rwn.verdict import choose, is_certain, refused, verdict_of, verdict_without_a_name, whole

NO_NETWORK = (
    "no wavelet network over one state helps on recordings that were not fitted: corrected.toml holds the refitted "
    "nominal model"
)
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
    jobs = jobs or os.cpu_count() or 1
    made, found = _explained(recordings, model, jobs, say)
    say("proving it on data that were not fitted", 0.85)
    for mistake in made:
        heldout = [mistake.undo(r) for r in heldout]
    proof = [proof_target(r, model) for r in heldout]
    chosen = choose(found)
    if proof:
        chosen = without_what_hurts(
            found.hypotheses, chosen, lambda h: proved(found, h, proof, model, seed=seed, jobs=jobs)
        )
    rows = proved(found, chosen, proof, model, seed=seed, jobs=jobs)
    verdict = verdict_of(found, chosen, certain=is_certain(rows))
    partly = None
    if chosen.fitted.added and (verdict != "missing-physics" or refused(found, chosen, rows)):
        # a name that is not given is not shown or proved; it may still stand in for what has no name
        partly = (chosen, rows) if is_certain(rows) else None
        chosen = found.nothing_missing
        verdict = verdict if verdict == "unexplained" else verdict_without_a_name(found)
        rows = proved(found, chosen, proof, model, seed=seed, jobs=jobs)
    network = None
    if verdict == "unexplained":
        say("drawing what has no name", 0.9)
        network = proved_stand_in(found, model, proof, seed=seed, jobs=jobs)
        if partly and heldout_error(partly[1]) <= heldout_error(network[1] if network else rows):
            network, (chosen, rows) = None, partly
    if network:
        drawn, rows = network
        found, chosen, model = drawn.found, drawn.chosen, drawn.model
    say("drawing", 0.95)
    report = _report(found, chosen, verdict, made, rows, model, seed, time.perf_counter() - began)
    if network:
        return replace(
            report, stand_in=f"a wavelet network, {drawn.place.words}", curves=(*report.curves, picture(drawn))
        )
    if verdict == "unexplained" and chosen.fitted.added:
        return replace(report, stand_in=_leading(chosen, rows))
    without = (NO_NETWORK,) if verdict == "unexplained" and model.kind != "lti" else ()
    return replace(report, warnings=(*report.warnings, *without))


def _silent(what: str, done: float) -> None:
    """Progress that nobody asked for."""


def _leading(chosen: Hypothesis, rows: Sequence[HeldoutRow]) -> str:
    """A name that explains a good part and not the whole."""
    part = f"{removed_certainly(rows):.0%}"
    return f"{' + '.join(chosen.fitted.added)}, proved to remove {part} of the held-out squared error and not the whole"


def _explained(
    recordings: Sequence[Recording], model: Model, jobs: int, say: Progress
) -> tuple[list[Mistake], Explanation]:
    """Mistakes of the recordings, and what explains these when they are undone."""
    say("looking for mistakes in the recordings", 0.0)
    made, recordings = _undone(recordings, model)
    say("refitting the nominal model", 0.05)
    if mistakes.suspected(recordings, model):  # before contradictions are explained by several effects at once
        simplest = explain(prepare(recordings, model), jobs=jobs, progress=say, at_once=1)
        made, recordings = _without(_late(simplest, recordings, model), made, recordings)
    found = explain(prepare(recordings, model), jobs=jobs, progress=say)
    late = _late(found, recordings, model)
    if late:
        made, recordings = _without(late, made, recordings)
        found = explain(prepare(recordings, model), jobs=jobs, progress=say)
    return made, found


def _without(
    mistake: Mistake | None, made: list[Mistake], recordings: Sequence[Recording]
) -> tuple[list[Mistake], Sequence[Recording]]:
    """One more mistake, if any, and the recordings without it."""
    return ([*made, mistake], [mistake.undo(r) for r in recordings]) if mistake else (made, recordings)


def _undone(recordings: Sequence[Recording], model: Model) -> tuple[list[Mistake], list[Recording]]:
    """At most two gross mistakes, and the recordings without them."""
    made: list[Mistake] = []
    right = list(recordings)
    if model.kind == "lti":  # its gain is in no unit that could be doubted
        return made, right
    while len(made) < 2 and (mistake := mistakes.gross(right, model)):
        made.append(mistake)
        right = [mistake.undo(r) for r in right]
    return made, right


def _late(found: Explanation, recordings: Sequence[Recording], model: Model) -> Mistake | None:
    """A mistake that physics might explain as well, and does not."""
    if model.kind == "lti" or found.nominal.cost < mistakes.AT_THE_NOISE * found.before.count:
        return None
    best = min(h.fitted.cost for h in found.hypotheses)
    return mistakes.fine(recordings, model, noise=found.setup.problem.noise, rival=best)


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
    made: Sequence[Mistake],
    rows: tuple[HeldoutRow, ...],
    model: Model,
    seed: int,
    elapsed: float,
) -> Diagnosis:
    before = found.nominal.candidate.active
    unknown = [unknown_inputs(found.setup.whole, found.nominal.vector, t, before) for t in found.setup.whole.targets]
    named = verdict == "missing-physics"
    same = ambiguous(found, chosen) if named else ()
    physics = found_effects(found, chosen) if chosen.fitted.added and named else ()
    share = whole(found, chosen, certain=is_certain(rows))
    physics = tuple(replace(e, probability=share * e.probability) for e in physics)
    steps = _coarse_speed(found)
    if steps and verdict in ("adequate", "missing-physics"):
        physics, verdict = (*physics, steps), "missing-physics"
    names = tuple(dict.fromkeys([e.name for e in physics[:1]] + [_lead(h, chosen) for h in same[1:]]))
    effects = (*(m.found(0.99) for m in made), *physics)
    if made:
        verdict, names = "recording-mistake", tuple(m.name for m in made)
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
        curves=curves.plots(found, chosen, unknown, depends, linear=model.linear),
        warnings=_warnings(found, chosen, verdict, rows),
        next_experiment=_next_experiment(found, verdict, names),
        adequate_probability=found.nothing_missing.probability,
        seed=seed,
        version=__version__,
        elapsed=elapsed,
        corrected=corrected_model(chosen.fitted, model),
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
    for f in found.strained[:1]:
        texts.append(
            f"{' + '.join(f.added)} fits better, but {', '.join(f.limits_met)} ran into a limit: there the law bends "
            "towards one that it is not, and it is not named"
        )
    for u, value in zip(chosen.fitted.candidate.unknowns, chosen.fitted.minimum.values, strict=True):
        if u.prior is not None and u.prior > 0.0 and u.prior_std > 0.0 and "." not in u.name:
            off = abs(np.log(value / u.prior)) / u.prior_std if value > 0.0 else np.inf
            if off > 3.0:
                texts.append(f"{u.name} had to move by {off:.1f} times its declared uncertainty")
    return tuple(texts)
