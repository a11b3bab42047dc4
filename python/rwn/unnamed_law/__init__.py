"""A law that has no name: a wavelet network over one state, in which equation it acts, and its formula."""

from __future__ import annotations
