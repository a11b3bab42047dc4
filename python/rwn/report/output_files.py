"""Results appear whole or not at all: they are written beside their place and moved into it."""

from __future__ import annotations

import errno
import fcntl
import os
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from rwn.errors import InputError
from rwn.recording.formats.part import file_and_part
from rwn.report.exchange import HALF, OLD, RESULT, RESULTS, exchange, go_on, waits

_ASIDE = ".rwn-"  # then the process that writes there


@contextmanager
def output_folder(path: Path, *, overwrite: bool = False, inputs: Sequence[Path] = ()) -> Iterator[Path]:
    """A temporary folder whose files are moved to `path` when the block ends without an error.

    It lies on the same disk, so that moving needs no room and old results stay until new ones are whole. Of a process
    that is killed while it moves them, diagnosis.json is missing until another begins here. Raises InputError before
    the block when `path` cannot be written, is written by another process, or holds files and `overwrite` is false; or
    when a result would replace one of the `inputs`.
    """
    path = _without_detours(path)
    check_folder(path)
    for name in RESULTS:
        _refuse_input(path / name, inputs)
        if (path / name).is_dir():
            raise _is_a_folder(path / name)
    with _alone_in(path):
        if any(path.iterdir()) and not overwrite:
            raise InputError(
                "the output folder exists and is not empty",
                where=path,
                expected="a new or empty folder",
                fix="choose another --out, or add --overwrite (in Python overwrite=True)",
            )
        with _aside(path, path) as aside:
            yield aside / HALF
            exchange(aside, path)


@contextmanager
def _alone_in(path: Path) -> Iterator[None]:
    """A folder that no other process writes its results to meanwhile; made, and gone again where nothing is in it.

    Raises InputError where another one does.
    """
    made = [folder for folder in (path, *path.parents) if not folder.exists()]
    path.mkdir(parents=True, exist_ok=True)
    opened = os.open(path, os.O_RDONLY)
    try:
        with suppress(OSError):  # where the file system has no locks
            try:
                fcntl.flock(opened, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                made = []
                raise _occupied(path) from None
        yield
    finally:
        for folder in made:
            with suppress(OSError):  # it holds the results
                folder.rmdir()
        os.close(opened)


def _occupied(path: Path) -> InputError:
    return InputError(
        "another rwn is writing its results here",
        where=path,
        expected="one at a time",
        fix="wait for it, or choose another --out",
    )


@contextmanager
def one_result(folder: Path) -> Iterator[None]:
    """Raises InputError where what is read in the block need not be the files of one result."""
    result = folder / RESULT
    before = _identity(result)
    if before is None and any(waits(aside) for aside in folder.glob(f"{_ASIDE}*-*")):
        raise _replaced(folder)
    yield
    if _identity(result) != before:
        raise _replaced(folder)


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
            fix="choose another --out, or add --overwrite (in Python overwrite=True)",
        )
    there = _existing(path.parent)
    with _aside(there, path) as aside:
        yield aside / HALF / path.name
        if (aside / HALF / path.name).exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            (aside / HALF / path.name).replace(path)


def check_folder(path: Path) -> None:
    """Raises InputError where `path` neither is a folder that can be written nor can become one."""
    _refuse_dangling(path)
    if path.exists() and not path.is_dir():
        raise InputError(
            "this is a file", where=path, expected="a folder for the results", fix="choose another --out"
        )
    if path.parent.is_dir():
        _sweep(path.parent)  # there the process wrote while the folder was not there
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


def _identity(path: Path) -> tuple[int, int] | None:
    """Another one after each move."""
    try:
        at = path.stat()
    except OSError:
        return None
    return at.st_ino, at.st_ctime_ns


def _replaced(folder: Path) -> InputError:
    return InputError(
        "this result is being replaced, or was when a process was killed",
        where=folder,
        expected="the files of one result",
        fix="wait for it, or diagnose again with --overwrite",
    )


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
        for name in (HALF, OLD):
            (aside / name).mkdir()
    except OSError as error:  # permissions alone do not tell (root, /proc, full disk)
        raise _not_writable(there, path) from error
    try:
        yield aside
    except OSError as error:
        named = [name for name in (error.filename, error.filename2) if name is not None]
        of_inputs = named and not any(Path(name).is_relative_to(aside) for name in named)
        if of_inputs or error.errno not in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
            raise
        raise InputError(
            f"{error.strerror or error}; what was there is as it was",
            where=path,
            expected="room for the results",
            fix="free some, or choose another --out",
        ) from error
    finally:
        if not waits(aside):
            shutil.rmtree(aside, ignore_errors=True)


def _try(there: Path, path: Path) -> None:
    """Whether something can be written; what killed processes have left in the folder is removed first."""
    _sweep(there)
    with _aside(there, path):
        pass


def _sweep(there: Path) -> None:
    """Removes what processes that were killed have left in a folder, after it has ended what they were about to."""
    for left in there.glob(f"{_ASIDE}*-*"):
        process = left.name.removeprefix(_ASIDE).split("-")[0]
        if process.isdigit() and not Path(f"/proc/{process}").exists() and Path("/proc/self").exists():
            with suppress(OSError):
                mine = left.replace(there / left.name.replace(process, str(os.getpid()), 1))  # one of two gets it
                if waits(mine):
                    go_on(mine, there)
                shutil.rmtree(mine)
