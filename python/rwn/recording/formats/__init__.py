"""File formats of recordings. One file per format and one line in FORMATS; each reads a path into a Table."""

from __future__ import annotations

from collections.abc import Callable, Collection
from pathlib import Path

from rwn.recording.formats.csv import read_csv
from rwn.recording.formats.mat import read_mat
from rwn.recording.formats.table import MAX_BYTES, MAX_SAMPLES, Table

Reader = Callable[[Path, Collection[str]], Table]

FORMATS: dict[str, Reader] = {".csv": read_csv, ".txt": read_csv, ".tsv": read_csv, ".mat": read_mat}

__all__ = ["FORMATS", "MAX_BYTES", "MAX_SAMPLES", "Table"]
