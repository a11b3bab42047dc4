"""Independent tasks on a pool of threads."""

from __future__ import annotations

import threading
import time

import pytest
from threadpoolctl import ThreadpoolController

from rwn.parallel import side_by_side, thread_pool


def test_results_are_in_the_order_of_the_items() -> None:
    def slow_first(k: int) -> int:
        time.sleep(0.02 if k == 0 else 0.0)
        return k * k

    with thread_pool(3):
        assert side_by_side(slow_first, range(8)) == [k * k for k in range(8)]
    assert side_by_side(slow_first, range(8)) == [k * k for k in range(8)]


class Counter:
    """How many threads are in it at a time."""

    def __init__(self) -> None:
        self.lock, self.now, self.most = threading.Lock(), 0, 0

    def __enter__(self) -> None:
        with self.lock:
            self.now += 1
            self.most = max(self.most, self.now)

    def __exit__(self, *_: object) -> None:
        with self.lock:
            self.now -= 1


@pytest.mark.parametrize("jobs", [1, 2, 3])
def test_no_more_threads_work_than_were_asked_for(jobs: int) -> None:
    working = Counter()

    def task(_: int) -> None:
        with working:
            time.sleep(0.002)

    with thread_pool(jobs):
        side_by_side(lambda _: side_by_side(task, range(4)), range(5))
    assert working.most == jobs


@pytest.mark.parametrize("jobs", [1, 2])
def test_the_library_of_linear_algebra_keeps_to_one_thread(jobs: int) -> None:
    def threads() -> set[int]:
        return {library.num_threads for library in ThreadpoolController().select(user_api="blas").lib_controllers}

    before = threads()
    with thread_pool(jobs):
        assert threads() == {1}
        with thread_pool(jobs):
            assert threads() == {1}
    assert threads() == before


def test_tasks_of_the_last_item_are_shared_by_idle_workers() -> None:
    """One long item among short ones: what it is made of is done by two."""
    together = threading.Barrier(2, timeout=10.0)

    def item(long: bool) -> int:
        if not long:
            return 0
        time.sleep(0.05)  # the others are done
        return sum(side_by_side(lambda _: together.wait() * 0 + 1, range(2)))

    with thread_pool(2):
        assert side_by_side(item, [True, False, False]) == [2, 0, 0]
        assert side_by_side(item, [False, False, True]) == [0, 0, 2]


@pytest.mark.parametrize("jobs", [1, 3])
def test_the_first_failure_is_raised_and_the_crew_goes_on(jobs: int) -> None:
    def fails(k: int) -> int:
        if k in (2, 4):
            raise ValueError(f"item {k}")
        return k

    with thread_pool(jobs):
        with pytest.raises(ValueError, match="item 2"):
            side_by_side(fails, range(6))
        assert side_by_side(fails, [0, 1, 3]) == [0, 1, 3]


def test_many_levels_come_to_an_end() -> None:
    def depth(level: int) -> int:
        return 1 if level == 0 else sum(side_by_side(depth, [level - 1] * 3))

    with thread_pool(3):
        assert depth(6) == 3**6
