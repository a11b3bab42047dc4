"""The benches run: what they call is no part of the package that another test would miss."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

BENCH = Path(__file__).parents[1] / "bench"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("bench", "needs", "title"),
    [
        ("bench_simulate.py", (), "Simulation, one core:"),
        ("bench_structured_network.py", ("numba", "jax"), "Structured network, 15 wavelets, one step:"),
        ("bench_recurrent_network.py", ("numba", "jax"), "Recurrent network, one input:"),
    ],
)
def test_a_bench_runs(bench: str, needs: tuple[str, ...], title: str) -> None:
    for package in needs:
        pytest.importorskip(package)
    run = subprocess.run([sys.executable, BENCH / bench], capture_output=True, text=True, check=False, timeout=300)
    assert run.returncode == 0, run.stderr
    assert title in run.stdout


@pytest.mark.slow
def test_a_diagnosis_is_timed(tmp_path: Path) -> None:
    source = "import bench_diagnose as b; b.BACKLASH = b.LONGEST = (); b.SAMPLES = (2000, 2500); b.main()"
    run = subprocess.run(
        [sys.executable, "-c", source, "1"], capture_output=True, text=True, check=False, timeout=300,
        env={"PYTHONPATH": ":".join([str(BENCH), *sys.path]), "PATH": "/usr/bin:/bin"}, cwd=tmp_path,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "Whole diagnoses on two threads: 1 drawn" in run.stdout
