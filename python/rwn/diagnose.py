"""The main job: inspect recordings, undo their faults, refit, name, prove, decide, correct, report."""

from __future__ import annotations

import os
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce
from pathlib import Path
from typing import Any

from rwn.correct.correction import correct
from rwn.decide.decision import decide
from rwn.errors import InputError
from rwn.faults.fault import without_all
from rwn.faults.held_shaft import without_held
from rwn.faults.late_enable import LateEnable, late_beside, late_enables, powered
from rwn.faults.odd_files import without_unseen_mistakes
from rwn.faults.sensor_errors import without_sensor_errors
from rwn.faults.uneven_files import at_own_levels, uneven_unseen
from rwn.fit.nominal import check_it_begins, check_it_runs
from rwn.fit.preparation import prepare
from rwn.measurement.unrecorded_input import inferred_input_findings, with_inferred_input
from rwn.model.files import model_to_fit
from rwn.model.model import Model
from rwn.model.recordings import read_recordings, recordings_to_fit, refuse_doubles
from rwn.name.forward import Progress
from rwn.parallel import thread_pool
from rwn.prove.as_simulated import as_simulated
from rwn.recording.inspection import Finding, inspected
from rwn.recording.inspection.overlap import overlaps
from rwn.recording.recording import Recording, remarks
from rwn.report.assemble import assemble
from rwn.report.diagnosis import Diagnosis
from rwn.report.file_units import in_file_units
from rwn.report.provenance import sources
from rwn.search.search import SearchResult, search
from rwn.simulate.declared import check_declared
from rwn.simulate.recorded_run import judging_run, measured_alike
from rwn.simulate.run import Run

LEAST_EFFORT, MOST_EFFORT = 0.1, 1000.0
AFTER_SEARCH = 0.85  # progress when the search is done


def diagnose(
    recordings: Any,
    model: Model | str | Path,
    *,
    heldout: Any = (),
    seed: int = 0,
    jobs: int | None = None,
    effort: float = 1.0,
    progress: Progress | None = None,
) -> Diagnosis:
    """What physics the model leaves out of these recordings, proved on recordings that were not fitted.

    Args:
        recordings: runs to judge the model from: one or several of paths, tables in Python and recordings.
        model: the nominal model with its declared uncertainty, or its file.
        heldout: runs used for proof alone; without them every recording is judged by fits that did not see it.
        seed: of the block bootstrap; the result depends on input and seed alone.
        jobs: threads (default: all processors); the result does not depend on it.
        effort: what the search may cost, as a multiple of the usual; a warning says what was not tried for it.
        progress: called with what is being done and how far it is, 0 to 1; a search under another measurement begins
            anew.

    Returns:
        The verdict, located region, named effects with intervals, corrected model and the curves that show it.

    Raises:
        InputError: where a recording is not usable, does not fit the model, or is given twice.
        NoResultError: where the refitted model cannot be simulated over a recording that is fitted.
    """
    began = time.perf_counter()
    say = progress or _silent
    _check_options(seed, jobs, effort, say)
    model_given, model = model, model_to_fit(model)
    fitted, judged = recordings_to_fit(recordings, model), read_recordings(heldout, model)
    refuse_doubles([*fitted, *judged])
    used = sources(model_given, fitted, judged)
    common, said = tuple(overlaps(fitted, judged)), remarks((*fitted, *judged))
    (fitted, seen_in_fitted), (judged, seen_in_judged) = inspected(fitted), inspected(judged)
    (judged, held_back), (fitted, held) = without_held(judged, model, fitted), without_held(fitted, model)
    _check_given(fitted, model)
    with thread_pool(jobs or os.cpu_count() or 1):
        late = late_enables(fitted, model)
        found = search(fitted, model, late=late, say=say, effort=effort)
        check_it_runs(found.ranking.problem, found.ranking.nominal_fit)
        say("proving it on data that were not fitted", AFTER_SEARCH)
        unseen = _unseen(judged, fitted, found)
        decision = decide(found.ranking, unseen.runs, found.model, seed=seed)
        say("correcting the model", 0.9)
        correction = correct(decision, unseen.runs, found.model, seed=seed)
        say("drawing", 0.95)
        elapsed = time.perf_counter() - began
        made = assemble(
            correction, found.faults, found.model, unseen.runs, units=fitted[0].units, seed=seed, elapsed=elapsed
        )  # fmt: skip
    findings = (*seen_in_fitted, *held, *held_back, *found.findings, *seen_in_judged, *common, *unseen.findings(found))
    layout = reduce(lambda known, fault: fault.in_layout(known), found.faults, made.corrected.recording)
    rows = as_simulated(made.heldout, found.ranking.problem, unseen.runs, unseen.alone, correction.final)
    made = replace(made, heldout=rows, corrected=replace(made.corrected, recording=layout), findings=findings)
    made = replace(made, warnings=(*made.warnings, *said), sources=used)
    return in_file_units(made, (*fitted, *judged))


