"""Processes that work on trials, and that end with the one that started them, however it ends."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Iterator
from concurrent.futures import InvalidStateError, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import active_children, parent_process, resource_tracker
from multiprocessing.connection import wait
from multiprocessing.context import SpawnContext, SpawnProcess


class _Worker(SpawnProcess):
    """A process that Ctrl-C in a terminal, which goes to every process, does not reach: the parent alone answers it."""

    def start(self) -> None:
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # is inherited
        try:
            super().start()
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)


class _Spawn(SpawnContext):
    Process = _Worker


@contextmanager
def workers(jobs: int) -> Iterator[ProcessPoolExecutor]:
    """A pool of `jobs` fresh processes; an error or Ctrl-C in the block ends them at once, what they do is lost."""
    _start_the_tracker()
    before = set(active_children())
    pool = ProcessPoolExecutor(max_workers=jobs, mp_context=_Spawn(), initializer=_end_with_the_parent)
    try:
        yield pool
    except BaseException:
        with _cancelled_without_a_word():
            for process in set(active_children()) - before:
                process.kill()
            pool.shutdown(cancel_futures=True)
        raise
    pool.shutdown()


@contextmanager
def _cancelled_without_a_word() -> Iterator[None]:
    """A pool that loses its processes tells so to what was cancelled too, which raises in its thread (Python 3.11)."""
    told = threading.excepthook

    def tell(of: threading.ExceptHookArgs) -> None:
        if not issubclass(of.exc_type, InvalidStateError):
            told(of)

    threading.excepthook = tell
    try:
        yield
    finally:
        threading.excepthook = told


def _start_the_tracker() -> None:
    """The process that unlinks semaphores: where a second Ctrl-C left some, it removes them without a warning."""
    quiet = "ignore:resource_tracker"
    sys.warnoptions.append(quiet)  # goes to processes that start as an option of Python
    try:
        resource_tracker.ensure_running()
    finally:
        sys.warnoptions.remove(quiet)


def _end_with_the_parent() -> None:
    """A killed parent tells nobody, and its workers would wait for their next task for ever."""
    parent = parent_process()
    assert parent is not None, "runs in a worker"

    def watch() -> None:
        wait([parent.sentinel])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
