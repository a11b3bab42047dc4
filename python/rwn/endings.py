"""How a command ends: done, refused in one line, without a result, or stopped by Ctrl-C."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable
from typing import Any, NoReturn

import typer

from rwn.errors import plain

REFUSED = 2  # exit code of bad input
NO_RESULT = 3  # of a computation that ran and has no result to stand by
STOPPED = 130  # of Ctrl-C


def run(command: Callable[[], Any]) -> NoReturn:
    """Runs a typer command and ends the process with its exit code."""
    try:
        status = command()
    except (ValueError, OSError) as error:
        _refuse(error)
    except typer.Abort:
        status = STOPPED
    except Exception as error:
        if not hasattr(error, "format_message"):  # what typer raises for wrong usage has it
            raise
        _refuse(error)
    if status == STOPPED:
        print("rwn: stopped", file=sys.stderr, flush=True)
        if threading.active_count() > 1:
            os._exit(STOPPED)  # what still computes in threads would be waited for
    sys.exit(status if isinstance(status, int) else 0)


def _refuse(error: Exception) -> NoReturn:
    if os.environ.get("RWN_TRACEBACK"):
        raise error
    if hasattr(error, "format_message"):
        if error.format_message().startswith("Usage:"):  # a group called without a command: its help, as it is
            print(error.format_message(), file=sys.stderr)
            sys.exit(REFUSED)
        usage = getattr(getattr(error, "ctx", None), "command_path", "rwn")
        text = f"{error.format_message().rstrip('.')}; fix: see {usage} --help"
    elif isinstance(error, OSError) and error.filename is not None:
        text = f"{error.filename}: {error.strerror}; expected a file in reach; fix: check path, permissions, disk space"
    else:
        text = str(error)
    print("rwn: " + plain(" ".join(text.split()), longest=4000), file=sys.stderr)
    sys.exit(REFUSED)
