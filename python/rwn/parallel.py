"""Independent pieces of work side by side, by a crew of threads; the core releases the interpreter.

Pieces may have pieces of their own: hands that the outer work leaves idle, because one long piece is left, take those.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")


class _Crew:
    """Threads of which only so many work at a time as there are hands."""

    def __init__(self, jobs: int) -> None:
        self.idle = threading.Semaphore(jobs - 1)  # hands; the calling thread's own is at work
        self.pool = ThreadPoolExecutor(2 * jobs)  # some wait for pieces of theirs


class _Here(threading.local):
    """What the present thread belongs to."""

    crew: _Crew | None = None


_here = _Here()


@contextmanager
def crew(jobs: int) -> Iterator[None]:
    """Within it `side_by_side` uses `jobs` threads in all; a crew within a crew is the outer one."""
    if jobs <= 1 or _here.crew is not None:
        yield
        return
    _here.crew = _Crew(jobs)
    try:
        yield
    finally:
        _here.crew.pool.shutdown()
        _here.crew = None


def side_by_side(function: Callable[[T], R], items: Iterable[T]) -> list[R]:
    """`function` of every item, in the order of the items; one after the other where there is no crew.

    Raises what the first item that fails raises.
    """
    work, mine = list(items), _here.crew
    if mine is None or len(work) < 2:
        return [function(item) for item in work]
    left = deque(range(len(work)))
    done: dict[int, R] = {}
    failed: dict[int, BaseException] = {}

    def labour() -> None:
        while left:
            try:
                k = left.popleft()
            except IndexError:  # another hand was faster
                return
            try:
                done[k] = function(work[k])
            except BaseException as error:  # raised by the caller
                failed[k] = error

    def help_out() -> None:
        _here.crew = mine
        try:
            labour()
        finally:
            mine.idle.release()

    helpers: list[Future[None]] = []
    while len(helpers) < len(work) - 1 and mine.idle.acquire(blocking=False):
        helpers.append(mine.pool.submit(help_out))
    labour()
    for late in [h for h in helpers if h.cancel()]:  # nothing was left for them
        helpers.remove(late)
        mine.idle.release()
    if helpers:
        mine.idle.release()  # while it waits, the pieces of the others may have this hand
        wait(helpers)
        mine.idle.acquire()
    if failed:
        raise failed[min(failed)]
    return [done[k] for k in range(len(work))]
