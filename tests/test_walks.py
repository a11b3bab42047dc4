"""The walks of docs/walks.md: the functions that they name are called, in that order."""

from __future__ import annotations

import re
import sys
from collections import deque
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

import rwn

DEMO = Path(rwn.__file__).parent / "demo"
PAGE = Path(__file__).resolve().parents[1] / "docs" / "walks.md"


def walks() -> list[list[str]]:
    """Of each section the functions that begin its numbered lines."""
    sections = PAGE.read_text(encoding="utf-8").split("\n## ")[1:]
    lines = [re.findall(r"^\d+\. (`rwn\.[^:]*):", section, re.MULTILINE) for section in sections]
    return [[name for line in of for name in re.findall(r"`(rwn\.[\w.]+)`", line)] for of in lines]


@pytest.mark.slow
def test_the_walks_are_those_of_a_diagnosis(tmp_path: Path) -> None:
    for name in ("train.csv", "heldout.csv"):  # half of each recording takes half the time
        lines = (DEMO / name).read_text().splitlines(keepends=True)
        (tmp_path / name).write_text("".join(lines[: len(lines) // 2]))
    left = [deque(walk) for walk in walks()]
    assert [len(walk) for walk in left] == [21, 20]

    def called(frame: FrameType, event: str, _argument: Any) -> None:
        module = frame.f_globals.get("__name__", "")
        if event == "call" and module.startswith("rwn."):
            name = f"{module}.{frame.f_code.co_qualname}"
            for walk in left:
                if walk and walk[0] == name:
                    walk.popleft()

    sys.setprofile(called)
    try:
        found = rwn.diagnose(tmp_path / "train.csv", DEMO / "model.toml", heldout=tmp_path / "heldout.csv", jobs=1)
        found.save(tmp_path / "result")
    finally:
        sys.setprofile(None)
    assert left == [deque(), deque()]
