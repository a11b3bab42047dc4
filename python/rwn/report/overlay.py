"""A recording as it was measured, and models in free run over it, drawn as the report draws them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rwn.errors import InputError, unrecognised
from rwn.identify import Identification
from rwn.model.files import model_of
from rwn.model.model import Model
from rwn.model.recordings import read_recordings
from rwn.recording.recording import Recording, read_recording
from rwn.recording.signals import MEASURED, SIGNALS, si_unit
from rwn.report.diagnosis import Diagnosis
from rwn.report.plot import Plot, Role, Trace
from rwn.report.plots import drawn
from rwn.report.thinning import thin_line
from rwn.report.time_figures import Compared, FreeRun, panels_of
from rwn.simulate.simulation import Simulation, simulate
from rwn.values import SHOWN_BY

if TYPE_CHECKING:
    import plotly.graph_objects

Drawn = Model | Identification | str | Path

# Lines and errors of models in their order, as in a report: the last stands out.
_ROLES: tuple[tuple[Role, Role], ...] = (("nominal", "nominal"), ("refitted", "before"), ("corrected", "after"))


def plot(
    recording: Any,
    models: Mapping[str, Drawn] | Sequence[Drawn] | Drawn | None = None,
    *,
    signal: str | None = None,
) -> plotly.graph_objects.Figure:
    """The signals of a recording over time; with `models`, one signal, what each makes of the input, and the errors.

    `recording`: a recording, a path, a table in Python or a simulation; the result of `identify` alone is drawn over
    what it was fitted to. `models`: one or at most three, by the names that they are
    shown with or in a list, each a model, its file or the result of `identify`. `signal`: what is compared, else the
    speed where it was recorded.

    Raises InputError where a recording does not fit a model, there is no such signal, or plotly is not installed.
    """
    if isinstance(recording, Diagnosis):
        raise InputError("this is a diagnosis", where="plot", expected="a recording", fix="call its method plot()")
    if isinstance(recording, Model):
        fix = "pass the recording, then the model"
        raise InputError("this is a model", where="plot", expected="a recording", fix=fix)
    if isinstance(recording, Identification):
        if models is None:
            models = {"fitted": recording}
        recording = next(iter(recording.recordings), None)
    if isinstance(recording, Simulation):
        recording = Recording(
            name="simulation", time=recording.time, signals=recording.signals, linear=recording.linear
        )
    named = _named(models)
    if len(named) > len(_ROLES):
        raise InputError(f"{len(named)} models are given", where="plot", expected="at most three",
                         fix="draw them in several figures")  # fmt: skip
    if not named:
        shown = recording if isinstance(recording, Recording) else read_recording(recording)
        return drawn(_signals(shown, signal), shown.name)
    read = {name: m.model if isinstance(m, Identification) else model_of(m) for name, m in named.items()}
    (run,) = read_recordings([recording], next(iter(read.values())))
    return drawn(_compared(run, read, signal), run.name)


def _as_method(what: Any, *others: Any, **options: Any) -> plotly.graph_objects.Figure:
    """`what.plot(..)`: of a model over the first of `others`."""
    if isinstance(what, Model) and others:
        return plot(others[0], [what, *others[1:]], **options)
    return plot(what, list(others) or None, **options)


SHOWN_BY["plot"] = _as_method


def _named(models: Mapping[str, Drawn] | Sequence[Drawn] | Drawn | None) -> Mapping[str, Drawn]:
    """The models by name: those that have none are called as their files, or "model"."""
    if models is None or isinstance(models, Mapping):
        return models or {}
    listed = list(models) if isinstance(models, list | tuple) else [models]
    named: dict[str, Any] = {}
    for one in listed:
        of_file = one if isinstance(one, str | Path) else getattr(getattr(one, "model", one), "source", "")
        name = Path(of_file).name or "model"
        named[name if name not in named else f"{name} ({len(named) + 1})"] = one
    return named


def _signals(run: Recording, wanted: str | None) -> list[Plot]:
    """A panel for each signal; what was not measured breaks its line."""
    names = [_known(wanted, run.signals)] if wanted else list(run.signals)
    if not names or not len(run):
        raise InputError("there is nothing to draw", where=run.name, expected="time and a signal", fix="record one")
    measured = {name: _measured(run, name) for name in names}
    kept = thin_line(list(measured.values()))
    return [
        Plot(
            slot="response" if name in MEASURED else "input", title=name, x_label="time", x_unit="s", y_label=name,
            y_unit=si_unit(SIGNALS[name], run.linear), recording=run.name,
            traces=(Trace(name=name, role="measured", x=run.time[kept], y=values[kept]),),
        )
        for name, values in measured.items()
    ]  # fmt: skip


def _compared(run: Recording, models: Mapping[str, Model], wanted: str | None) -> list[Plot]:
    driven = next(iter(models.values())).drive.input
    simulated = {name: simulate(model, run) for name, model in models.items()}
    common = [s for s in MEASURED if s in run.signals and all(s in made.signals for made in simulated.values())]
    signal = _known(wanted, common) if wanted else ("speed" if "speed" in common else common[-1])
    runs = [
        FreeRun(
            name=name if made.status == "ok" else f"{name} ({made.status})", role=line, error=error,
            values=made.signals[signal],
        )
        for (name, made), (line, error) in zip(simulated.items(), _ROLES[-len(models) :], strict=True)
    ]  # fmt: skip
    compared = Compared(
        recording=run.name, time=run.time, driven=driven, input=run.signals[driven], signal=signal,
        measured=_measured(run, signal), left_out=_missing(run, signal),
    )  # fmt: skip
    return panels_of(compared, runs, None, linear=run.linear)


def _known(signal: str, there: Mapping[str, Any] | list[str]) -> str:
    if signal not in there:
        raise unrecognised("signal", signal, there, where="plot")
    return signal


def _missing(run: Recording, signal: str) -> NDArray[np.bool_]:
    return run.missing.get(signal, np.zeros(len(run), dtype=bool))


def _measured(run: Recording, signal: str) -> NDArray[np.float64]:
    return np.where(_missing(run, signal), np.nan, run.signals[signal])
