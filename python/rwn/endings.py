"""How a command ends: done, refused in one line, without a result, or stopped by Ctrl-C."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
import warnings
from collections.abc import Callable
from types import FrameType
from typing import Any, NoReturn

import typer

from rwn.errors import NoResultError, plain

REFUSED = 2  # exit code of bad input
NO_RESULT = 3  # exit code of a computation that ran and has no result to stand by
STOPPED = 130  # exit code after Ctrl-C
_SOON = 0.02  # s; shorter than anybody notices, longer than what is called when an object goes


class _CtrlC:
    """The first is an exception, so that what is half written is removed; the second ends the process as it is.

    Those after it, and any once the first has been answered, find an end that is under way and change nothing.
    """

    def __init__(self) -> None:
        self.pressed = False

    def __call__(self, _number: int, _frame: FrameType | None) -> None:
        if self.pressed:
            _stopped()
            os._exit(STOPPED)
        self.pressed = True
        raise KeyboardInterrupt

    def listen(self) -> None:
        """From here on it answers Ctrl-C, and so it does where Python passes over the exception.

        That happens in what is called when an object goes (weak references of the imports, __del__): the exception is
        raised again when they are done.
        """
        signal.signal(signal.SIGINT, self)
        signal.signal(signal.SIGALRM, self._raise_again)
        before = sys.unraisablehook

        def passed_over(about: sys.UnraisableHookArgs) -> None:
            if issubclass(about.exc_type, KeyboardInterrupt):
                signal.setitimer(signal.ITIMER_REAL, _SOON)
            else:
                before(about)

        sys.unraisablehook = passed_over

    @staticmethod
    def _raise_again(_number: int, _frame: FrameType | None) -> None:
        raise KeyboardInterrupt


def run(command: Callable[[], Any]) -> NoReturn:
    """Runs a typer command and ends the process with its exit code."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by who started it: `rwn effects >&-`
            setattr(sys, name, os.fdopen(os.open(os.devnull, os.O_WRONLY), "w"))
    ctrl_c = _CtrlC()
    if threading.current_thread() is threading.main_thread():
        ctrl_c.listen()
    try:
        with warnings.catch_warnings():
            # of an overflow, say, in a simulation that runs away: what comes of it is said in our words
            warnings.simplefilter("ignore", RuntimeWarning)
            status = command()
    except (typer.Abort, KeyboardInterrupt):
        status = STOPPED
    except NoResultError as error:
        print(f"rwn: {error} Nothing was written.", file=sys.stderr)
        status = NO_RESULT
    except Exception as error:
        # an import that Ctrl-C cut short fails in other words, and so does what asked for it
        if not ctrl_c.pressed:
            _refuse(error)
        status = STOPPED
    if status == STOPPED:
        _stopped()
        if threading.active_count() > 1:
            os._exit(STOPPED)  # what still computes in threads would be waited for
    sys.exit(status if isinstance(status, int) else 0)


def _stopped() -> None:
    """Says so, once: past the streams of Python, which may be in the middle of a line when a signal comes."""
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.setitimer(signal.ITIMER_REAL, 0.0)
    with contextlib.suppress(OSError, ValueError):  # closed, by who started it or since
        os.write(sys.stderr.fileno(), b"rwn: stopped\n")


def _what_is_missing(error: Exception) -> str:
    """What an option or argument that was not given is for, in the words of --help."""
    about = getattr(getattr(error, "param", None), "help", None)
    if not about or type(error).__name__ != "MissingParameter":
        return ""
    first = about[0] if about[1:2].isupper() else about[0].lower()  # an abbreviation stays as it is
    return f"; expected {first}{about[1:].rstrip('.')}"


def _refuse(error: Exception) -> NoReturn:
    """One line for what the user can mend; anything else is a defect of ours and keeps its traceback."""
    usage_error = hasattr(error, "format_message")  # what typer raises for wrong usage has it
    if os.environ.get("RWN_TRACEBACK") or not (usage_error or isinstance(error, ValueError | OSError)):
        raise error
    if hasattr(error, "format_message"):
        if error.format_message().startswith("Usage:"):  # a group called without a command: its help, as it is
            print(error.format_message(), file=sys.stderr)
            sys.exit(REFUSED)
        usage = getattr(getattr(error, "ctx", None), "command_path", "rwn")
        text = f"{error.format_message().rstrip('.')}{_what_is_missing(error)}; fix: see {usage} --help"
    elif isinstance(error, OSError) and error.filename is not None:
        text = f"{error.filename}: {error.strerror}; expected a file in reach; fix: check path, permissions, disk space"
    else:
        text = str(error)
    print("rwn: " + plain(" ".join(text.split()), longest=4000), file=sys.stderr)
    sys.exit(REFUSED)
