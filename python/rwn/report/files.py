"""Results appear whole or not at all: they are written beside their place and moved into it."""

from __future__ import annotations

import errno
import os
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from rwn.errors import InputError
from rwn.recording.formats.part import file_and_part

_ASIDE = ".rwn-"  # then the process that writes there
RESULTS = ("report.html", "diagnosis.json", "corrected.toml")


@contextmanager
def output_folder(path: Path, *, overwrite: bool = False, inputs: Sequence[Path] = ()) -> Iterator[Path]:
    """A temporary folder whose files are moved to `path` when the block ends without an error.

    It lies on the same disk, so that moving needs no room and old results stay until new ones are whole. Raises
    InputError before the block when `path` cannot be written, or holds files and `overwrite` is false; or when a result
    would replace one of the `inputs`.
    """
    path = _without_detours(path)
    check_folder(path)
    for name in RESULTS:
        _refuse_input(path / name, inputs)
        if (path / name).is_dir():
            raise _is_a_folder(path / name)
    there = _existing(path)
    if path.is_dir() and any(path.iterdir()) and not overwrite:
        raise InputError(
            "the output folder exists and is not empty",
            where=path,
            expected="a new or empty folder",
            fix="choose another --out, or add --overwrite",
        )
    with _aside(there, path) as aside:
        yield aside
        path.mkdir(parents=True, exist_ok=True)
        for made in sorted(aside.iterdir()):
            if (path / made.name).is_dir():
                shutil.rmtree(path / made.name)  # a folder takes the place of an empty one only
            made.replace(path / made.name)


@contextmanager
def output_file(path: Path, *, overwrite: bool = False, inputs: Sequence[Path] = ()) -> Iterator[Path]:
    """As `output_folder`, for one file. Nothing appears where the block writes none. Raises InputError."""
    path = _without_detours(path)
    check_file(path)
    _refuse_input(path, inputs)
    if path.exists() and not overwrite:
        raise InputError(
            "the output file exists",
            where=path,
            expected="a new file",
            fix="choose another --out, or add --overwrite",
        )
    there = _existing(path.parent)
    with _aside(there, path) as aside:
        yield aside / path.name
        if (aside / path.name).exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            (aside / path.name).replace(path)


def check_folder(path: Path) -> None:
    """Raises InputError where `path` neither is a folder that can be written nor can become one."""
    _refuse_dangling(path)
    if path.exists() and not path.is_dir():
        raise InputError(
            "this is a file", where=path, expected="a folder for the results", fix="choose another --out"
        )
    _try(_existing(path), path)


def check_file(path: Path) -> None:
    """Raises InputError where `path` neither is a regular file that can be written nor can become one."""
    _refuse_dangling(path)
    if path.is_dir():
        raise _is_a_folder(path)
    if path.exists() and not path.is_file():
        raise InputError(
            "this is not a regular file", where=path, expected="a file to write", fix="choose another one"
        )
    _try(_existing(path.parent), path)


def _without_detours(path: Path) -> Path:
    """`new/../a.csv` is a.csv, which is seen only once `new` has been made."""
    return Path(os.path.realpath(path)) if ".." in path.parts else path


def _is_a_folder(path: Path) -> InputError:
    return InputError("this is a folder", where=path, expected="a file name", fix=f"write {path / 'result'}")


def _refuse_input(path: Path, inputs: Sequence[Path]) -> None:
    files = [file_and_part(given)[0] for given in inputs]
    if any(path.exists() and given.exists() and path.samefile(given) for given in files):
        raise InputError(
            "the result would replace an input",
            where=path,
            expected="an output that is no input",
            fix="choose another --out",
        )


def _refuse_dangling(path: Path) -> None:
    if path.is_symlink() and not path.exists():
        raise InputError(
            "this link leads nowhere",
            where=path,
            expected="a place to write to",
            fix="remove it, or choose another --out",
        )


def _existing(path: Path) -> Path:
    """The folder itself, or the nearest above it that exists. Raises InputError where that is no folder."""
    there = next(p for p in (path, *path.absolute().parents) if p.exists())
    if not there.is_dir():
        raise _not_writable(there, path)
    return there


def _not_writable(there: Path, path: Path) -> InputError:
    return InputError(
        f"{there} cannot be written", where=path, expected="a place to write to", fix="choose another --out"
    )


@contextmanager
def _aside(there: Path, path: Path) -> Iterator[Path]:
    """A folder in `there` that is gone after the block; a full disk is said with the place of the result."""
    try:
        aside = Path(tempfile.mkdtemp(prefix=f"{_ASIDE}{os.getpid()}-", dir=there))
    except OSError as error:  # permissions alone do not tell (root, /proc, full disk)
        raise _not_writable(there, path) from error
    try:
        yield aside
    except OSError as error:
        of_inputs = error.filename is not None and not Path(error.filename).is_relative_to(aside)
        if of_inputs or error.errno not in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
            raise
        raise InputError(
            f"{error.strerror or error}; what was there is as it was",
            where=path,
            expected="room for the results",
            fix="free some, or choose another --out",
        ) from error
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def _try(there: Path, path: Path) -> None:
    """Whether something can be written; what killed processes have left in the folder is removed first."""
    _sweep(there)
    with _aside(there, path):
        pass


def _sweep(there: Path) -> None:
    """Removes what processes that were killed have left in a folder."""
    for left in there.glob(f"{_ASIDE}*-*"):
        process = left.name.removeprefix(_ASIDE).split("-")[0]
        if process.isdigit() and not Path(f"/proc/{process}").exists() and Path("/proc/self").exists():
            shutil.rmtree(left, ignore_errors=True)
