"""Which files a result was made from."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Literal

from rwn.recording.formats.part import file_and_part
from rwn.recording.recording import Recording
from rwn.report.diagnosis_data import Source


def source(item: Recording | Path, use: Literal["model", "fit", "heldout"]) -> Source:
    """A recording, or the path of a model file, with the hash of its bytes."""
    path = Path(item.source) if isinstance(item, Recording) else item
    with file_and_part(path)[0].open("rb") as file:
        digest = hashlib.file_digest(file, "sha256").hexdigest()
    if isinstance(item, Recording):
        return Source(path=str(path), use=use, samples=len(item), duration=item.duration, sha256=digest)
    return Source(path=str(path), use=use, sha256=digest)
