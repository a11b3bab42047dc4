"""The command `rwn` before rwn is imported: importing takes most of a second, in which Ctrl-C is pressed too.

A package of its own, since Python imports `rwn`, and NumPy with it, before any module of it runs.
"""

from __future__ import annotations

import os
import signal
from types import FrameType

STOPPED = 130  # exit code of Ctrl-C, as in rwn.endings


def main() -> None:
    """The entry point."""
    end_at_ctrl_c()
    from rwn.cli import main as command  # from here on rwn.endings handles Ctrl-C

    command()


def end_at_ctrl_c() -> None:
    """While rwn is imported nothing is written, so the process may end where it is."""
    signal.signal(signal.SIGINT, _stop)


def _stop(_number: int, _frame: FrameType | None) -> None:
    os.write(2, b"rwn: stopped\n")
    os._exit(STOPPED)
