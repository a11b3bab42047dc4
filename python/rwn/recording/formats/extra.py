"""Libraries that a format needs and the base installation leaves out."""

from __future__ import annotations

import importlib
import logging
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from rwn.errors import InputError


@contextmanager
def quiet(logger: str) -> Iterator[None]:
    """Within it a library prints no log of its own: what it cannot read is said once, in our words."""
    names = [name for name in logging.root.manager.loggerDict if name.startswith(f"{logger}.")]
    levels = {name: logging.getLogger(name).level for name in (logger, *names)}  # those below may have their own
    for name in levels:
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for name, level in levels.items():
            logging.getLogger(name).setLevel(level)


def library(module: str, extra: str, where: object) -> Any:
    """The module; raises InputError with the extra that installs it."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # what a library's own imports complain of is not the user's affair
            return importlib.import_module(module)
    except ImportError as error:
        raise InputError(
            f"this kind of file needs {module.split('.')[0]}, which is not installed",
            where=where,
            expected="the extra for it",
            fix=f"pip install 'rwn[{extra}]', or export the recording as CSV",
        ) from error
