"""Parameters from recordings: the problem, hypotheses, their fits and what these leave."""

from __future__ import annotations
