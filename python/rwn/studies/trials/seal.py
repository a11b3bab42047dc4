"""The answers, apart from the trials: one compressed file whose SHA-256 is known before anything is run."""

from __future__ import annotations

import gzip
import hashlib
import json
from pathlib import Path
from typing import Any

from rwn.errors import InputError
from rwn.studies.trials.damaged import reading
from rwn.studies.whole_file import write_whole

ANSWERS = "answers.sealed"
HASH = "answers.sha256"


class SealBrokenError(InputError):
    """The answers are not those whose hash was printed when the trials were made."""


def seal(folder: Path, content: dict[str, Any]) -> str:
    """Writes the sealed answers and their hash; returns the hash. The answers come last: they say that all is done."""
    text = json.dumps(content, sort_keys=True, separators=(",", ":")).encode()
    packed = gzip.compress(text, mtime=0)
    digest = hashlib.sha256(packed).hexdigest()
    write_whole(folder / HASH, f"{digest}  {ANSWERS}\n".encode())
    write_whole(folder / ANSWERS, packed)
    return digest


def unseal(folder: Path) -> dict[str, Any]:
    """Opens the answers; raises SealBrokenError if they do not have the hash written beside them, or none is there."""
    packed = (folder / ANSWERS).read_bytes()
    promised = _promised(folder / HASH)
    found = hashlib.sha256(packed).hexdigest()
    if found != promised:
        raise SealBrokenError(
            f"the SHA-256 is {found}",
            where=folder / ANSWERS,
            expected=f"{promised}, as {HASH} promises",
            fix="copy both files again, or make the trials again from their seed",
        )
    content: dict[str, Any] = json.loads(gzip.decompress(packed))
    return content


def _promised(path: Path) -> str:
    """The hash that was written when the trials were made."""
    with reading(path):
        words = path.read_text(encoding="utf-8").split() if path.exists() else []
    if not words:
        raise SealBrokenError(
            f"this {'is empty' if path.exists() else 'file is missing'}, so that nothing shows the answers unchanged",
            where=path,
            expected=f"the SHA-256 of {ANSWERS}, which rwn trials make wrote there and printed",
            fix="copy it again, or write the printed SHA-256 there",
        )
    return words[0]
