"""Shared fixtures."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

SHARED = Path(os.environ.get("RWN_SHARED", Path(__file__).resolve().parents[2] / "shared"))


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of real recordings and example cases beside the checkout."""
    if not (SHARED / "data").is_dir():
        pytest.skip(f"real recordings are not here ({SHARED}); set RWN_SHARED to the folder that holds them")
    return SHARED
