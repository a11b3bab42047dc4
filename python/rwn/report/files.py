"""Results appear whole or not at all: they are written aside and moved into place."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rwn.errors import InputError


@contextmanager
def output_folder(path: Path, *, overwrite: bool = False) -> Iterator[Path]:
    """A temporary folder whose files are moved to `path` when the block ends without an error.

    Raises InputError before the block when `path` cannot be written, or holds files and `overwrite` is false.
    """
    if path.exists() and not path.is_dir():
        raise InputError(
            "this is a file", where=path, expected="a folder for the results", fix="choose another --out"
        )
    if path.is_dir() and any(path.iterdir()) and not overwrite:
        raise InputError(
            "the output folder exists and is not empty",
            where=path,
            expected="a new or empty folder",
            fix="choose another --out, or add --overwrite",
        )
    _check_writable(path)
    with tempfile.TemporaryDirectory(prefix="rwn-") as aside:
        yield Path(aside)
        path.mkdir(parents=True, exist_ok=True)
        for file in sorted(Path(aside).iterdir()):
            shutil.move(file, path / file.name)


@contextmanager
def output_file(path: Path, *, overwrite: bool = False) -> Iterator[Path]:
    """As `output_folder`, for one file."""
    if path.is_dir():
        raise InputError(
            "this is a folder", where=path, expected="a file name", fix=f"write {path / 'result'}"
        )
    if path.exists() and not overwrite:
        raise InputError(
            "the output file exists",
            where=path,
            expected="a new file",
            fix="choose another --out, or add --overwrite",
        )
    _check_writable(path)
    with tempfile.TemporaryDirectory(prefix="rwn-") as aside:
        yield Path(aside) / path.name
        path.parent.mkdir(parents=True, exist_ok=True)
        shutil.move(Path(aside) / path.name, path)


def _check_writable(path: Path) -> None:
    there = next(p for p in (path, *path.absolute().parents) if p.exists())
    try:
        if there.is_dir():
            tempfile.TemporaryFile(dir=there).close()  # permissions alone do not tell (root, /proc, full disk)
        elif there != path or not os.access(there, os.W_OK):
            raise NotADirectoryError
    except OSError as error:
        raise InputError(
            f"{there} cannot be written",
            where=path,
            expected="a place to write to",
            fix="choose another --out",
        ) from error
