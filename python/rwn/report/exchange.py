"""The files of an old result give way to those of a new one, so that those of both never stand beside each other.

The new ones wait, whole, in a folder within the one where they belong. All old ones are taken away, then the new ones
are brought in; the first to go and the last to come is one file, diagnosis.json, without which there is no result.
Whoever is killed in between leaves what is needed to go on.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

RESULT, CURVES, MODEL, REPORT = "diagnosis.json", "curves.json", "corrected.toml", "report.html"
RESULTS = (RESULT, CURVES, MODEL, REPORT)  # not all are written each time
HALF, WHOLE, DUE, OLD = "half", "whole", "due", "old"  # in the folder aside; the new files stand in one of the first 3


def exchange(aside: Path, path: Path) -> None:
    """Moves the files of `aside`/half to `path`; where that fails, what was there is as it was."""
    (aside / HALF).replace(aside / WHOLE)
    new = _names(aside / WHOLE)
    try:
        _go_on(aside, path)
    except OSError:
        _undo(aside, path, new)
        raise
    except BaseException:  # Ctrl-C: what is left to do takes less time than a key
        _go_on(aside, path)
        raise


def waits(aside: Path) -> bool:
    """Whether new files wait there, whole."""
    return (aside / WHOLE).is_dir() or (aside / DUE).is_dir()


def go_on(aside: Path, path: Path) -> None:
    """Ends the exchange in which a process was killed; not where `path` has a result, its old one or a later one."""
    left = _in_order(_names(aside / (WHOLE if (aside / WHOLE).is_dir() else DUE)))
    if left and not os.path.lexists(path / left[0]):
        _go_on(aside, path)


def _go_on(aside: Path, path: Path) -> None:
    if (aside / WHOLE).is_dir():
        for name in _in_order(_of_one_result(_names(aside / WHOLE))):
            if os.path.lexists(path / name):
                (path / name).replace(aside / OLD / name)
        (aside / WHOLE).replace(aside / DUE)
    if (aside / DUE).is_dir():
        for name in reversed(_in_order(_names(aside / DUE))):
            (aside / DUE / name).replace(path / name)
        (aside / DUE).rmdir()


def _undo(aside: Path, path: Path, new: list[str]) -> None:
    """As `_go_on`, the other way round."""
    if (aside / DUE).is_dir():
        for name in _in_order(set(new) - set(_names(aside / DUE))):
            (path / name).replace(aside / DUE / name)
        (aside / DUE).replace(aside / WHOLE)
    for name in reversed(_in_order(_names(aside / OLD))):
        (aside / OLD / name).replace(path / name)
    (aside / WHOLE).replace(aside / HALF)


def _names(folder: Path) -> list[str]:
    return [path.name for path in folder.iterdir()]


def _of_one_result(names: Iterable[str]) -> set[str]:
    """A diagnosis without a corrected model takes the place of one with it."""
    return {*names, *(RESULTS if RESULT in names else ())}


def _in_order(names: Iterable[str]) -> list[str]:
    """First the one that goes first and comes last."""
    return sorted(names, key=lambda name: (name != RESULT, name))
