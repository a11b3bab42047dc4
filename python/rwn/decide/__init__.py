"""From ranked explanations and their proof to a verdict."""

from __future__ import annotations
