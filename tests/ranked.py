"""Rankings without a word on the way."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import rwn
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.name.forward import rank
from rwn.name.ranking import Ranking


def ranked(problem: Problem, names: Sequence[str] | None = None, **options: Any) -> Ranking:
    """The explanations of a problem by these effects; `options`: as of `rank`."""
    return rank(problem, progress=lambda *_: None, names=names, **options)


def ranked_from(
    recordings: Sequence[rwn.Recording], model: Model, names: Sequence[str] | None = None, **options: Any
) -> Ranking:
    """The same of recordings under a model."""
    return ranked(prepare(recordings, model), names, **options)
