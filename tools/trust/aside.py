"""Temporary folders of the commands of trust that do not stay behind: the next start removes those of killed ones.

As rwn's own beside results (report/output_files.py), but without importing rwn, which must not be loaded before it is
altered.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


def new_folder(kind: str) -> Path:
    """A new one, rwn-`kind`-PROCESS-..., which whoever asks for it removes; those of processes that ended are."""
    sweep(kind)
    return Path(tempfile.mkdtemp(prefix=f"rwn-{kind}-{os.getpid()}-"))


@contextmanager
def folder_aside(kind: str) -> Iterator[Path]:
    """As `new_folder`, gone when the block ends."""
    made = new_folder(kind)
    try:
        yield made
    finally:
        shutil.rmtree(made, ignore_errors=True)


def sweep(kind: str) -> None:
    """Removes the folders of processes that are no more."""
    begins = f"rwn-{kind}-"
    for left in Path(tempfile.gettempdir()).glob(f"{begins}*-*"):
        process = left.name.removeprefix(begins).split("-")[0]
        if process.isdigit() and not Path(f"/proc/{process}").exists() and Path("/proc/self").exists():
            shutil.rmtree(left, ignore_errors=True)