def _check_given(recordings: Sequence[Recording], model: Model) -> None:
    """Raises InputError or NoResultError where the model as given is none for these recordings."""
    if model.effects or model.drive.coefficients:  # what has neither does not run away
        prepared = prepare(recordings, model)
        check_declared(model, [prepared.scales])
        check_it_begins(prepared)


@dataclass(frozen=True, kw_only=True)
class _Unseen:
    """Recordings that were kept back, without the faults that were found, with what only their own motion tells."""

    runs: Sequence[Run]
    alone: Sequence[Run]  # without what their own motion told of the input, or of their levels
    late: tuple[LateEnable, ...]
    sensor_errors: tuple[Finding, ...]
    contradicting: tuple[Finding, ...]

    def findings(self, found: SearchResult) -> tuple[Finding, ...]:
        """What their own motion told: errors of sensors, late enables, an input between rows, levels of their own."""
        given = found.model.drive.input
        enabled = (one.as_finding(given) for one in self.late)
        ranking = found.ranking
        told = (*inferred_input_findings(self.runs, given), *uneven_unseen(ranking, self.runs))
        return (*self.sensor_errors, *enabled, *told, *self.contradicting)


def _unseen(recordings: Sequence[Recording], fitted: Sequence[Recording], found: SearchResult) -> _Unseen:
    known = without_all(fitted, found.faults)
    problem, best = found.ranking.problem, found.ranking.fits[0]
    of_all = [fault for fault in found.faults if not fault.recordings]  # not what some of the fitted files alone have
    right, mistaken = without_unseen_mistakes(known, without_all(recordings, of_all), found.model)
    late = late_beside(right, found.model, problem, best.fit)
    right = powered(right, late, found.model)

    def runs(of: Sequence[Recording]) -> tuple[Run, ...]:
        return tuple(measured_alike([judging_run(r, found.model) for r in of], problem.whole))

    right, found_in = without_sensor_errors(right, problem.on(runs(right)), best.fit)
    kept_back = replace(problem.in_free_run(), runs=runs(right))
    told = with_inferred_input(kept_back, best.final).runs
    told, contradicting = at_own_levels(found.ranking, told)
    errors = (*mistaken, *found_in)
    return _Unseen(runs=told, alone=kept_back.runs, late=late, sensor_errors=errors, contradicting=contradicting)


def _check_options(seed: int, jobs: int | None, effort: float, progress: Any) -> None:
    if isinstance(effort, bool) or not isinstance(effort, int | float) or not LEAST_EFFORT <= effort <= MOST_EFFORT:
        raise InputError(
            f"effort is {effort!r}",
            where="diagnose",
            expected=f"a number from {LEAST_EFFORT:g} to {MOST_EFFORT:g}",
            fix="pass effort=3",
        )
    for name, value, least in (("seed", seed, 0), ("jobs", 1 if jobs is None else jobs, 1)):
        if isinstance(value, bool) or not isinstance(value, int) or value < least:
            raise InputError(
                f"{name} is {value!r}",
                where="diagnose",
                expected=f"a whole number from {least}",
                fix=f"pass {name}={least}",
            )
    if not callable(progress):
        said = f"progress is {progress!r}"
        raise InputError(said, where="diagnose", expected="a function", fix="pass progress=print")


def _silent(what: str, done: float) -> None:
    """Progress that nobody asked for."""
