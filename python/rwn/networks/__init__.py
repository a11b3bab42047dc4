"""The thesis's half: wavelet networks and how they are trained."""

from __future__ import annotations
