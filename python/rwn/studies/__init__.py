"""Experiments with rwn itself, reached by the command line: the thesis, trials, real machines."""

from __future__ import annotations
