"""Files of trials that were damaged: whatever their readers make of them is one line that names the file."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rwn.errors import InputError


@contextmanager
def reading(path: Path) -> Iterator[None]:
    """Raises InputError with the place for what a damaged file makes its readers raise within the block, and before it
    where it is a pipe or a device, which never ends."""
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise InputError(
            "this is not a regular file", where=path, expected="what rwn trials wrote there", fix="remove it"
        )
    try:
        yield
    except InputError:
        raise
    except (ValueError, LookupError, TypeError, AttributeError, EOFError, OSError, RecursionError, zlib.error) as error:
        if isinstance(error, OSError) and error.filename is not None:
            raise
        raise refused(path, f"this cannot be read ({type(error).__name__}: {error})") from error


def refused(path: Path, what: str) -> InputError:
    """The error for what is wrong with a file of trials."""
    return InputError(
        what,
        where=path,
        expected="what rwn trials wrote there",
        fix="copy it again; or remove it, and rwn trials run or make writes it anew",
    )
