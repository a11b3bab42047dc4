"""Models, fits and recordings as the files that rwn reads."""

from __future__ import annotations

from pathlib import Path

from rwn.errors import InputError, NoResultError
from rwn.identify import Identification
from rwn.input_file import path_of
from rwn.model.files import write_model
from rwn.model.model import Model
from rwn.recording.recording import Recording, write_csv
from rwn.report.files import output_file


def save(what: Model | Identification | Recording, path: str | Path, *, overwrite: bool = False) -> None:
    """Write `what` to the file `path`.

    A model, or the one that `identify` fitted, for `read_model`; a recording, as CSV, for `read_recording`.

    A recording is written in the units of its source, with 9 digits. A diagnosis has a `save` of its own.

    Raises InputError where the file exists and `overwrite` is false, it cannot be written, or it is nothing of these;
    NoResultError where the identification failed.
    """
    if not isinstance(what, Model | Identification | Recording):
        raise InputError(f"a {type(what).__name__} has no file of its own", where=path,
                         expected="a model, the result of identify, or a recording",
                         fix="save a diagnosis by its method save")  # fmt: skip
    if isinstance(what, Identification) and what.failure:
        raise NoResultError(what.status, what.failure, where="rwn.save")
    made_from = what.sources if isinstance(what, Identification) else ()
    if isinstance(what, Recording) and what.source:
        made_from = (what.source,)
    inputs = [Path(source) for source in made_from]
    with output_file(path_of(path, "file.toml"), overwrite=overwrite, inputs=inputs) as aside:
        if isinstance(what, Recording):
            write_csv(aside, what.time, what.signals, linear=what.linear, units=what.units)
        else:
            write_model(what.model if isinstance(what, Identification) else what, aside)
