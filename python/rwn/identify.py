"""Parameters of a model of known structure, from recordings."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rwn.faults.plain_faults import plain_faults
from rwn.fit.fit import Fit, fit_nominal
from rwn.fit.fitted_model import fitted_model
from rwn.fit.intervals import Estimate, deviations, estimates
from rwn.fit.preparation import prepare
from rwn.fit.prior_weight import BELIEVABLE
from rwn.fit.problem import Problem
from rwn.fit.residual_noise import noise_of, without_drift
from rwn.fit.residuals import Statistics, statistics, structured
from rwn.measurement.likeliest_law import with_intersample
from rwn.model.files import model_to_fit
from rwn.model.model import Model
from rwn.model.recordings import recordings_to_fit
from rwn.recording.inspection import Finding, inspected
from rwn.recording.recording import Recording
from rwn.simulate.declared import check_declared
from rwn.simulate.explained_signal import ExplainedSignal, explained_signals
from rwn.values import Shown, table_of_rows

if TYPE_CHECKING:
    import pandas

COLUMNS = ("parameter", "value", "low", "high", "unit")  # of Identification.table
CUT = 1e-6  # relative; intervals are wider than that on either side of a value, unless they are cut at a bound
CHECK = "check signs, units and columns, or let rwn diagnose find such a mistake or what is missing"
MOST = 0.5  # what a mistake in the recordings leaves of the squared error, when it is undone, at the most
DESCRIBES = 0.5  # share of a signal's variance that a model must explain, to be said to describe it
NOTHING_LEARNED = 0.9  # standard deviation after the fit over the declared one, above which recordings say nothing


@dataclass(frozen=True, kw_only=True)
class Identification(Shown):
    """A fitted model with what can be said of it.

    `model`: with the fitted values (SI). `parameters`: the fitted ones by name, each with value, SI unit and 95 %
    interval. `status`: `converged`, `iteration-limit`, `stalled` or `diverged`; `advice`: what to do about it.
    `not_identifiable`: parameters of which these recordings say less than the data sheet does. `residual_over_noise`:
    rms of what the fit leaves, in units of the noise; 1: nothing but noise. `explained`: how much of every recorded
    output the model explains in free run. `failure`: why it is no model of these recordings, which `rwn.save` refuses
    to write; empty where it is one. `findings`: what is odd in the recordings, and what was done about it; `warnings`:
    what reading them told. `recordings`: what it was fitted to.
    """

    model: Model
    parameters: Mapping[str, Estimate]
    status: str
    advice: str
    not_identifiable: tuple[str, ...]
    residual_over_noise: float
    explained: tuple[ExplainedSignal, ...] = ()
    failure: str = ""
    findings: tuple[Finding, ...] = ()
    warnings: tuple[str, ...] = ()
    recordings: tuple[Recording, ...] = ()

    def __repr__(self) -> str:
        if self.failure:
            return f"<Identification failed: {self.failure}>"
        names = ", ".join(self.parameters)
        return f"<Identification {self.status}: {names}; {self.residual_over_noise:.3g} x the noise is left>"

    def __str__(self) -> str:
        """`repr`, and a line for each parameter."""
        rows = ([_cell(value) for value in row.values()] for row in self._rows())
        values = (f"  {name} = {value} [{low}, {high}] {unit}".rstrip() for name, value, low, high, unit in rows)
        return "\n".join((repr(self), *values))

    def _repr_html_(self) -> str:
        rows = ["".join(f"<td>{_cell(value)}</td>" for value in row.values()) for row in self._rows()]
        head = "".join(f"<th>{name}</th>" for name in COLUMNS)
        return f"<p>{escape(repr(self))}</p><table><tr>{head}</tr>{''.join(f'<tr>{row}</tr>' for row in rows)}</table>"

    def table(self) -> pandas.DataFrame | list[dict[str, Any]]:
        """The parameters in SI, a row each; a list of dictionaries where pandas is not installed.

        Columns: parameter, value, low and high (95 %), unit.
        """
        found: pandas.DataFrame | list[dict[str, Any]] = table_of_rows(self._rows(), COLUMNS)
        return found

    def _rows(self) -> list[dict[str, Any]]:
        return [
            dict(zip(COLUMNS, (name, e.value, *(e.interval or (None, None)), e.unit), strict=True))
            for name, e in self.parameters.items()
        ]


def _cell(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else escape(str(value))


def identify(recordings: Any, model: Model | str | Path) -> Identification:
    """Fits the uncertain parameters of `model` to the free run over all recordings.

    `recordings`: one or several of paths, tables in Python and recordings; `model`: a model or its file.

    Intervals are 95 %, widened for what the residual's variance and colour say, misfit counting for few samples;
    declared uncertainties are priors.
    Where that comes to no model of them, as with a sign error, `failure` says why. Raises InputError where a recording
    does not fit the model.
    """
    model = model_to_fit(model)
    given = recordings_to_fit(recordings, model)
    runs, findings = inspected(given)
    if model.effects:
        check_declared(model, [prepare(runs, model).scales])
    model = with_intersample(runs, model)
    problem, this = _fitted(prepare(runs, model))
    left, status, fitted = statistics(problem, this), this.minimum.status, fitted_model(this, model)
    parameters = estimates(this, left, samples=left.effective_with_misfit)
    explained = explained_signals(fitted, runs)
    name = status.name.lower().replace("_", "-")
    reasons = [f"the fit did not converge ({name}): {status.value.rstrip('.')}"] if name != "converged" else []
    coloured = structured(problem, this)
    reasons += [*_describes_nothing(explained, coloured), *_ended_at_limits(parameters)]
    if coloured and not reasons:
        reasons += _mistaken(given, model, problem, left)
    return Identification(
        model=fitted,
        parameters=parameters,
        status=name,
        advice=status.value,
        explained=explained,
        failure="; ".join(reasons),
        not_identifiable=_unseen(this, left),
        residual_over_noise=left.variance**0.5,
        findings=findings,
        warnings=(
            *(warning for recording in given for warning in recording.warnings),
            *([_more_than_noise(coloured)] if coloured and not reasons else ()),
        ),
        recordings=tuple(given),
    )


def _more_than_noise(signals: Sequence[str]) -> str:
    return (
        f"what is left of the {' and '.join(signals)} is not noise: the model lacks something, and the parameters take "
        "up some of it; rwn diagnose says what"
    )


def _fitted(problem: Problem) -> tuple[Problem, Fit]:
    """The fit in units of the noise that it leaves itself."""
    this = fit_nominal(problem)
    problem = replace(problem, noise=noise_of(problem.runs, problem.residuals(this.vector, this.active)))
    this = fit_nominal(problem)
    drifting = without_drift(problem, this)
    return (problem, this) if drifting is None else (drifting, fit_nominal(drifting))


def _mistaken(given: Sequence[Recording], model: Model, problem: Problem, left: Statistics) -> Iterator[str]:
    """A unit, sign or gear that is plainly wrong, without which most of what is left goes."""
    faults, right = plain_faults(given, model) if not model.drive.coefficients else ([], given)
    if faults:
        undone = replace(prepare(inspected(right)[0], model), noise=problem.noise)
        without = statistics(undone, fit_nominal(undone)).variance / left.variance
        if without < MOST:
            said = " and ".join(fault.meaning for fault in faults)
            goes = f"{100.0 * (1.0 - without):.2g} % of the squared error goes"
            yield f"{said}: undone, {goes}; correct it, or let rwn diagnose what is beneath"


def _describes_nothing(explained: Sequence[ExplainedSignal], coloured: Collection[str]) -> Iterator[str]:
    """Of no signal half, or of one nothing though it is more than noise; a position adds up what is missing."""
    shares = [row.explained if np.isfinite(row.explained) else -np.inf for row in explained]
    if shares and max(shares) < DESCRIBES:
        most = f"{100.0 * max(shares):.2g} %" if max(shares) > 0.0 else "nothing"
        yield f"the fitted model explains {most} of the variance of any recorded signal: {CHECK}"
        return
    structured = [row for row in explained if row.signal in coloured and row.signal != "position"]
    for row in [row for row in structured if not row.explained > 0.0][:1]:
        yield f"the fitted model explains nothing of the variance of the {row.signal} of {row.recording}: {CHECK}"


def _ended_at_limits(parameters: Mapping[str, Estimate]) -> Iterator[str]:
    limits = [name for name, e in parameters.items() if "." not in name and e.value != 0.0 and at_a_bound(e)]
    if limits:
        yield (
            f"{' and '.join(limits).replace('_', ' ')} ran to the end of the search, a thousand times the given value "
            f"or a thousandth: {CHECK}"
        )


def at_a_bound(value: Estimate) -> bool:
    """Whether its interval ends at it, as it does where it is cut at a bound alone."""
    return value.interval is not None and any(math.isclose(value.value, end, rel_tol=CUT) for end in value.interval)


def _unseen(this: Fit, left: Statistics) -> tuple[str, ...]:
    """What is as unsure as it was declared to be, and where it was; of what nothing was declared, what may be 0."""
    spread, moves = deviations(this, left), this.moves
    rows = []
    for u, value, std in zip(this.hypothesis.unknowns, this.minimum.values, spread, strict=True):
        size = abs(value) if u.logarithmic else abs(u.prior or 0.0)  # of what the declared deviation is a part
        declared = u.prior_std * size if np.isfinite(u.prior_std) and size else 0.0
        nothing = std > NOTHING_LEARNED * declared if declared else std > abs(value) > 0.0
        if not u.nuisance and nothing and moves.get(u.name, 0.0) <= BELIEVABLE:
            rows.append(u.name)
    return tuple(rows)
