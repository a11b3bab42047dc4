"""Files that are given to be read: what is none is refused in one line, and is not opened."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rwn.errors import InputError, plain

_WILDCARDS = frozenset("*?")
_NO_MATCH = "no file has this name: a shell expands wildcards, and only without quotes"


@contextmanager
def input_file(path: Path, expected: str) -> Iterator[None]:
    """Raises InputError where `path` is a folder, a pipe or a device (they never end), or cannot be read in the block.

    `expected`: what it should be, "a recording file".
    """
    try:
        if path.is_dir():
            raise InputError("this is a folder", where=path, expected=expected, fix="name the file in it")
        if not path.is_file():
            path.stat()  # says why, where there is nothing
            raise InputError(
                "this is not a regular file",
                where=path,
                expected=expected,
                fix="save what it holds to a file first",
            )
        yield
    except OSError as error:
        missing = isinstance(error, FileNotFoundError)
        raise InputError(
            f"cannot read the file ({(error.strerror or str(error)).lower()})",
            where=path,
            expected=expected,
            fix=_NO_MATCH if missing and _WILDCARDS & set(str(path)) else "check the path and its permissions",
        ) from error


def path_of(given: object, example: str) -> Path:
    """A path, of text or of one. Raises InputError where it is neither."""
    if isinstance(given, str | os.PathLike):
        return Path(given)
    raise InputError(
        f"the path is {plain(repr(given), longest=40)}", where=type(given).__name__, expected="a path",
        fix=f'pass for instance "{example}"',
    )  # fmt: skip
