"""What makes one choice certainly likelier than another."""

from __future__ import annotations

import numpy as np
import pytest

from rwn.fit.likelihood import BLOCKS, DECISIVE, certainly_likelier


@pytest.mark.parametrize("factor", [1.1, 1e3])
def test_a_gain_that_all_blocks_share_is_certain(factor: float) -> None:
    gains = factor * DECISIVE / BLOCKS * (1.0 + 0.5 * np.cos(np.arange(BLOCKS)))
    assert certainly_likelier(gains, np.zeros(BLOCKS))
    assert not certainly_likelier(np.zeros(BLOCKS), gains)


def test_a_gain_of_a_few_moments_is_not_certain_however_large() -> None:
    gains = np.zeros(BLOCKS)
    gains[[3, 17]] = 1e4
    assert not certainly_likelier(gains, np.zeros(BLOCKS))


def test_a_small_gain_is_not_decisive_however_even() -> None:
    assert not certainly_likelier(np.full(BLOCKS, 0.9 * DECISIVE / BLOCKS), np.zeros(BLOCKS))
