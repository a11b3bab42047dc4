"""Recordings explained: how their input acted, the faults in them and physics, the first asked again of the last."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from rwn.faults.data_sheet import confirmed, contradicted, without_declared
from rwn.faults.fault import Fault, without_all
from rwn.faults.late_enable import LateEnable, late_under, powered
from rwn.faults.sensor_errors import without_sensor_errors
from rwn.faults.uneven_files import uneven_files
from rwn.fit.fit import Fit
from rwn.fit.preparation import prepare
from rwn.fit.refitting import refitted_beside
from rwn.fit.residuals import statistics
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered, known_filters, stating_filters
from rwn.measurement.likeliest_law import (
    likeliest_with_filters,
    stating,
    with_intersample,
    without_unknown,
    without_untimed,
)
from rwn.measurement.likelihood import is_decisive, log_posterior
from rwn.measurement.unrecorded_input import with_unrecorded_input
from rwn.model.model import Model
from rwn.name.forward import Progress
from rwn.name.ranking import Ranking
from rwn.recording.inspection import Finding, Inspected
from rwn.recording.intersample import AUTO, HELD, INTERSAMPLE
from rwn.recording.recording import Recording
from rwn.search.beneath_faults import beneath_faults
from rwn.simulate.run import Run

ASKED_AGAIN = 2  # times that how the input acted is asked of what was found; each that changes it costs a search


@dataclass(frozen=True, kw_only=True)
class SearchResult:
    """What recordings come to."""

    model: Model  # states how the input acted between the rows
    late: tuple[LateEnable, ...]
    faults: tuple[Fault, ...]
    ranking: Ranking
    sensor_errors: tuple[Finding, ...] = ()  # that the motion hid

    @property
    def findings(self) -> tuple[Finding, ...]:
        """How the input acted and the motion began, as a check of recordings says it."""
        given = self.model.drive.input
        found = [*self.sensor_errors, *(late.as_finding(given) for late in self.late)]
        found += [
            Finding(
                kind="in-motion", recording=run.name, signals=(), count=0,
                words="it starts in motion" if run.begins_turning else "it starts at standstill, held by its drive",
                done="the exact state is fitted with it",
            )
            for run in self.ranking.problem.whole
            if run.in_motion and self.model.recording.initial == "auto"
        ]  # fmt: skip
        whole = self.ranking.problem.whole
        alike = len({run.speed_measured for run in whole}) == 1
        found += [
            Finding(
                kind="speed-difference", recording="all recordings" if alike else run.name, signals=("speed",),
                count=0, words=run.speed_measured.in_words(run.sample_time), done="compared as such",
            )
            for run in (whole[:1] if alike else whole)
            if run.speed_measured.is_difference
        ]  # fmt: skip
        law = self.model.recording.intersample
        if law not in (AUTO, HELD):
            found.append(
                Finding(
                    kind="intersample",
                    recording="all recordings",
                    signals=(given,),
                    count=0,
                    words=INTERSAMPLE[law].said.format(given=given) + INTERSAMPLE[law].words,
                    done="simulated so",
                )
            )
        found += [
            Finding(
                kind="coloured-noise", recording="all recordings", signals=(signal,), count=0,
                words=f"{100.0 * of[0]:.0f} % of the noise of the {signal} is in its next sample too",
                done="errors are judged by what is new in each",
            )
            for signal, of in self.ranking.problem.coloured.items()
        ]  # fmt: skip
        found += uneven_files(self.ranking)
        return tuple(found)


class _Assumptions(NamedTuple):
    """How recordings came about."""

    late: tuple[LateEnable, ...]
    model: Model  # states how the input acted between the rows
    filters: tuple[SensorFilter, ...]  # of the sensors, beside those that the model states


def search(
    recordings: Sequence[Recording], model: Model, *, late: Sequence[LateEnable], say: Progress, effort: float = 1.0
) -> SearchResult:
    """Explains recordings, and does so anew, from the start, where a value of the data sheet cannot be right.

    `late`: power stages that were enabled late, as far as the nominal model shows them. `effort`: what the search may
    cost, as a multiple of the usual.

    Raises InputError where a recording does not fit the model.
    """
    found = _explained(recordings, model, late=late, say=say, effort=effort)
    for wrong in contradicted(found.ranking):
        freed = _explained(recordings, without_declared(model, wrong), late=late, say=say, effort=effort)
        if confirmed(freed.ranking, found.ranking, found.model, wrong):
            return replace(freed, model=replace(freed.model, uncertainty=model.uncertainty))
    return found


def _explained(
    recordings: Sequence[Recording], model: Model, *, late: Sequence[LateEnable], say: Progress, effort: float
) -> SearchResult:
    """The same, asked again where the best explanation shows that the recordings came about otherwise."""
    on, still = powered(recordings, late, model), tuple(late)
    again = with_intersample(on, model)
    as_acted = _as_acted(on, again)
    faults, ranking = beneath_faults(as_acted, again, say=say, effort=effort)
    filters: tuple[SensorFilter, ...] = ()
    sensor_errors = list[Finding]()
    for _ in range(ASKED_AGAIN):
        recordings, spoilt = _without_sensor_errors(recordings, faults, ranking)
        sensor_errors += spoilt
        asked = _asked_again(recordings, model, still, again, faults, ranking)
        alike = not spoilt and asked == _Assumptions(still, again, _filters(ranking, again))
        if alike and (faults or ranking.left.at_the_floor):
            break
        best = None if faults else ranking.fits[0].fit
        acted = _as_acted(powered(recordings, asked.late, model), asked.model, best, asked.filters)
        if alike and not _tells_more(acted, as_acted, asked, ranking):
            break
        as_acted, (still, again, filters) = acted, asked
        known = [best] if best and best.added else []  # a search under another law may not come upon it again
        faults, ranking = beneath_faults(as_acted, again, filters=filters, known=known, say=say, effort=effort)
    again = _stating_speed(stating_filters(again, ranking.problem.filters), ranking.problem.whole)
    return SearchResult(
        model=again, late=still, faults=tuple(faults), ranking=ranking, sensor_errors=tuple(sensor_errors)
    )


def _without_sensor_errors(
    recordings: Sequence[Recording], faults: Sequence[Fault], ranking: Ranking
) -> Inspected:  # fmt: skip
    """The recordings without what the best explanation shows of errors of their sensors.

    As they are where it is of recordings with a fault undone, whose samples are others.
    """
    if faults:
        return Inspected(list(recordings), ())
    return without_sensor_errors(recordings, ranking.problem.in_free_run(), ranking.fits[0].fit)


def _asked_again(
    recordings: Sequence[Recording], model: Model, late: Sequence[LateEnable], stated: Model, faults: Sequence[Fault],
    ranking: Ranking,
) -> _Assumptions:  # fmt: skip
    """How the recordings came about, as the best explanation that was found has it."""
    best = ranking.fits[0].fit
    right = without_all(recordings, faults)
    still = late_under(late, right, stated, ranking.problem, best)
    known = _filters(ranking, stated)
    if stated is model or (stated.recording.intersample == HELD and ranking.left.at_the_floor):
        return _Assumptions(still, stated, known)
    timed = without_untimed(without_all(powered(recordings, still, model), faults), model)
    bare = prepare(timed, stating(model, HELD))
    law, filters = likeliest_with_filters(bare, best, stated.recording.intersample, known)
    return _Assumptions(still, stating(stated, law), filters)


def _tells_more(
    acted: Sequence[Recording], before: Sequence[Recording], found: _Assumptions, ranking: Ranking
) -> bool:  # fmt: skip
    """Whether an input inferred anew beside the best explanation makes the recordings decisively likelier.

    `acted`: the recordings with that input; `before`: with the one that the explanation was found under.
    """
    if not any(r.applied_input is not None and r.applied_input.spread.any() for r in acted):
        return False
    problems = (filtered(prepare(of, found.model), found.filters) for of in (before, acted))
    given, other = (replace(problem, noise=ranking.problem.noise) for problem in problems)
    old, new = (refitted_beside([ranking.fits[0].fit], problem)[0] for problem in (given, other))
    return is_decisive(log_posterior(other, new) - log_posterior(given, old), statistics(other, new))


def _stating_speed(model: Model, runs: Sequence[Run]) -> Model:
    """The model with how the speed of the recordings was measured, in their layout."""
    way = next((run.speed_measured for run in runs if run.speed.size), None)
    if way is None or model.drive.coefficients:
        return model
    return replace(model, recording=replace(model.recording, speed_rows=(way.before, way.after)))


def _filters(ranking: Ranking, stated: Model) -> tuple[SensorFilter, ...]:
    """The filters under which a ranking was found, but for those that the model states."""
    return tuple(f for f in known_filters(ranking.problem) if f.signal not in stated.recording.filters)


def _as_acted(
    recordings: Sequence[Recording], model: Model, best: Fit | None = None, filters: Sequence[SensorFilter] = ()
) -> list[Recording]:
    """The recordings with their input as it acted under the best explanation so far; None: the nominal model."""
    return without_unknown(with_unrecorded_input(recordings, model, best, filters=filters), model)
