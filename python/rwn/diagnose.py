"""The main job: inspect recordings, undo their faults, refit, locate, name, prove, decide, correct, report."""

from __future__ import annotations

import os
import time
from collections.abc import Sequence
from dataclasses import replace

from rwn.correct.correction import correct
from rwn.decide.decision import decide
from rwn.faults.fault import without
from rwn.faults.resolve import resolved
from rwn.model.model import Model
from rwn.name.forward import Progress
from rwn.parallel import crew
from rwn.recording.inspection import inspected
from rwn.recording.recording import Recording
from rwn.report.assemble import assemble
from rwn.report.diagnosis import Diagnosis
from rwn.report.diagnosis_data import as_found
from rwn.simulate.run import judging_run


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

    Raises:
        InputError: where a recording does not fit the model.
    """
    began = time.perf_counter()
    say = progress or _silent
    recordings, findings = inspected(recordings)
    heldout, unseen_findings = inspected(heldout)
    with crew(jobs or os.cpu_count() or 1):
        faults, ranking = resolved(recordings, model, say=say)
        say("proving it on data that were not fitted", 0.85)
        for fault in faults:
            heldout = without(heldout, fault)
        unseen = [judging_run(r, model) for r in heldout]
        decision = decide(ranking, unseen, model, seed=seed)
        say("correcting the model", 0.9)
        correction = correct(decision, unseen, model, seed=seed)
        say("drawing", 0.95)
        found = assemble(correction, faults, model, unseen, seed=seed, elapsed=time.perf_counter() - began)
        return replace(found, findings=as_found((*findings, *unseen_findings)))


def _silent(what: str, done: float) -> None:
    """Progress that nobody asked for."""
