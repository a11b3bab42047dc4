"""Where fits begin: what the residual tells of an effect."""

from __future__ import annotations
