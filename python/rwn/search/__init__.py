"""The search: how the recordings were made, what is wrong with them, and what physics explains the rest, in turns."""

from __future__ import annotations
