"""Units at the edges."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

from rwn.recording import units


def test_threads_share_one_registry() -> None:
    units._made.cache_clear()
    with ThreadPoolExecutor(4) as pool:
        made = list(pool.map(lambda _: units._registry(), range(4)))
    assert all(registry is made[0] for registry in made)
