"""Which files a result was made from."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from rwn.recording.formats.part import file_and_part
from rwn.recording.recording import Recording
from rwn.report.diagnosis_data import Source


def sources(model: object, fitted: Sequence[Recording], heldout: Sequence[Recording]) -> tuple[Source, ...]:
    """The files that a diagnosis was made of: none for a model that is no path, and for recordings made in Python."""
    of_model = [source(Path(model), "model")] if isinstance(model, str | Path) else []
    return (
        *of_model,
        *(source(r, "fit") for r in fitted if _of_a_file(r)),
        *(source(r, "heldout") for r in heldout if _of_a_file(r)),
    )


def _of_a_file(this: Recording) -> bool:
    return bool(this.source) and file_and_part(Path(this.source))[0].is_file()


def source(item: Recording | Path, use: Literal["model", "fit", "heldout"]) -> Source:
    """A recording, or the path of a model file, with the hash of its bytes."""
    path = Path(item.source) if isinstance(item, Recording) else item
    with file_and_part(path)[0].open("rb") as file:
        digest = hashlib.file_digest(file, "sha256").hexdigest()
    if isinstance(item, Recording):
        return Source(path=str(path), use=use, samples=len(item), duration=item.duration, sha256=digest)
    return Source(path=str(path), use=use, sha256=digest)
