"""Which files a diagnosis says that it was made of."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from pathlib import Path

import rwn
from rwn.report.provenance import sources

DEMO = Path(rwn.__file__).parent / "demo"


def test_files_are_said_with_their_use_and_hash_and_nothing_else() -> None:
    layout = rwn.read_model(DEMO / "model.toml").recording
    fitted, kept = (rwn.read_recording(DEMO / name, layout=layout) for name in ("train.csv", "heldout.csv"))
    found = sources(DEMO / "model.toml", [fitted], [kept])
    assert [(Path(s.path).name, s.use) for s in found] == [
        ("model.toml", "model"), ("train.csv", "fit"), ("heldout.csv", "heldout"),
    ]  # fmt: skip
    assert found[1].sha256 == hashlib.sha256((DEMO / "train.csv").read_bytes()).hexdigest()
    assert found[1].samples == len(fitted)
    made = replace(fitted, source="")
    gone = replace(fitted, source="/nowhere/run.csv")
    assert sources(rwn.read_model(DEMO / "model.toml"), [made, gone], [made]) == ()
