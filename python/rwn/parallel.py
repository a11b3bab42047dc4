"""Independent tasks side by side, on a pool of threads; the core releases the interpreter.

Tasks may have tasks of their own: workers that the outer ones leave idle, because one long task is left, take those.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from typing import TypeVar

from threadpoolctl import threadpool_limits

T = TypeVar("T")
R = TypeVar("R")


class _Pool:
    """Threads of which at most `jobs` work at a time."""

    def __init__(self, jobs: int) -> None:
        self.idle = threading.Semaphore(jobs - 1)  # workers; the calling thread is one more, and busy
        self.threads = ThreadPoolExecutor(2 * jobs)  # some wait for tasks of their own


class _Here(threading.local):
    """The pool that the present thread belongs to."""

    pool: _Pool | None = None


_here = _Here()


@contextmanager
def thread_pool(jobs: int) -> Iterator[None]:
    """Within it `side_by_side` uses `jobs` threads in all; a pool within a pool is the outer one.

    The library of linear algebra uses one: its problems are small here, and its threads wait for each other spinning.
    """
    if _here.pool is not None:
        yield
        return
    with threadpool_limits(limits=1, user_api="blas"):
        if jobs <= 1:
            yield
            return
        _here.pool = _Pool(jobs)
        try:
            yield
        finally:
            _here.pool.threads.shutdown()
            _here.pool = None


def side_by_side(function: Callable[[T], R], items: Iterable[T]) -> list[R]:
    """`function` of every item, in the order of the items; one after the other where there is no pool.

    Raises what the first item that fails raises.
    """
    work, mine = list(items), _here.pool
    if mine is None or len(work) < 2:
        return [function(item) for item in work]
    left = deque(range(len(work)))
    done: dict[int, R] = {}
    failed: dict[int, BaseException] = {}

    def work_on() -> None:
        while left:
            try:
                k = left.popleft()
            except IndexError:  # another worker was faster
                return
            try:
                done[k] = function(work[k])
            except BaseException as error:  # raised by the caller
                failed[k] = error

    def help_out() -> None:
        _here.pool = mine
        try:
            work_on()
        finally:
            mine.idle.release()

    helpers: list[Future[None]] = []
    while len(helpers) < len(work) - 1 and mine.idle.acquire(blocking=False):
        helpers.append(mine.threads.submit(help_out))
    work_on()
    for late in [h for h in helpers if h.cancel()]:  # nothing was left for them
        helpers.remove(late)
        mine.idle.release()
    if helpers:
        mine.idle.release()  # while this thread waits, tasks of the others may be worked on in its place
        wait(helpers)
        mine.idle.acquire()
    if failed:
        raise failed[min(failed)]
    return [done[k] for k in range(len(work))]
