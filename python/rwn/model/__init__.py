"""What is known of a drive beforehand: its kind, parameters, effects and their uncertainty."""

from __future__ import annotations
