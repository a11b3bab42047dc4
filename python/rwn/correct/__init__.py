"""The corrected model, the network that stands in for what has no name, and what to record next."""

from __future__ import annotations
