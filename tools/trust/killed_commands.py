"""The commands that `make kills` kills, each with what a finished run leaves and what no kill may break."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

import rwn
from rwn.recording.recording import write_csv
from rwn.report.diagnosis import Diagnosis
from rwn.report.exchange import RESULT, RESULTS
from rwn.studies.thesis import registry
from rwn.studies.thesis.experiment import Outcome, Row, Settings
from rwn.studies.trials import make as trials_make
from rwn.studies.trials.seal import ANSWERS, HASH, unseal
from tools.trust.cases import MODEL
from tools.trust.short_trials import short_trial
from tools.trust.soak import recording

MINE = "notes.txt"  # a file of the user's own in the folder of a result


@dataclass(frozen=True)
class Work:
    """A command in a folder.

    result: what a finished run left.  check: raises ValueError or OSError where a file is half.
    finished: files that later runs keep.  begin: in the process of the command, before it begins.
    """

    command: tuple[str, ...]
    result: Callable[[Path], Any]
    check: Callable[[Path], None]
    prepare: Callable[[Path], None] = lambda _: None
    finished: Callable[[Path], list[Path]] = lambda _: []
    begin: Callable[[], None] = lambda: None


def _drive(folder: Path) -> None:
    (folder / "motor.toml").write_text(MODEL)
    made = recording(rwn.read_model(folder / "motor.toml"))
    write_csv(folder / "run.csv", made.time, made.signals)
    (folder / "out").mkdir()
    for name in (*RESULTS, MINE):
        (folder / "out" / name).write_text("old")


def _diagnosis(folder: Path) -> Any:
    return [(folder / "out" / name).read_bytes() for name in ("diagnosis.json", "curves.json", "corrected.toml")]


def _of_one_result(folder: Path) -> None:
    """Whatever is there is old, or nothing is; whole where diagnosis.json is there; what is the user's own stays."""
    texts = {path.name: path.read_text() for path in (folder / "out").iterdir() if path.is_file()}
    if texts.pop(MINE, "") != "old":
        raise ValueError(f"{MINE} is not what it was")
    old = sorted(name for name, text in texts.items() if text == "old")
    if old and len(old) < len(texts):
        raise ValueError(f"a mixture: of {sorted(texts)}, {old} are old")
    if RESULT in texts and len(texts) < len(RESULTS):
        raise ValueError(f"a part of a result: {sorted(texts)}")
    if RESULT in texts and not old:
        Diagnosis.load(folder / "out")


def _short_trials() -> None:
    trials_make.make_trial = short_trial  # type: ignore[assignment]
    sys.modules["__main__"] = ModuleType("__main__")  # else the processes of the pool load this file


def _seal(folder: Path) -> Any:
    return (folder / "out" / HASH).read_text(), [path.read_bytes() for path in sorted(folder.rglob("*.csv"))]


def _answers(folder: Path) -> None:
    _json_is_whole(folder)
    if (folder / "out" / ANSWERS).exists():
        unseal(folder / "out")


def _trials(folder: Path) -> list[Path]:
    """The files of trials whose answers are kept or sealed."""
    out = folder / "out"
    kept = {path.stem for path in (out / trials_make.WORK).glob("*.json")}
    sealed = (out / ANSWERS).exists()
    return [path for path in sorted(out.glob("trial_*/*")) if sealed or path.parent.name in kept]


def _json_is_whole(folder: Path) -> None:
    for path in (folder / "out").rglob("*.json"):
        json.loads(path.read_text())


def _short_experiment(settings: Settings, *, name: str) -> Outcome:
    for k in range(20):
        settings.progress(k / 20)
        seen = float(np.sum(np.sin(np.arange(1e5))))
    return Outcome(rows=[Row(where="Table 5", case=name, ours=seen, thesis=1.0)])


def _short_experiments() -> None:
    short = [replace(e, run=partial(_short_experiment, name=e.name)) for e in registry.EXPERIMENTS[:4]]
    registry.select = lambda **_: short


def _numbers(folder: Path) -> Any:
    found = {path.name: json.loads(path.read_text()) for path in (folder / "out").glob("*.json")}
    return {name: content["rows"] for name, content in found.items()}, (folder / "out" / "thesis.md").stat().st_size


WORK = {
    "diagnose": Work(
        ("diagnose", "run.csv", "--model", "motor.toml", "--out", "out", "--overwrite", "--jobs", "1",
         "--effort", "0.1"),
        _diagnosis, _of_one_result, prepare=_drive,
    ),
    "trials make": Work(
        ("trials", "make", "--seed", "11", "--count", "6", "--out", "out", "--jobs", "1"),
        _seal, _answers, finished=_trials, begin=_short_trials,
    ),
    "thesis run": Work(
        ("thesis", "run", "--table", "5", "--jobs", "1", "--out", "out"),
        _numbers, _json_is_whole, finished=lambda folder: sorted((folder / "out").glob("*.json")),
        begin=_short_experiments,
    ),
}  # fmt: skip
