"""What the compiler says of a piece of C++ that includes rwn's headers."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

INCLUDE = Path(__file__).resolve().parents[1] / "cpp" / "include"


def complaints(place: Path, text: str, changed: dict[str, str]) -> str:
    """Of `text` with each key of `changed` replaced, written in the folder `place`; empty where it compiles."""
    compiler = shutil.which("g++")
    if compiler is None:
        pytest.skip("there is no g++")
    for name, value in changed.items():
        text = text.replace(name, value)
    (place / "piece.cpp").write_text(text)
    command = [compiler, "-std=c++20", "-fsyntax-only", f"-I{INCLUDE}", str(place / "piece.cpp")]
    return subprocess.run(command, capture_output=True, text=True, check=False).stderr
