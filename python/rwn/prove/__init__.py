"""Whether an explanation holds on recordings that were not fitted."""

from __future__ import annotations
