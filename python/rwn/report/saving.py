"""Models, fits and recordings as the files that rwn reads."""

from __future__ import annotations

from pathlib import Path

from rwn.errors import InputError, NoResultError
from rwn.identify import Identification
from rwn.input_file import path_of
from rwn.model.files import write_model
from rwn.model.model import Model
from rwn.recording.recording import Recording, write_csv
from rwn.report.output_files import output_file
from rwn.simulate.simulation import Simulation
from rwn.values import SHOWN_BY


def save(what: Model | Identification | Recording | Simulation, path: str | Path, *, overwrite: bool = False) -> None:
    """Write `what` to the file `path`.

    A model, or the one that `identify` fitted, for `read_model` (.toml); a recording or a simulation for
    `read_recording` (.csv).

    A recording is written in the units of its source, with 9 digits. A diagnosis has a `save` of its own.

    Raises InputError where the file exists and `overwrite` is false, it cannot be written, or it is nothing of these;
    NoResultError where the identification failed.
    """
    if not isinstance(what, Model | Identification | Recording | Simulation):
        raise InputError(f"a {type(what).__name__} has no file of its own", where=path,
                         expected="a model, the result of identify or simulate, or a recording",
                         fix="save a diagnosis by its method save")  # fmt: skip
    if isinstance(what, Identification) and what.failure:
        raise NoResultError(what.status, what.failure, where="rwn.save")
    ending = ".csv" if isinstance(what, Recording | Simulation) else ".toml"
    path = path_of(path, f"file{ending}")
    if path.suffix.lower() != ending:
        raise InputError(f"a {type(what).__name__} is written as {ending}", where=path, expected=f"a name in {ending}",
                         fix=f"write {path.with_suffix(ending).name}")  # fmt: skip
    with output_file(path, overwrite=overwrite, inputs=[Path(source) for source in _made_from(what)]) as aside:
        if isinstance(what, Recording | Simulation):
            units = what.units if isinstance(what, Recording) else {}
            write_csv(aside, what.time, what.signals, linear=what.linear, units=units)
        else:
            write_model(what.model if isinstance(what, Identification) else what, aside)


def _made_from(what: Model | Identification | Recording | Simulation) -> list[str]:
    """The files that it would lose if it replaced them: a model that was read may be edited, a recording not."""
    if isinstance(what, Identification):
        return [source for source in (what.model.source, *(r.source for r in what.recordings)) if source]
    return [what.source] if isinstance(what, Recording) and what.source else []


SHOWN_BY["save"] = save
