"""What a bench measured: files, columns, units and samples of one run, checked, in SI units."""

from __future__ import annotations
