"""When, from what and on what a result was made."""

from __future__ import annotations

import os
import platform
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

import numpy as np

from rwn import _core

PACKAGE = (":/python", ":/cpp")  # where an alteration may change a result of the package
TESTS = (":/tests", ":/tools")  # where one may change a figure of its tests


@dataclass(frozen=True, kw_only=True)
class Made:
    """date: of the day, UTC.  commit: of the source tree, with + where it was changed, or the version of the package.
    machine: processor, cores, instruction set, Python and numpy."""

    date: str
    commit: str
    machine: str


@cache
def made(source: Path = Path(__file__), *, also: tuple[str, ...] = ()) -> Made:
    """Here and now.

    `source`: a file of the tree whose commit it is, where the package is an installed copy of that. `also`: what counts
    as altered beside the package.
    """
    day, commit = datetime.now(UTC).strftime("%Y-%m-%d"), _commit(source, (*PACKAGE, *also))
    return Made(date=day, commit=commit, machine=_machine())


def _commit(source: Path, sources: Sequence[str] = PACKAGE) -> str:
    here = source.parent

    def git(*words: str) -> str:
        answer = subprocess.run(["git", *words], cwd=here, capture_output=True, text=True, check=False)
        return answer.stdout.strip() if answer.returncode == 0 else ""

    try:
        tracked = git("ls-files", "--error-unmatch", source.name)
        head = git("rev-parse", "--short", "HEAD") if tracked else ""
        changed = git("status", "--porcelain", "--untracked-files=no", "--", *sources)
    except FileNotFoundError:  # no git here
        head, changed = "", ""
    return f"{head}{'+' if changed else ''}" if head else f"rwn {_core.__version__}"


def _machine() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        cpu = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        cpu = platform.processor() or platform.machine()
    return f"{cpu}, {os.cpu_count()} cores, {_core.isa()}, Python {platform.python_version()}, numpy {np.__version__}"
