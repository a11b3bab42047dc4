from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import rwn


@pytest.mark.slow
@pytest.mark.parametrize("module", ["rwn._core", "rwn.studies.trials._plant"])
def test_the_stubs_describe_the_extension(module: str, tmp_path: Path) -> None:
    """`make stubs` regenerates them."""
    pytest.importorskip("pybind11_stubgen")
    subprocess.run(
        [sys.executable, "-m", "pybind11_stubgen", module, "-o", str(tmp_path)],
        check=True,
        capture_output=True,
    )
    name = Path(*module.split(".")).with_suffix(".pyi")
    fresh = [s for s in (tmp_path / name).read_text().splitlines() if not s.startswith("__all__")]
    kept = (Path(rwn.__file__).parents[1] / name).read_text().splitlines()
    assert fresh == kept, f"python/{name} is stale: run `make stubs`"
