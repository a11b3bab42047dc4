"""Units at the edges."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import pytest

from rwn.errors import InputError
from rwn.recording import units


def test_threads_share_one_registry() -> None:
    units._made.cache_clear()
    with ThreadPoolExecutor(4) as pool:
        made = list(pool.map(lambda _: units._registry(), range(4)))
    assert all(registry is made[0] for registry in made)


def test_a_speed_constant_is_told_from_a_back_emf_constant() -> None:
    with pytest.raises(InputError, match="1 over the number, in V/rpm"):
        units.factor("rpm/V", "V s/rad", where="motor.toml")
