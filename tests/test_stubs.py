from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import rwn


def test_the_stubs_describe_the_extension(tmp_path: Path) -> None:
    """`make stubs` regenerates them."""
    pytest.importorskip("pybind11_stubgen")
    subprocess.run(
        [sys.executable, "-m", "pybind11_stubgen", "rwn._core", "-o", str(tmp_path)],
        check=True,
        capture_output=True,
    )
    fresh = [s for s in (tmp_path / "rwn/_core.pyi").read_text().splitlines() if not s.startswith("__all__")]
    kept = (Path(rwn.__file__).parent / "_core.pyi").read_text().splitlines()
    assert fresh == kept, "python/rwn/_core.pyi is stale: run `make stubs`"
